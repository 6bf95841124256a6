// Pictures as worlds: what is drawn stands from the ground up.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/simulation/world.h"

namespace grid_path_planner::avoidance {

constexpr double kDrawnHeight = 5.0;  // m, above the fence

inline simulation::TriangleMesh boxAt(const std::string& name, const Eigen::Vector3d& low,
                                      const Eigen::Vector3d& high) {
  return simulation::boxMesh(name, high - low)
      .moved(Eigen::Isometry3d(Eigen::Translation3d(0.5 * (low + high))));
}

// Each '#' a block of `side` metres; the picture's upper left corner at x 0, y 0; x to the right, y down
// the picture is negative. There is ground under all.
inline std::vector<simulation::TriangleMesh> drawnMeshes(const std::vector<std::string>& picture,
                                                         double side) {
  std::vector<simulation::TriangleMesh> meshes = {
      boxAt("ground", {-60.0, -60.0, -0.2}, {60.0, 60.0, 0.0})};
  for (std::size_t row = 0; row < picture.size(); ++row)
    for (std::size_t column = 0; column < picture[row].size(); ++column)
      if (picture[row][column] == '#') {
        const double x = side * static_cast<double>(column), y = -side * static_cast<double>(row);
        meshes.push_back(boxAt("block", {x, y - side, 0.0}, {x + side, y, kDrawnHeight}));
      }
  return meshes;
}

inline std::shared_ptr<const simulation::World> worldOf(
    std::vector<simulation::TriangleMesh> meshes) {
  return std::make_shared<const simulation::World>(std::move(meshes));
}

}  // namespace grid_path_planner::avoidance
