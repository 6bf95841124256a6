#include "study/programs/eager_theta_star.h"

namespace grid_path_planner::study {

using base::Statistics;
using grid::Cell;

void EagerThetaStar::expand(std::uint32_t from, Statistics& counts) {
  const Node here = node(from);
  const double parent_g = node(here.parent).g;
  const Cell at = cell(from), parent = cell(here.parent);
  forNeighbours(from, at, [&](std::uint32_t index, Cell to) {
    if (closed(index)) return;
    const double by_step = here.g + stepCost(at, to);
    if (here.parent != from) {
      const double least = (parent_g + costBound(parent, to)) * (1.0 - kRounding);
      if (generated(index) && node(index).g <= least) return;
      const auto cost = segmentCost(parent, to, by_step - parent_g);
      if (cost && parent_g + *cost <= by_step)
        return relax(index, to, here.parent, parent_g + *cost, 0, counts);
    }
    relax(index, to, from, by_step, 0, counts);
  });
}

}  // namespace grid_path_planner::study
