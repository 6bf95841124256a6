// How many cells have each weight, so that the cheapest and the dearest weight of a map are known
// after a change without a pass over the map.
//
//   WeightCounts counts;
//   counts.add(weights);
//   counts.replace(weights, next_weights, changed);
//   counts.cheapest();
//
// replace() takes time in proportion to the rectangle, the questions in proportion to the weights
// that are possible, whatever the map's size.
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
  // The cells of `rect` are no longer those of `before`, which were added, but those of `after`.
  // Precondition: `rect` lies in both, which are of the same size.
  void replace(const grid::Grid<Weight>& before, const grid::Grid<Weight>& after,
               const grid::CellRect& rect);

  // The smallest and the largest weight but 0 (a blocked cell); 0 where there is none.
  Weight cheapest() const;
  Weight dearest() const;

  bool empty() const { return counts_.empty(); }
  std::size_t bytes() const { return counts_.size() * sizeof(Parts); }

 private:
  void makeRoomFor(Weight weight);
  void replace(const Weight* before, const Weight* after, int number);

  // Cells that are looked at together.
  static constexpr int kTogether = 4;
  // Each of them is counted in a part of its own, as counting many cells of one weight in one place
  // would wait for it. Only the sum, which may wrap around, means something.
  using Parts = std::array<std::uint32_t, kTogether>;
  std::uint32_t number(std::size_t weight) const {
    const Parts& parts = counts_[weight];
    return parts[0] + parts[1] + parts[2] + parts[3];
  }

  std::vector<Parts> counts_;  // by weight, at least as many as the largest asks for
};

}  // namespace grid_path_planner::costmap
