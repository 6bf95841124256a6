// Dead branches: steps after which the natural steps all end within a few steps
// (planners/jump_point/weighted_jump_map.h says what they are good for).
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/cell.h"
#include "planners/core/natural_moves.h"

namespace grid_path_planner::planners {

// Bit d: no step of `steps` is natural after step d.
constexpr unsigned deadAfter(NaturalMoves steps) {
  constexpr std::uint64_t kLow = 0x7F7F7F7F7F7F7F7FU;
  const std::uint64_t filled = (((steps & kLow) + kLow) | steps) & ~kLow;
  return static_cast<unsigned>(((~filled & ~kLow) >> 7) * 0x0102040810204080U >> 56);
}

// Dead branches of windows of cells, one after the other.
class DeadBranches {
 public:
  // A window whose cells no step enters, as those along its border never are.
  void reset(int width, int height);
  // The natural steps of a cell that steps enter, by its index in the window; once a cell.
  void set(std::uint32_t index, NaturalMoves natural) {
    natural_[index] = natural;
    const auto dead = static_cast<std::uint8_t>(deadAfter(natural));
    if (dead == 0) return;
    dead_[index] = dead;
    ended_.push_back({index, dead});
  }

  // The steps at every cell of the window that do not begin a dead branch, a bit for each; without
  // meaning at cells that are not entered. A branch is dead if every sequence of natural steps that
  // begins with it ends inside the window after at most `depth` further steps. To be called once.
  const std::vector<std::uint8_t>& liveSteps(int depth);

 private:
  struct Ended {
    std::uint32_t index;
    std::uint8_t after;  // steps after which nothing is natural any more
  };

  void removeStepsInto(const std::vector<Ended>& ended);

  int width_ = 0;
  std::vector<NaturalMoves> natural_;
  std::vector<std::uint8_t> live_;
  std::vector<std::uint8_t> dead_;
  std::vector<Ended> ended_;
  std::vector<std::uint32_t> touched_;
};

}  // namespace grid_path_planner::planners
