// Latitudes and longitudes as metres in a plane that touches the WGS84 ellipsoid, and back.
//
//   const LocalTangentPlane plane({53.5, 8.1, 0.0, 0.0});   // the map's origin
//   Eigen::Vector3d in_map = plane.positionOf({53.501, 8.102, 2.0});
//
// East, north and up at the datum (as in NIMA TR8350.2, through earth-centred coordinates), turned by
// the datum's yaw: of a yaw of 0 the map's x points east. There and back is the identity but for 1e-8 m
// within 1000 km of the datum.
#pragma once

#include <Eigen/Core>

namespace grid_path_planner::path {

struct GeodeticPosition {
  double latitude = 0.0;   // degrees, north is positive
  double longitude = 0.0;  // degrees, east is positive
  double altitude = 0.0;   // m above the ellipsoid
};

// Where the map's origin is.
struct Datum {
  GeodeticPosition origin;
  double yaw = 0.0;  // rad, of the map's x axis, anticlockwise from east
};

class LocalTangentPlane {
 public:
  // Throws InputError for numbers that are not finite, and beyond the poles or 360 degrees.
  explicit LocalTangentPlane(const Datum& datum);

  double yaw() const { return yaw_; }            // the datum's
  double altitude() const { return altitude_; }  // the datum's
  Eigen::Vector3d positionOf(const GeodeticPosition& position) const;
  // Longitudes from -180 to 180 degrees.
  GeodeticPosition geodeticOf(const Eigen::Vector3d& position) const;

 private:
  Eigen::Vector3d origin_;    // earth-centred
  Eigen::Matrix3d to_local_;  // rows: the map's axes
  double yaw_, altitude_;
};

}  // namespace grid_path_planner::path
