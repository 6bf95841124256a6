// Which steps are worth trying from a cell, by the step that led there: what another way is sure to
// serve as well is left out.
//
// A step from x to y is left out after the step d from p where a way from p to y around x, inside
// x's 3x3, costs less by the weights' least regard (y next to p: straight from p it is nearer), or,
// where the 3x3 weighs the same all over or all the map does, costs the same with its diagonals
// first (Harabor & Grastien, "Online graph pruning for pathfinding on grid maps", AAAI 2011). A
// least-cost path of the tried steps remains to every cell, as long as a cell that is reached at
// equal cost by another step tries what that one leaves open: missing().
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/planners/steps.h"

namespace grid_path_planner::planners {

class PruningRules {
 public:
  // A cell's kind is the mask of the allowed steps, but for one that cannot be where corners are
  // not cut: all diagonals and nothing straight stands for an open 3x3 of one weight.
  using NeighbourhoodClass = std::uint8_t;

  PruningRules() = default;
  explicit PruningRules(const costmap::CostGrid& map);
  // Whether they are those of `map`, too.
  bool fit(const costmap::CostGrid& map) const {
    return motion_ == map.motion() && map_uniform_ == map.uniform();
  }

  EightCells::Eight neighbourhoodClasses(const EightCells& cells) const {
    using Eight = EightCells::Eight;
    constexpr Eight kAll = Eight{} + kAllEqual;
    if (!canonical_) return steps_.allowed(cells);
    const Eight alike = cells.alike() & ~cells.blocked(0, 0);
    if (all(alike)) return kAll;
    return (alike & kAll) | (~alike & steps_.allowed(cells));
  }

  // The steps to try from a cell that was reached by any of `steps`; all for the start, which no
  // step led to. Bit n for step n of steps.h.
  std::uint32_t after(std::uint32_t steps, NeighbourhoodClass kind) const {
    if (steps == 0) return allowed(kind);
    std::uint32_t tried = 0;
    for (; steps != 0; steps &= steps - 1) tried |= tried_[lowest(steps)][kind];
    return tried;
  }

  // Whether a cell that was reached by `steps` has to try more if it is reached by `step`, too.
  bool missing(std::uint32_t steps, unsigned step, NeighbourhoodClass kind) const;

 private:
  static constexpr NeighbourhoodClass kAllEqual = 0xF0;

  static unsigned lowest(std::uint32_t steps) {
    return static_cast<unsigned>(__builtin_ctz(steps));
  }
  std::uint32_t allowed(NeighbourhoodClass kind) const {
    return canonical_ && kind == kAllEqual ? 0xFF : kind;
  }

  costmap::MotionModel motion_;
  bool map_uniform_ = false;
  StepRules steps_;
  std::array<std::array<std::uint8_t, 256>, 8> tried_{};  // by step, by kind
  std::array<std::uint8_t, 8> never_{};                   // by step: what is dearer than around
  bool canonical_ = false;                                // the motion model allows canonical moves
  bool uniform_ = false;
};

// The rules, and the kind of every cell of a map.
class MovePruning {
 public:
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

  // All that are allowed.
  std::uint32_t from(std::uint32_t index) const { return rules_.after(0, classes_[index]); }

  // What step n adds to a cell's index.
  const std::array<std::ptrdiff_t, 8>& offsets() const { return offsets_; }

 private:
  PruningRules rules_;
  std::vector<PruningRules::NeighbourhoodClass> classes_;
  std::array<std::ptrdiff_t, 8> offsets_{};
};

}  // namespace grid_path_planner::planners
