// Estimates of what a search can save on a map, from a sample of cells spread over it: by pruning,
// and by smaller blocks of the bound that knows what cells cost.
//
//   estimate.sample(map, stop);
//   if (estimate.jumpingPays()) use(map);
//   if (estimate.octileSaysNothing(map.minWeight())) use(BlockBounds(4));
//
// Jumping: the share of the diagonal steps into sampled cells, on large maps a fourth of them, after
// which the default steps (planners/core/natural_moves.h) are natural and no others. On the maps that
// were measured it is 72 to 100 of 100, inflated ones included, and 36 to 53 where every cell has a
// weight drawn from three or more: there A* is faster. The threshold is 60.
//
// Guaranteed: it depends on the weights alone; update() gives the same as a fresh sample.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::planners {

class PruningEstimate {
 public:
  // Throws Stopped.
  void sample(const costmap::CostGrid& map, const base::StopToken& stop);
  // `changed`: the cells whose weights changed since.
  void update(const costmap::CostGrid& map, const grid::CellRect& changed);

  bool jumpingPays() const { return 100 * default_only_ >= 60 * steps_; }
  // Whether the octile distance at the least weight of the map says next to nothing of costs: the mean
  // over the sampled cells of least weight / weight is below a fourth. There smaller blocks pay, which
  // bound more and take longer.
  bool octileSaysNothing(costmap::CostGrid::Weight least) const {
    return 4 * static_cast<std::int64_t>(least) * inverse_weights_ < kInverse * passable_;
  }

 private:
  struct Count {
    std::uint8_t steps = 0;
    std::uint8_t default_only = 0;
    std::uint16_t inverse_weight = 0;  // kInverse / weight; 0 where the cell is blocked
  };
  static constexpr std::int64_t kInverse = 65535;

  static Count countAt(const costmap::CostGrid& map, grid::Cell cell, bool with_steps);
  void add(const Count& count, int times);
  void replace(const costmap::CostGrid& map, int column, int row);

  int stride_ = 1;  // cells between the sampled ones
  int columns_ = 0;
  std::vector<Count> counts_;
  std::int64_t steps_ = 0;
  std::int64_t default_only_ = 0;
  std::int64_t inverse_weights_ = 0;
  std::int64_t passable_ = 0;
};

}  // namespace grid_path_planner::planners
