#include "grid/formats/occupancy_dump.h"

#include <algorithm>
#include <string_view>

#include "grid/float_decimal.h"
#include "grid/formats/map_warning.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/level_quaternion.h"
#include "grid_path_planner/base/yaml_file.h"
#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

using base::checkIsText, base::InputError, base::parseYaml, base::yamlError, base::yamlNode,
    base::yamlValue, base::yawOfMapOrigin;

namespace {

// The values, while their list grows, and the text around them, for each byte of the file.
constexpr std::size_t kMostOfText = 3;
constexpr std::string_view kDataKey = "data:";
constexpr std::size_t kNone = std::string_view::npos;

bool startsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

std::size_t nextLine(std::string_view text, std::size_t at) {
  const std::size_t end = text.find('\n', at);
  return end == kNone ? text.size() : end + 1;
}

bool isSpace(char letter) {
  return letter == ' ' || letter == '\t' || letter == '\r';
}

// Of the document from `begin` on: at the second "---" at the left edge, or the first where something stands before it.
std::size_t endOfDocument(std::string_view text, std::size_t begin) {
  bool begun = false;
  for (std::size_t at = begin; at < text.size(); at = nextLine(text, at)) {
    const std::string_view line = text.substr(at);
    if (startsWith(line, "---") && begun) return at;
    const bool blank = line.empty() || line.front() == '\n' || line.front() == '\r';
    begun = begun || (!blank && line.front() != '#' && line.front() != '%' && line.front() != '-');
  }
  return text.size();
}

// Where the key `data` of the document between begins, kNone if nowhere.
std::size_t findData(std::string_view text, std::size_t begin, std::size_t end) {
  for (std::size_t at = begin; at < end; at = nextLine(text, at))
    if (startsWith(text.substr(at), kDataKey)) return at;
  return kNone;
}

// Reads the list behind `data:`.
class DataReader {
 public:
  // `at` is behind the colon.
  DataReader(std::string_view document, std::size_t at, const std::string& file)
      : text_(document), at_(at), file_(file) {
    line_ = 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + at, '\n'));
  }

  // The values, whatever their number.
  std::vector<std::int8_t> read() {
    while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
    const std::string_view rest = text_.substr(at_);
    if (startsWith(rest, "\"<array") || startsWith(rest, "'<array") || startsWith(rest, "<array"))
      throw error("data was left out of this dump: use `rostopic echo` without --noarr");
    if (startsWith(rest, "["))
      readBrackets();
    else if (at_ == text_.size() || text_[at_] == '\n' || text_[at_] == '#')
      readDashes();
    else
      throw error("data must be a list of numbers, got " + shown());
    return std::move(values_);
  }

  std::size_t end() const { return at_; }

 private:
  InputError error(const std::string& message) const { return InputError(file_, line_, message); }

  std::string shown() const {
    constexpr std::size_t kShown = 20;
    std::string_view rest = text_.substr(at_, kShown);
    rest = rest.substr(0, rest.find('\n'));
    return rest.empty() ? "the end" : "'" + std::string(rest) + "'";
  }

  // Over blanks, line ends and comments.
  void skipSpace() {
    for (; at_ < text_.size(); ++at_) {
      const char letter = text_[at_];
      if (letter == '#')
        at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
      else if (letter == '\n')
        ++line_;
      else if (!isSpace(letter))
        return;
    }
  }

  void readBrackets() {
    ++at_;
    skipSpace();
    while (!take(']')) {
      readValue();
      skipSpace();
      if (take(',')) {
        skipSpace();
      } else if (at_ == text_.size() || text_[at_] != ']') {
        throw error("expected ',' or ']' after value " + std::to_string(values_.size()) +
                    " of data, got " + shown());
      }
    }
    while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
    if (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '#')
      throw error("expected the end of the line after data, got " + shown());
  }

  void readDashes() {
    skipSpace();
    while (at_ < text_.size() && text_[at_] == '-' && !startsWith(text_.substr(at_), "---")) {
      ++at_;
      while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
      readValue();
      skipSpace();
    }
    if (values_.empty()) throw error("data must be a list of numbers, got " + shown());
    // Back to the line's beginning, where the next key stands.
    while (at_ > 0 && at_ < text_.size() && text_[at_ - 1] != '\n') --at_;
  }

  bool take(char letter) {
    if (at_ == text_.size() || text_[at_] != letter) return false;
    ++at_;
    return true;
  }

  void readValue() {
    constexpr int kFarOff = 100000;
    const std::size_t begin = at_;
    const bool negative = take('-');
    int value = 0;
    const std::size_t digits = at_;
    for (; at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9'; ++at_)
      value = std::min(kFarOff, 10 * value + (text_[at_] - '0'));
    const bool ended = at_ == text_.size() || isSpace(text_[at_]) || text_[at_] == '\n' ||
                       text_[at_] == ',' || text_[at_] == ']';
    if (negative) value = -value;
    if (at_ == digits || !ended || value < -1 || value > 100) {
      at_ = begin;
      throw error("data must be whole numbers from -1 to 100, value " +
                  std::to_string(values_.size() + 1) + " is " + shown());
    }
    values_.push_back(static_cast<std::int8_t>(value));
  }

  std::string_view text_;
  std::size_t at_;
  const std::string& file_;
  int line_;
  std::vector<std::int8_t> values_;
};

Origin readOrigin(const YAML::Node& info, const std::string& file, const MapFileOptions& options) {
  const YAML::Node origin = yamlNode(info, "origin", file, "a pose");
  const YAML::Node position = yamlNode(origin, "position", file, "x, y and z in metres");
  const YAML::Node orientation = yamlNode(origin, "orientation", file, "x, y, z and w");
  const auto number = [&file](const YAML::Node& node, const char* key) {
    return yamlValue<double>(node, key, file, "a finite number");
  };
  const double x = number(orientation, "x"), y = number(orientation, "y");
  const double z = number(orientation, "z"), w = number(orientation, "w");
  const double east = number(position, "x"), north = number(position, "y");
  try {
    const double yaw = yawOfMapOrigin(x, y, z, w);
    if (base::isZeroQuaternion(x, y, z, w)) warnAbout(file, base::kYawAssumed, options);
    return {east, north, yaw};
  } catch (const InputError& error) {
    throw yamlError(orientation, file, std::string("origin: ") + error.what());
  }
}

GridGeometry readGeometry(const YAML::Node& root, const std::string& file,
                          MapFileOptions& options) {
  const YAML::Node info = yamlNode(root, "info", file, "resolution, width, height and origin");
  const auto width = yamlValue<int>(info, "width", file, "a number of cells");
  const auto height = yamlValue<int>(info, "height", file, "a number of cells");
  const double resolution = options.resolution
                                ? *options.resolution
                                : printedFloatToDecimal(yamlValue<double>(
                                      info, "resolution", file, "a positive, finite number"));
  const Origin origin = options.origin ? *options.origin : readOrigin(info, file, options);
  try {
    return GridGeometry(width, height, resolution, origin);
  } catch (const InputError& error) {
    throw yamlError(info, file, error.what());
  }
}

// Where a document of the text lies, and the key `data` in it, kNone if nowhere.
struct Document {
  Document(std::string_view text, std::size_t from)
      : begin(from), end(endOfDocument(text, begin)), data(findData(text, begin, end)) {}

  std::size_t begin, end, data;
};

// What a document says beside its list of data, which ends at `data_end`: little. The lines before it and those of the list
// are there, empty, so that errors name the right ones.
std::string withoutData(std::string_view text, const Document& document, std::size_t data_end) {
  const auto lines = [text](std::size_t from, std::size_t to) {
    return std::string(std::count(text.begin() + from, text.begin() + to, '\n'), '\n');
  };
  std::string rest = lines(0, document.begin);
  rest.append(text.substr(document.begin, document.data - document.begin));
  rest.append(lines(document.data, data_end));
  rest.append(text.substr(data_end, document.end - data_end));
  return rest;
}

}  // namespace

bool looksLikeOccupancyDump(const std::string& text) {
  return Document(text, 0).data != kNone;
}

OccupancyGrid parseOccupancyDump(const std::string& text, const std::string& file,
                                 MapFileOptions& options) {
  options.limits.take(file, kMostOfText * text.size());
  checkIsText(text, file);
  for (Document document(text, 0); document.data != kNone;) {
    DataReader data(std::string_view(text).substr(0, document.end), document.data + kDataKey.size(),
                    file);
    std::vector<std::int8_t> values = data.read();
    const Document next(text, document.end);
    if (values.empty() && next.data != kNone) {
      document = next;
      continue;
    }
    const YAML::Node root =
        parseYaml(withoutData(text, document, data.end()), file, options.limits);
    const GridGeometry geometry = readGeometry(root, file, options);
    try {
      return OccupancyGrid(geometry, std::move(values));
    } catch (const InputError& error) {
      throw InputError(file, error.what());
    }
  }
  throw InputError(file, "has no 'data', the list of the map's values");
}

}  // namespace grid_path_planner::grid
