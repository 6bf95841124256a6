// How many cells have each weight, so that the cheapest and the dearest weight of a map are known
// after a change without a pass over the map.
//
//   WeightCounts counts;
//   counts.add(weights, weights.geometry().rect());
//   counts.remove(weights, changed);   // before its cells are written,
//   counts.add(weights, changed);      // and after
//   counts.cheapest();
//
// add() and remove() take time in proportion to the rectangle, the questions in proportion to the
// weights that are possible, whatever the map's size.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/grid.h"

namespace grid_path_planner {

class WeightCounts {
 public:
  using Weight = std::uint16_t;

  // Precondition of both: `rect` lies in the map.
  void add(const Grid<Weight>& weights, const CellRect& rect);
  // Precondition: its cells were added.
  void remove(const Grid<Weight>& weights, const CellRect& rect);

  // The smallest and the largest weight but 0 (a blocked cell); 0 where there is none.
  Weight cheapest() const;
  Weight dearest() const;

  bool empty() const { return counts_.empty(); }
  std::size_t bytes() const { return counts_.size() * sizeof(std::uint32_t); }

 private:
  std::vector<std::uint32_t> counts_;  // by weight, as long as the largest that was added asks for
};

}  // namespace grid_path_planner
