// Which markers a panel carries, and where: one file names them for the world and for who localises by it.
//
//   family: 36h11                # AprilTag's
//   tag_size: 0.2                # m, side of the black square
//   plate_size: 0.25             # m, side of the white plate that it is on
//   markers:
//     - {id: 0, position: [-1.3, -0.056, 0.8], rpy: [1.5707963, 0, 0]}
//
// Poses are those of the marker's frame in the panel's (m, rad; roll, pitch, yaw as in SDF). A marker's frame is
// at its centre, x to the right, y up and z towards who looks at it.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <string>

#include "grid_path_planner/base/read_limits.h"

namespace grid_path_planner::vision {

using Corners = std::array<Eigen::Vector3d, 4>;

struct MarkerLayout {
  double tag_size = 0.2;                            // m
  std::map<int, Eigen::Isometry3d> panel_from_tag;  // by id

  bool has(int id) const { return panel_from_tag.count(id) > 0; }
  // Of the black square in the panel's frame, clockwise from the upper left as OpenCV lists them.
  Corners cornersOf(int id) const;
};

// The corners of a tag in its own frame, in the same order.
Corners tagCorners(double tag_size);

// Throws InputError naming file and line for what is no layout, for an id that the family does not have
// or that comes twice, and for no marker at all.
MarkerLayout readMarkerLayout(const std::string& file, const base::ReadLimits& limits = {});

}  // namespace grid_path_planner::vision
