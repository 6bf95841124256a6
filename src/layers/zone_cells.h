// The cells of a map that a zone holds.
#pragma once

#include <vector>

#include "grid/polygon_cover.h"
#include "layers/zones.h"

namespace grid_path_planner::layers {

std::vector<grid::RowSpan> cellsOf(const Zone& zone, const grid::GridGeometry& geometry);

}  // namespace grid_path_planner::layers
