#include "grid_path_planner/base/level_quaternion.h"

#include <cmath>
#include <sstream>
#include <string>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::base {

double yawOfLevelQuaternion(double x, double y, double z, double w) {
  const auto refuse = [&](const std::string& reason) {
    std::ostringstream text;
    text << "orientation x " << x << " y " << y << " z " << z << " w " << w << ' ' << reason;
    throw InputError(text.str());
  };
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z) || !std::isfinite(w))
    refuse("must be finite");
  const double length = std::hypot(std::hypot(x, y), std::hypot(z, w));
  if (!(length >= 1e-6)) refuse("has length zero");
  if (!std::isfinite(length)) refuse("is too long to be normalised");
  const double tilt = 2.0 * std::asin(std::fmin(1.0, std::hypot(x, y) / length));
  if (tilt > kLargestTilt)
    refuse("must be level, but is tilted by " + std::to_string(tilt) + " rad");
  return std::remainder(2.0 * std::atan2(z, w), 2.0 * M_PI);
}

}  // namespace grid_path_planner::base
