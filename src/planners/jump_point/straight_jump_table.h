// Where straight jumps over weighted cells end and what they cost: bits for all rows, or all
// columns, of a map, 64 cells in a word.
//
//   if (table.deadEnd<true>(row, column)) return;  // a jump forwards reaches nothing
//   StraightJumpTable::Jump jump = table.straightJump<true>(row, column, weights, 1);
//   use(jump.to, jump.weights);  // the cell where the jump ends, and the cost of its steps
//
// A jump goes on until the first cell that is a stop in its direction. A stop is dead where no step
// leads on. A cell is a dead end in a direction where the jump from it ends at a dead stop, so that
// a useless jump costs one bit test. One more bit says where the weight changes to the next cell: a
// jump over a plateau is priced by counting. The caller decides which cells are stops, and dead
// (planners/jump_point/weighted_jump_map.h). Every line must end in a stop in both directions.
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
    std::uint64_t open;  // for the caller: nine cells of one weight, this one in the middle
  };

  static std::size_t bytesFor(std::size_t lines, std::size_t length) {
    return lines * ((length + 63) / 64) * sizeof(Word);
  }

  // No stops, no changes.
  void reset(std::size_t lines, std::size_t length) {
    words_per_line_ = (length + 63) / 64;
    words_.assign(lines * words_per_line_, Word{});
  }

  const Word& word(std::size_t line, unsigned at) const {
    return words_[line * words_per_line_ + at / 64];
  }
  Word& word(std::size_t line, unsigned at) { return words_[line * words_per_line_ + at / 64]; }

  template <bool kForward>
  bool deadEnd(std::size_t line, unsigned at) const {
    return (word(line, at).dead_end[kForward ? 0 : 1] >> (at & 63U) & 1U) != 0;
  }

  // Makes a cell a stop of one direction, dead or not, or no stop, and updates the dead ends before
  // it.
  template <bool kForward>
  void setStop(std::size_t line, unsigned at, bool stop, bool dead);

  struct Jump {
    unsigned to;            // the stop
    std::uint64_t weights;  // sum of max(weight, weight) over the steps
  };
  // `weights`: of the line's first cell; `stride`: from each cell's to the next one's.
  // Precondition: the step to the next cell is legal.
  template <bool kForward>
  Jump straightJump(std::size_t line, unsigned from, const costmap::CostGrid::Weight* weights,
                    std::ptrdiff_t stride) const;

 private:
  template <bool kForward>
  bool deadEndBefore(std::size_t line, unsigned at) const;

  std::size_t words_per_line_ = 0;
  std::vector<Word> words_;
};

template <bool kForward>
StraightJumpTable::Jump StraightJumpTable::straightJump(std::size_t line, unsigned from,
                                                        const costmap::CostGrid::Weight* weights,
                                                        std::ptrdiff_t stride) const {
  constexpr int kSide = kForward ? 0 : 1;
  const Word* word = &this->word(line, from);
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
