// Move pruning: which steps a search tries from a cell, by the step that led to it. Steps to cells
// that another path reaches at no higher cost are left out.
//
// Let step d lead from p to x. A step from x to y is left out where a path from p to y around x,
// inside the 3x3 cells around x, costs less whatever the weights are (where y is next to p, the
// straight step costs less); or, where the 3x3 cells or all cells of the map have the same weight,
// costs the same and takes its diagonals first (Harabor & Grastien, "Online graph pruning for
// pathfinding on grid maps", AAAI 2011). The tried steps contain a least-cost path to every cell,
// whichever of the steps that lead to a cell at its least cost it is expanded by: left out for a path
// of equal cost are diagonal steps after a straight one alone, and the straight step that ends that
// path is left out only where a cheaper one is. missing() is for searches in which what led to a cell
// changes later.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/core/steps.h"

namespace grid_path_planner::planners {

class PruningRules {
 public:
  // The mask of the allowed steps. Exception: all diagonals without a straight step, which is
  // impossible where corners are not cut, means an open 3x3 of one weight.
  using NeighbourhoodClass = std::uint8_t;

  PruningRules() = default;
  explicit PruningRules(const costmap::CostGrid& map);
  // Whether these are also the rules of `map`.
  bool fit(const costmap::CostGrid& map) const {
    return motion_ == map.motion() && map_uniform_ == map.uniform();
  }

  SimdNeighbourhood::Eight neighbourhoodClasses(const SimdNeighbourhood& cells) const {
    using Eight = SimdNeighbourhood::Eight;
    constexpr Eight kAll = Eight{} + kAllEqual;
    if (!canonical_) return steps_.allowed(cells);
    const Eight alike = cells.alike() & ~cells.blocked(0, 0);
    if (all(alike)) return kAll;
    return (alike & kAll) | (~alike & steps_.allowed(cells));
  }

  // The steps to try from a cell that any of `steps` reached; all for the start, which no step
  // reached. Bit n for step n of steps.h.
  std::uint32_t after(std::uint32_t steps, NeighbourhoodClass neighbourhood) const {
    if (steps == 0) return allowed(neighbourhood);
    std::uint32_t tried = 0;
    for (; steps != 0; steps &= steps - 1) tried |= tried_[lowest(steps)][neighbourhood];
    return tried;
  }

  // Whether a cell that `steps` reached has to try more steps if `step` reaches it too.
  bool missing(std::uint32_t steps, unsigned step, NeighbourhoodClass neighbourhood) const;

 private:
  static constexpr NeighbourhoodClass kAllEqual = 0xF0;

  static unsigned lowest(std::uint32_t steps) {
    return static_cast<unsigned>(__builtin_ctz(steps));
  }
  std::uint32_t allowed(NeighbourhoodClass neighbourhood) const {
    return canonical_ && neighbourhood == kAllEqual ? 0xFF : neighbourhood;
  }

  costmap::MotionModel motion_;
  bool map_uniform_ = false;
  StepRules steps_;
  std::array<std::array<std::uint8_t, 256>, 8> tried_{};  // by step and class
  std::array<std::uint8_t, 8> never_{};                   // by step: see uselessAfter()
  bool canonical_ = false;                                // the motion model allows canonical moves
  bool uniform_ = false;
};

// The rules, and the neighbourhood class of every cell of a map.
class MovePruning {
 public:
  // For a map of which update() is then called for all cells.
  void begin(const costmap::CostGrid& map);
  // Throw Stopped. `changed`: the cells whose weights changed since.
  void build(const costmap::CostGrid& map, const base::StopToken& stop);
  void update(const costmap::CostGrid& map, const grid::CellRect& changed,
              const base::StopToken& stop);

  std::uint32_t after(std::uint32_t steps, std::uint32_t index) const {
    return rules_.after(steps, classes_[index]);
  }
  bool missing(std::uint32_t steps, unsigned step, std::uint32_t index) const {
    return rules_.missing(steps, step, classes_[index]);
  }

  // All allowed steps.
  std::uint32_t from(std::uint32_t index) const { return rules_.after(0, classes_[index]); }

  // What step n adds to a cell's index.
  const std::array<std::ptrdiff_t, 8>& offsets() const { return offsets_; }

 private:
  PruningRules rules_;
  std::vector<PruningRules::NeighbourhoodClass> classes_;
  std::array<std::ptrdiff_t, 8> offsets_{};
};

}  // namespace grid_path_planner::planners
