#include "grid/formats/moving_ai_file.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "grid/formats/map_warning.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

using base::checkIsText, base::InputError, base::writeFileAtomically;

namespace {

constexpr std::string_view kBlanks = " \t\r";

// Without the blanks behind its first `count` letters.
std::string_view withoutBlanksAfter(std::size_t count, std::string_view line) {
  return line.substr(0, std::max(count, line.find_last_not_of(kBlanks) + 1));
}

// The lines of a text, one after the other, without their ends.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  // False after the last line.
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    ++number_;
    return true;
  }
  int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

std::string shown(std::string_view line) {
  constexpr std::size_t kShown = 40;
  return "'" + std::string(line.substr(0, kShown)) + (line.size() > kShown ? "...'" : "'");
}

int positiveInteger(std::string_view digits) {
  constexpr std::size_t kMostDigits = 6;  // GridGeometry allows less
  if (digits.empty() || digits.size() > kMostDigits) return 0;
  int value = 0;
  for (const char digit : digits) {
    if (digit < '0' || digit > '9') return 0;
    value = 10 * value + (digit - '0');
  }
  return value;
}

struct Header {
  int width = 0;
  int height = 0;
};

// "height 49": what stands behind `key`; none where the line does not begin with it.
std::optional<std::string_view> valueOf(std::string_view line, std::string_view key) {
  if (line.substr(0, key.size()) != key) return std::nullopt;
  const std::string_view rest = line.substr(key.size());
  const std::size_t begin = std::min(rest.find_first_not_of(kBlanks), rest.size());
  return begin == 0 && !rest.empty() ? std::nullopt : std::optional(rest.substr(begin));
}

int sideFrom(std::string_view digits, std::string_view key, const std::string& file, int number) {
  const int side = positiveInteger(digits);
  if (side == 0)
    throw InputError(
        file, number,
        std::string(key) + " must be a number of cells from 1 to 524288, got " + shown(digits));
  return side;
}

// Reads up to and with the line "map".
Header readHeader(Lines& lines, const std::string& file) {
  Header header;
  std::string_view line;
  const auto next = [&] {
    const bool is_there = lines.next(line);
    line = withoutBlanksAfter(0, line);
    return is_there;
  };
  if (!next() || valueOf(line, "type") != "octile")
    throw InputError(file, 1, "a MovingAI map begins with 'type octile', got " + shown(line));
  while (next() && line != "map") {
    if (const auto width = valueOf(line, "width"))
      header.width = sideFrom(*width, "width", file, lines.number());
    else if (const auto height = valueOf(line, "height"))
      header.height = sideFrom(*height, "height", file, lines.number());
    else
      throw InputError(file, lines.number(),
                       "expected 'height', 'width' or 'map', got " + shown(line));
  }
  if (line != "map") throw InputError(file, lines.number(), "ends before the line 'map'");
  if (header.width == 0 || header.height == 0)
    throw InputError(file, lines.number(), "has no 'width' or no 'height' before 'map'");
  return header;
}

// The letters that the format defines as occupied: out of bounds, trees, swamp, water.
constexpr std::string_view kOccupied = "@OTSW";

// The first letter that the format does not define, and how many there are.
struct Strangers {
  char letter = 0;
  int line = 0;
  std::size_t column = 0;  // from 1
  std::size_t count = 0;
};

void readRow(std::string_view line, int number, const std::string& file, OccupancyGrid& map,
             int row, Strangers& strangers) {
  line = withoutBlanksAfter(static_cast<std::size_t>(map.width()), line);
  if (line.size() != static_cast<std::size_t>(map.width()))
    throw InputError(file, number,
                     "a row of the map has " + std::to_string(map.width()) + " cells, got " +
                         std::to_string(line.size()));
  std::int8_t* values = map.row(row);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char letter = line[i];
    const bool free = letter == '.' || letter == 'G';
    values[i] = free ? 0 : 100;
    if (free || kOccupied.find(letter) != std::string_view::npos) continue;
    if (strangers.count++ == 0) strangers = {letter, number, i + 1, 1};
  }
}

void warnAboutStrangers(const Strangers& strangers, const std::string& file,
                        const MapFileOptions& options) {
  if (strangers.count == 0) return;
  const std::string where = file + ":" + std::to_string(strangers.line);
  const std::size_t others = strangers.count - 1;
  warnAbout(where,
            "'" + std::string(1, strangers.letter) + "' in column " +
                std::to_string(strangers.column) +
                " is no letter of a MovingAI map (. and G are free; @, O, T, S and W occupied): " +
                (others == 0 ? "it is" : "it and " + std::to_string(others) + " more are") +
                " taken for occupied",
            options);
}

void readRows(Lines& lines, const std::string& file, OccupancyGrid& map, Strangers& strangers) {
  std::string_view line;
  for (int row = 0; row < map.height(); ++row) {
    if (!lines.next(line))
      throw InputError(file, lines.number(),
                       "ends after " + std::to_string(row) + " rows of the map, expected " +
                           std::to_string(map.height()));
    readRow(line, lines.number(), file, map, row, strangers);
  }
  while (lines.next(line))
    if (!withoutBlanksAfter(0, line).empty())
      throw InputError(file, lines.number(),
                       "has more than the " + std::to_string(map.height()) + " rows of its header");
}

char letterOf(Occupancy occupancy) {
  switch (occupancy) {
    case Occupancy::FREE:
      return '.';
    case Occupancy::OCCUPIED:
      return '@';
    case Occupancy::UNKNOWN:
      break;
  }
  return 'T';
}

}  // namespace

OccupancyGrid parseMovingAi(const std::string& text, const std::string& file,
                            MapFileOptions& options) {
  checkIsText(text, file);
  Lines lines(text);
  const Header header = readHeader(lines, file);
  const auto geometry = mapGeometry(file, header.width, header.height, 1.0, {}, options);
  if (text.size() < geometry.size())
    throw InputError(file, "is too short for a map of " + std::to_string(header.width) + "x" +
                               std::to_string(header.height) + " cells");
  options.limits.take(file, geometry.size());
  options.limits.goOn(file);
  OccupancyGrid map(geometry);
  Strangers strangers;
  readRows(lines, file, map, strangers);
  warnAboutStrangers(strangers, file, options);
  return map;
}

void writeMovingAiFile(const std::string& file, const OccupancyGrid& map,
                       const OccupancyThresholds& thresholds) {
  std::string text = "type octile\nheight " + std::to_string(map.height()) + "\nwidth " +
                     std::to_string(map.width()) + "\nmap\n";
  text.reserve(text.size() + map.values().size() + map.height());
  for (int row = 0; row < map.height(); ++row) {
    for (int column = 0; column < map.width(); ++column)
      text += letterOf(thresholds.classify(map.row(row)[column]));
    text += '\n';
  }
  writeFileAtomically(file, text);
}

}  // namespace grid_path_planner::grid
