// Balls about the set bits of a window, 128 voxels of a row at a time.
#pragma once

#include "avoidance/memory/voxel_window.h"

namespace grid_path_planner::avoidance {

// `out`: the slots all of whose slots with centres within `radius` metres are in `in`.
void erode(const SlotBits& in, double radius, SlotBits& out);
// `out`: the slots with a slot of `in` within `radius` metres, from centre to centre.
void dilate(const SlotBits& in, double radius, SlotBits& out);

}  // namespace grid_path_planner::avoidance
