#include "grid_path_planner/base/level_quaternion.h"

#include <cmath>
#include <sstream>
#include <string>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::base {
namespace {

[[noreturn]] void refuse(double x, double y, double z, double w, const std::string& reason) {
  std::ostringstream text;
  text << "orientation x " << x << " y " << y << " z " << z << " w " << w << ' ' << reason;
  throw InputError(text.str());
}

}  // namespace

YawAndTilt yawAndTiltOfQuaternion(double x, double y, double z, double w) {
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z) || !std::isfinite(w))
    refuse(x, y, z, w, "must be finite");
  const double length = std::hypot(std::hypot(x, y), std::hypot(z, w));
  if (!(length >= 1e-6)) refuse(x, y, z, w, "has length zero");
  if (!std::isfinite(length)) refuse(x, y, z, w, "is too long to be normalised");
  const double a = x / length, b = y / length, c = z / length, d = w / length;
  const double tilt = 2.0 * std::asin(std::fmin(1.0, std::hypot(a, b)));
  if (a == 0.0 && b == 0.0) return {std::remainder(2.0 * std::atan2(c, d), 2.0 * M_PI), 0.0};
  return {std::atan2(2.0 * (d * c + a * b), d * d + a * a - b * b - c * c), tilt};
}

double yawOfLevelQuaternion(double x, double y, double z, double w) {
  const YawAndTilt of = yawAndTiltOfQuaternion(x, y, z, w);
  if (of.tilt > kLargestTilt)
    refuse(x, y, z, w, "must be level, but is tilted by " + std::to_string(of.tilt) + " rad");
  return of.yaw;
}

bool isZeroQuaternion(double x, double y, double z, double w) {
  return x == 0.0 && y == 0.0 && z == 0.0 && w == 0.0;
}

double yawOfMapOrigin(double x, double y, double z, double w) {
  return isZeroQuaternion(x, y, z, w) ? 0.0 : yawOfLevelQuaternion(x, y, z, w);
}

}  // namespace grid_path_planner::base
