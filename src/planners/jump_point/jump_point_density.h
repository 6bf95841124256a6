// How many jump points a map of one weight has, and along how ragged obstacles: which search is the
// fastest there, from a sample of its rows.
//
//   JumpPointDensity density;
//   density.sample(map.bitMaps(stop), stop);
//   if (density.aStarPays()) use(map);
//
// Measured on 39 maps (doc/engine.md): A* is faster than jump points on random noise, of 3 to 35 cells in
// 100, where nearly every blocked cell stands alone. The jumps of weighted_jump_point, once they are
// prepared, are faster than JumpPoint where passages are narrow, so that a free cell in five is a jump
// point, and on dense noise.
//
// Guaranteed: it depends on the free cells alone; update() gives the same as a fresh sample.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/bit_maps.h"

namespace grid_path_planner::planners {

class JumpPointDensity {
 public:
  // Throws Stopped.
  void sample(const costmap::BitMaps& free, const base::StopToken& stop);
  // `changed`: the cells that were blocked or freed since.
  void update(const costmap::BitMaps& free, const grid::CellRect& changed);

  // Whether A* is faster than the search of JumpPoint.
  bool aStarPays() const;
  // Whether the prepared jumps of weighted_jump_point are faster than both.
  bool jumpsPay() const;

  // In the sampled rows: all, of up to 128.
  struct Counts {
    std::int64_t free = 0;
    std::int64_t borders = 0;      // of a free cell to a blocked one beside it
    std::int64_t jump_points = 0;  // a cell for each straight step to which it is one
  };
  const Counts& counts() const { return all_; }

 private:
  static Counts countRow(const costmap::BitMap& free, int row);
  int rowOf(int sample) const;
  void replace(const costmap::BitMap& free, int sample);

  int stride_ = 1;  // rows for each sampled one
  std::vector<Counts> rows_;
  Counts all_;
};

}  // namespace grid_path_planner::planners
