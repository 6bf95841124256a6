#include "path/waypoint_formats/local_tangent_plane.h"

#include <cmath>
#include <sstream>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::path {

using base::InputError;

namespace {

// WGS84
constexpr double kEquator = 6378137.0;               // m
constexpr double kFlattening = 1.0 / 298.257223563;  // of the ellipsoid
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
constexpr double kRadians = M_PI / 180.0;

// Of curvature, in the prime vertical.
double normalRadius(double latitude) {
  const double sine = std::sin(latitude);
  return kEquator / std::sqrt(1.0 - kEccentricity2 * sine * sine);
}

Eigen::Vector3d earthCentred(const GeodeticPosition& position) {
  const double latitude = position.latitude * kRadians, longitude = position.longitude * kRadians;
  const double radius = normalRadius(latitude);
  const double from_axis = (radius + position.altitude) * std::cos(latitude);
  return {from_axis * std::cos(longitude), from_axis * std::sin(longitude),
          (radius * (1.0 - kEccentricity2) + position.altitude) * std::sin(latitude)};
}

// By iteration of the latitude, which gains more than two decimals a round near the surface.
GeodeticPosition geodetic(const Eigen::Vector3d& centred) {
  const double from_axis = std::hypot(centred.x(), centred.y());
  double latitude = std::atan2(centred.z(), from_axis * (1.0 - kEccentricity2));
  for (int round = 0; round < 12; ++round)
    latitude = std::atan2(
        centred.z() + kEccentricity2 * normalRadius(latitude) * std::sin(latitude), from_axis);
  const double sine = std::sin(latitude), cosine = std::cos(latitude);
  const double altitude = from_axis * cosine + centred.z() * sine -
                          kEquator * std::sqrt(1.0 - kEccentricity2 * sine * sine);
  return {latitude / kRadians, std::atan2(centred.y(), centred.x()) / kRadians, altitude};
}

Eigen::Matrix3d axesAt(const Datum& datum) {
  const double latitude = datum.origin.latitude * kRadians;
  const double longitude = datum.origin.longitude * kRadians;
  const Eigen::Vector3d east(-std::sin(longitude), std::cos(longitude), 0.0);
  const Eigen::Vector3d up(std::cos(latitude) * std::cos(longitude),
                           std::cos(latitude) * std::sin(longitude), std::sin(latitude));
  const Eigen::Vector3d north(-std::sin(latitude) * std::cos(longitude),
                              -std::sin(latitude) * std::sin(longitude), std::cos(latitude));
  Eigen::Matrix3d axes;
  axes.row(0) = std::cos(datum.yaw) * east + std::sin(datum.yaw) * north;
  axes.row(1) = std::cos(datum.yaw) * north - std::sin(datum.yaw) * east;
  axes.row(2) = up;
  return axes;
}

}  // namespace

LocalTangentPlane::LocalTangentPlane(const Datum& datum)
    : yaw_(datum.yaw), altitude_(datum.origin.altitude) {
  const GeodeticPosition& origin = datum.origin;
  // Not finite numbers fail these too.
  if (!(std::abs(origin.latitude) <= 90.0 && std::abs(origin.longitude) <= 360.0 &&
        std::abs(origin.altitude) <= 1e5 && std::abs(datum.yaw) <= 100.0)) {
    std::ostringstream message;
    message << "the datum needs a latitude within 90, a longitude within 360 degrees, a yaw within "
               "100 rad and an altitude within 1e5 m, got "
            << origin.latitude << ", " << origin.longitude << ", " << datum.yaw << ", "
            << origin.altitude;
    throw InputError(message.str());
  }
  origin_ = earthCentred(origin);
  to_local_ = axesAt(datum);
}

Eigen::Vector3d LocalTangentPlane::positionOf(const GeodeticPosition& position) const {
  return to_local_ * (earthCentred(position) - origin_);
}

GeodeticPosition LocalTangentPlane::geodeticOf(const Eigen::Vector3d& position) const {
  return geodetic(to_local_.transpose() * position + origin_);
}

}  // namespace grid_path_planner::path
