// How many cells have each weight, so that the least and the largest weight of a map are known after
// a change without a pass over the map.
//
//   WeightCounts counts;
//   counts.add(weights);
//   counts.replace(weights, next_weights, changed);
//   WeightCounts::Weight least = counts.minWeight();
//
// replace() takes time in proportion to the rectangle, minWeight() and maxWeight() in proportion to
// the number of possible weights, whatever the map's size.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/grid.h"

namespace grid_path_planner::costmap {

class WeightCounts {
 public:
  using Weight = std::uint16_t;

  void add(const grid::Grid<Weight>& weights);
  void add(const Weight* first, const Weight* last);
  // Counts the cells of `rect` of `after` in the place of those of `before`, which were added.
  // Precondition: `rect` lies in both, which are of the same size.
  void replace(const grid::Grid<Weight>& before, const grid::Grid<Weight>& after,
               const grid::CellRect& rect);

  // The smallest and the largest weight but 0 (a blocked cell); 0 where there is none.
  Weight minWeight() const;
  Weight maxWeight() const;

  bool empty() const { return counts_.empty(); }
  std::size_t bytes() const { return counts_.size() * sizeof(Parts); }

 private:
  void makeRoomFor(Weight weight);
  void replace(const Weight* before, const Weight* after, int number);

  // Cells that are counted together.
  static constexpr int kTogether = 4;
  // Each of them has a counter of its own, as increments of one counter would wait for one another.
  // Only the sum of the counters, which may wrap around, is a number of cells.
  using Parts = std::array<std::uint32_t, kTogether>;
  std::uint32_t number(std::size_t weight) const {
    const Parts& parts = counts_[weight];
    return parts[0] + parts[1] + parts[2] + parts[3];
  }

  std::vector<Parts> counts_;  // by weight, up to the largest one at least
};

}  // namespace grid_path_planner::costmap
