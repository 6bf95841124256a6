// Whether a map has symmetric paths to leave out, judged by counting at cells spread over it.
//
// Of the diagonal steps into the sampled cells those are counted after which nothing but the
// default steps (planners/core/natural_moves.h) is natural, and something is. On the maps that were
// measured they are 72 to 100 of 100, inflated ones included, and 36 to 53 where every cell has a
// weight drawn from three or more: there A* is faster. The line is drawn at 60.
//
// Deterministic: it depends on the weights alone, so an updated sample judges like a fresh one.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::planners {

class PruningEstimate {
 public:
  // Throws Stopped.
  void take(const costmap::CostGrid& map, const base::StopToken& stop);
  // `changed`: the cells whose weights changed since.
  void update(const costmap::CostGrid& map, const grid::CellRect& changed);

  bool symmetric() const { return 100 * plain_ >= 60 * steps_; }

 private:
  struct Count {
    std::uint8_t steps = 0;
    std::uint8_t plain = 0;
  };
  static Count countAt(const costmap::CostGrid& map, grid::Cell cell);
  void replace(const costmap::CostGrid& map, int column, int row);

  int stride_ = 1;  // cells between the sampled ones
  int columns_ = 0;
  std::vector<Count> counts_;
  std::int64_t steps_ = 0;
  std::int64_t plain_ = 0;
};

}  // namespace grid_path_planner::planners
