#include "path/plain_waypoints.h"

#include <locale.h>
#include <strings.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/level_quaternion.h"
#include "grid_path_planner/path/waypoint_file.h"

namespace grid_path_planner::path {
namespace {

// strtod for numbers with a point, whatever the locale of the process is.
double toDouble(const char* text, char** end) {
  static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
  return ::strtod_l(text, end, plain);
}

class Reader {
 public:
  explicit Reader(const std::string& text) : at_(text.c_str()), end_(at_ + text.size()) {}

  bool ended() const { return at_ == end_; }

  bool skip(const char* expected) {
    const std::size_t size = std::strlen(expected);
    if (std::strncmp(at_, expected, size) != 0) return false;
    at_ += size;
    return true;
  }

  // Digits with a sign, a point and an exponent; no inf, nan or hexadecimal ones.
  bool number(double& value) {
    const std::size_t size = std::strspn(at_, "+-.0123456789e");
    const char last = size > 0 ? at_[size - 1] : '\0';
    if (!std::isdigit(static_cast<unsigned char>(last))) return false;
    char* end = nullptr;
    value = toDouble(at_, &end);
    if (end != at_ + size || !std::isfinite(value)) return false;
    at_ = end;
    return true;
  }

  // A word of more than one letter that YAML takes for text.
  bool name(std::string& name) {
    const char* begin = at_;
    while (std::isalnum(static_cast<unsigned char>(*at_)) || *at_ == '_' || *at_ == '/') ++at_;
    name.assign(begin, at_);
    return name.size() > 1 && std::isalpha(static_cast<unsigned char>(name.front())) &&
           ::strcasecmp(name.c_str(), "null") != 0;
  }

 private:
  const char* at_;
  const char* end_;
};

bool readPose(Reader& reader, double largest, Pose& pose) {
  double x = 0.0, y = 0.0, z = 0.0, w = 0.0;
  const bool read =
      reader.skip("  - position: {x: ") && reader.number(pose.position.x()) &&
      reader.skip(", y: ") && reader.number(pose.position.y()) && reader.skip(", z: ") &&
      reader.number(pose.position.z()) && reader.skip("}\n    orientation: {x: ") &&
      reader.number(x) && reader.skip(", y: ") && reader.number(y) && reader.skip(", z: ") &&
      reader.number(z) && reader.skip(", w: ") && reader.number(w) && reader.skip("}\n");
  if (!read || pose.position.cwiseAbs().maxCoeff() > largest) return false;
  try {
    pose.yaw = base::yawOfLevelQuaternion(x, y, z, w);
  } catch (const base::InputError&) {
    return false;
  }
  return true;
}

}  // namespace

std::optional<Path> plainWaypoints(const std::string& text) {
  Reader reader(text);
  Path path;
  if (!reader.skip("header: {frame_id: ") || !reader.name(path.frame_id) ||
      !reader.skip("}\nwaypoints:\n"))
    return std::nullopt;
  const double largest = largestCoordinateIn(path.frame_id);
  while (!reader.ended()) {
    path.poses.emplace_back();
    if (!readPose(reader, largest, path.poses.back())) return std::nullopt;
  }
  return path.empty() ? std::nullopt : std::make_optional(std::move(path));
}

}  // namespace grid_path_planner::path
