// The voxels that a ray passes before the one it ends in (Amanatides 1987).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "avoidance/memory/voxel_window.h"

namespace grid_path_planner::avoidance {

// Calls action(slot) from the voxel of `from` on; not for the last two voxels, in which noise may have
// moved the end.
template <class Action>
void forVoxelsOfRay(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Action& action) {
  const Voxel first = voxelAt(from), last = voxelAt(to);
  const Eigen::Vector3d ray = to - from;
  int index[3] = {first.x, first.y, first.z};
  int steps = std::abs(last.x - first.x) + std::abs(last.y - first.y) + std::abs(last.z - first.z);
  int step[3];
  double next[3], each[3];
  for (int axis = 0; axis < 3; ++axis) {
    step[axis] = ray[axis] > 0.0 ? 1 : -1;
    each[axis] =
        ray[axis] == 0.0 ? std::numeric_limits<double>::infinity() : kVoxel / std::abs(ray[axis]);
    const double share = from[axis] / kVoxel - index[axis];
    next[axis] =
        ray[axis] == 0.0 ? each[axis] : each[axis] * (step[axis] > 0 ? 1.0 - share : share);
  }
  for (; steps > 1; --steps) {
    action(slotOf(index[0], index[1], index[2]));
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    index[axis] += step[axis];
    next[axis] += each[axis];
  }
}

}  // namespace grid_path_planner::avoidance
