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

#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/grid.h"

namespace grid_path_planner {

class WeightCounts {
 public:
  using Weight = std::uint16_t;

  void add(const Grid<Weight>& weights);
  // The cells of `rect` are no longer those of `before`, which were added, but those of `after`.
  // Precondition: `rect` lies in both, which are of the same size.
  void replace(const Grid<Weight>& before, const Grid<Weight>& after, const CellRect& rect);

  // The smallest and the largest weight but 0 (a blocked cell); 0 where there is none.
  Weight cheapest() const;
  Weight dearest() const;

  bool empty() const { return counts_.empty(); }
  std::size_t bytes() const { return counts_.size() * sizeof(std::uint32_t); }

 private:
  void makeRoomFor(Weight weight);
  void replace(const Weight* before, const Weight* after, int number);

  std::vector<std::uint32_t> counts_;  // by weight, at least as many as the largest asks for
};

}  // namespace grid_path_planner
