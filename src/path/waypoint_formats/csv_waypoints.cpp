#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/level_quaternion.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "path/waypoint_entry.h"
#include "path/waypoint_formats/waypoint_texts.h"

namespace grid_path_planner::path {

using base::decimalText, base::InputError, base::numberFromText;

namespace {

// The first four, and all of the quaternion, may come without names.
constexpr std::array<const char*, 10> kColumns = {"x",  "y",  "z",  "yaw",  "qx",
                                                  "qy", "qz", "qw", "roll", "pitch"};
enum Column : std::size_t { X, Y, Z, YAW, QX, QY, QZ, QW, ROLL, PITCH };
using Row = std::array<double, kColumns.size()>;
const std::string kFrameComment = "# frame_id:";

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

class CsvReading {
 public:
  explicit CsvReading(const std::string& file) : file_(file) {}

  void take(const std::string& line) {
    ++line_;
    const std::string text = trimmed(line);
    if (text.compare(0, kFrameComment.size(), kFrameComment) == 0) return takeFrame(text);
    if (text.empty() || text.front() == '#') return;
    const std::vector<std::string> parts = partsOf(text);
    if (columns_.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0)
      return takeNames(parts);
    if (columns_.empty()) takeCount(parts.size());
    takePose(parts);
  }

  Path path() const {
    if (path_.empty()) throw InputError(file_, "holds no waypoint");
    return path_;
  }

 private:
  void takeFrame(const std::string& text) {
    const std::string frame = withoutSlash(trimmed(text.substr(kFrameComment.size())));
    if (!isPlainFrame(frame))
      throw InputError(file_, line_, "frame_id must be the name of a frame");
    path_.frame_id = frame;
  }

  static std::vector<std::string> partsOf(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream in(text + ",");
    for (std::string part; std::getline(in, part, ',');) parts.push_back(trimmed(part));
    return parts;
  }

  void takeNames(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const auto column = std::find(kColumns.begin(), kColumns.end(), name);
      const auto index = static_cast<std::size_t>(column - kColumns.begin());
      if (column == kColumns.end() || has(index))
        throw InputError(file_, line_,
                         "the columns are x, y, z and yaw (with roll and pitch, or in their place "
                         "qx, qy, qz and "
                         "qw), each once, got '" +
                             name.substr(0, 80) + "'");
      columns_.push_back(index);
    }
    if (!has(X) || !has(Y)) throw InputError(file_, line_, "there must be columns x and y");
    const bool quaternion = has(QX) && has(QY) && has(QZ) && has(QW);
    if (!quaternion && (has(QX) || has(QY) || has(QZ) || has(QW)))
      throw InputError(file_, line_, "a quaternion has the columns qx, qy, qz and qw");
    if (quaternion && (has(YAW) || has(ROLL) || has(PITCH)))
      throw InputError(file_, line_, "a waypoint has either a quaternion or angles");
  }

  void takeCount(std::size_t count) {
    if (count < 2 || (count > 4 && count != 7))
      throw InputError(file_, line_,
                       "a waypoint is x,y or x,y,z or x,y,z,yaw or x,y,z,qx,qy,qz,qw, got " +
                           std::to_string(count) + " values");
    for (std::size_t i = 0; i < count; ++i) columns_.push_back(count == 7 && i > Z ? i + 1 : i);
  }

  bool has(std::size_t column) const {
    return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
  }

  void takePose(const std::vector<std::string>& parts) {
    if (parts.size() != columns_.size())
      throw InputError(file_, line_,
                       "expected " + std::to_string(columns_.size()) +
                           " values separated by commas, got " + std::to_string(parts.size()));
    Row values{};
    values[YAW] = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < parts.size(); ++i)
      values[columns_[i]] = valueOf(parts[i], columns_[i]);
    Pose pose;
    pose.position << values[X], values[Y], values[Z];
    pose.yaw = yawOf(values);
    path_.poses.push_back(pose);
  }

  // Throws InputError for a quaternion of zeros, and where the waypoint tilts too much.
  double yawOf(const Row& row) const {
    try {
      base::YawAndTilt turned{std::remainder(row[YAW], 2.0 * M_PI),
                              std::acos(std::cos(row[ROLL]) * std::cos(row[PITCH]))};
      if (has(QW)) turned = base::yawAndTiltOfQuaternion(row[QX], row[QY], row[QZ], row[QW]);
      if (turned.tilt <= kLargestWaypointTilt) return turned.yaw;
      throw InputError("the orientation must tilt by at most 0.7 rad, got " +
                       std::to_string(turned.tilt) + " rad");
    } catch (const InputError& error) {
      throw InputError(file_, line_, error.what());
    }
  }

  double valueOf(const std::string& text, std::size_t column) const {
    double value = 0.0;
    try {
      value = numberFromText(kColumns[column], text.substr(0, 80));
    } catch (const InputError& error) {
      throw InputError(file_, line_, error.what());
    }
    const double largest = column <= Z ? largestCoordinateIn(path_.frame_id) : kLargestCoordinate;
    if (std::abs(value) > largest)
      throw InputError(file_, line_,
                       std::string(kColumns[column]) + " must be within " +
                           (largest == kLargestCoordinate ? "1e6" : "1e8") + " of 0, got '" +
                           text.substr(0, 80) + "'");
    return value;
  }

  const std::string& file_;
  int line_ = 0;
  std::vector<std::size_t> columns_;  // of kColumns; empty before the first line that says
  Path path_;
};

}  // namespace

Path csvPath(const WaypointText& text) {
  CsvReading reading(text.file);
  // A waypoint takes at least "0,0" and the end of the line.
  text.limits.take(text.file, text.content.size() / 4 * sizeof(Pose) + sizeof(Pose));
  base::ReadPoll poll(text.limits, text.file);
  std::istringstream in(text.content);
  for (std::string line; std::getline(in, line); poll()) reading.take(line);
  Path path = reading.path();
  lookAlongPath(path);
  return path;
}

std::string csvText(const Path& path) {
  std::string text = kFrameComment + " " + path.frame_id + "\nx,y,z,yaw\n";
  for (const Pose& pose : path.poses) {
    for (int i = 0; i < 3; ++i)
      text += decimalText(pose.position[i]) + ",";  // Eigen 3.3: no begin()
    text += decimalText(pose.yaw) + "\n";
  }
  return text;
}

}  // namespace grid_path_planner::path
