// How one scan observed a voxel.
#pragma once

#include <cstdint>

namespace grid_path_planner::mapping {

enum class Mark : std::uint8_t { NONE = 0, FREE = 1, HIT = 2 };

}  // namespace grid_path_planner::mapping
