// Worlds drawn from the side and maps drawn from above, for tests of the projection.
//
//   OccupancyBricks bricks = sideView({"#..",      // z from 1 m on
//                                      ".##"});    // z from 0 on; x grows to the right
//   EXPECT_EQ(rowOf(projection.grid(), 0), "###");
//
// '#' occupied, '.' free, ' ' unknown. Voxels have a side of 1 m, the picture is as deep (along y)
// as wanted, and its lower left voxel begins at (0, 0, 0) m.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/mapping/occupancy_bricks.h"

namespace grid_path_planner::test {

inline octomap::OcTreeKey voxelKey(int x, int y, int z) {
  const auto key = [](int voxel) { return static_cast<octomap::key_type>(voxel + 32768); };
  return {key(x), key(y), key(z)};
}

inline void drawSideView(mapping::OccupancyBricks& bricks, const std::vector<std::string>& lines,
                         int depth = 1) {
  const int height = static_cast<int>(lines.size());
  for (int z = 0; z < height; ++z) {
    const std::string& line = lines[static_cast<std::size_t>(height - 1 - z)];
    for (int x = 0; x < static_cast<int>(line.size()); ++x) {
      const char c = line[static_cast<std::size_t>(x)];
      const mapping::Voxel voxel = c == '#'   ? mapping::Voxel::OCCUPIED
                                   : c == '.' ? mapping::Voxel::FREE
                                              : mapping::Voxel::UNKNOWN;
      for (int y = 0; y < depth; ++y) bricks.setVoxel(voxelKey(x, y, z), voxel);
    }
  }
}

inline mapping::OccupancyBricks sideView(const std::vector<std::string>& lines, int depth = 1) {
  mapping::OccupancyBricks bricks(1.0);
  drawSideView(bricks, lines, depth);
  return bricks;
}

// The cells of one row from x = 0 m on: '#', '.', '?', without the unknown ones at its end.
inline std::string rowOf(const grid::OccupancyGrid& grid, int y) {
  std::string text;
  for (int x = 0; x < grid.width(); ++x) {
    const auto cell = grid.geometry().cellAt(
        {(x + 0.5) * grid.geometry().resolution(), (y + 0.5) * grid.geometry().resolution()});
    if (!cell) break;
    text += grid[*cell] == 100 ? '#' : grid[*cell] == 0 ? '.' : '?';
  }
  text.erase(text.find_last_not_of('?') + 1);
  return text;
}

}  // namespace grid_path_planner::test
