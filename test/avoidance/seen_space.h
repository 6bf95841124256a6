// A space all of which was seen, and is empty.
#pragma once

#include <optional>

#include "avoidance/memory/open_space.h"

namespace grid_path_planner::avoidance {

// 5 m about the origin, but for one voxel.
inline OpenSpace seenSpace(double d_safe, const std::optional<Voxel>& missing = std::nullopt) {
  VoxelMemory memory;
  memory.moveTo(Eigen::Vector3d::Zero());
  memory.beginFrame(0);
  constexpr int kBox = 25;
  for (int z = -kBox; z <= kBox; ++z)
    for (int y = -kBox; y <= kBox; ++y)
      for (int x = -kBox; x <= kBox; ++x)
        if (!missing || !(Voxel{x, y, z} == *missing)) memory.cross(slotOf(x, y, z));
  OpenSpace space;
  space.refresh(memory, d_safe, {-100.0, 100.0});
  return space;
}

}  // namespace grid_path_planner::avoidance
