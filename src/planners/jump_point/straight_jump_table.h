// Straight runs over the cells of all rows, or of all columns, of a map, 64 cells in one word.
//
//   if (lanes.deadEnd<true>(row, column)) return;  // a run forwards from here finds nothing
//   StraightJumpTable::Run run = lanes.run<true>(row, column, weights, 1);
//   use(run.to, run.weights);  // the cell where the run ends, and the cost of its steps
//
// A run goes on until the first cell that is a stop in its direction. A stop is dead where nothing
// leads on; a cell is blind in a direction where the run that leaves it that way ends at a dead
// stop, so that runs to nowhere cost one bit test. One more bit says where the weight changes to
// the next cell: a run over a plateau is priced by counting. What is a stop, and dead, is the
// caller's business (planners/jump_point/weighted_jump_map.h). Every lane must end in a stop in both directions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::planners {

class StraightJumpTable {
 public:
  struct Word {
    std::array<std::uint64_t, 2> stop;      // forwards, backwards
    std::array<std::uint64_t, 2> dead_end;  // forwards, backwards
    std::uint64_t change;                   // of the weight to the next cell
    std::uint64_t open;                     // for the caller: an open cell, all around alike
  };

  static std::size_t bytesFor(std::size_t lanes, std::size_t length) {
    return lanes * ((length + 63) / 64) * sizeof(Word);
  }

  // No stops, no changes.
  void reset(std::size_t lanes, std::size_t length) {
    words_per_lane_ = (length + 63) / 64;
    words_.assign(lanes * words_per_lane_, Word{});
  }

  const Word& word(std::size_t lane, unsigned at) const {
    return words_[lane * words_per_lane_ + at / 64];
  }
  Word& word(std::size_t lane, unsigned at) { return words_[lane * words_per_lane_ + at / 64]; }

  template <bool kForward>
  bool deadEnd(std::size_t lane, unsigned at) const {
    return (word(lane, at).dead_end[kForward ? 0 : 1] >> (at & 63U) & 1U) != 0;
  }

  // What a cell is to the runs of one direction, and what that means to the cells before it.
  template <bool kForward>
  void set(std::size_t lane, unsigned at, bool stop, bool dead);

  struct Run {
    unsigned to;            // the stop
    std::uint64_t weights;  // sum of max(weight, weight) over the steps
  };
  // `weights`: of the lane's first cell; `stride`: from each to the next.
  // Precondition: the step to the next cell is legal.
  template <bool kForward>
  Run run(std::size_t lane, unsigned from, const costmap::CostGrid::Weight* weights,
          std::ptrdiff_t stride) const;

 private:
  template <bool kForward>
  bool deadAt(std::size_t lane, unsigned at) const;

  std::size_t words_per_lane_ = 0;
  std::vector<Word> words_;
};

template <bool kForward>
StraightJumpTable::Run StraightJumpTable::run(std::size_t lane, unsigned from,
                                              const costmap::CostGrid::Weight* weights,
                                              std::ptrdiff_t stride) const {
  constexpr int kSide = kForward ? 0 : 1;
  const Word* word = &this->word(lane, from);
  const unsigned bit = from & 63U;
  const std::uint64_t before = (std::uint64_t{1} << bit) - 1;
  const std::uint64_t after = ~before << 1;
  std::uint64_t stops = word->stop[kSide] & (kForward ? after : before);
  std::uint64_t changes = word->change & (kForward ? ~before : before);
  std::int64_t base = from & ~63U;
  std::int64_t at = from;
  std::uint64_t weight = weights[at * stride];
  std::uint64_t sum = 0;
  for (;;) {
    const bool stopped = stops != 0;
    unsigned stop = 0;
    if (stopped) {
      stop = kForward ? unsigned(__builtin_ctzll(stops)) : 63U - unsigned(__builtin_clzll(stops));
      const std::uint64_t below_stop = (std::uint64_t{1} << stop) - 1;
      changes &= kForward ? below_stop : ~below_stop;
    }
    while (changes != 0) {
      const unsigned change =
          kForward ? unsigned(__builtin_ctzll(changes)) : 63U - unsigned(__builtin_clzll(changes));
      changes &= ~(std::uint64_t{1} << change);
      const std::int64_t last = base + change + (kForward ? 0 : 1);
      const std::int64_t next = base + change + (kForward ? 1 : 0);
      sum += weight * std::uint64_t(kForward ? last - at : at - last);
      const std::uint64_t next_weight = weights[next * stride];
      sum += weight > next_weight ? weight : next_weight;
      weight = next_weight;
      at = next;
    }
    if (stopped) {
      const std::int64_t to = base + stop;
      sum += weight * std::uint64_t(kForward ? to - at : at - to);
      return {unsigned(to), sum};
    }
    word += kForward ? 1 : -1;
    base += kForward ? 64 : -64;
    stops = word->stop[kSide];
    changes = word->change;
  }
}

}  // namespace grid_path_planner::planners
