// Where straight jumps over weighted cells end and what they cost: bits for all rows, or all
// columns, of a map, 64 cells in a word.
//
//   using End = StraightJumpTable::End;
//   if (table.end<true>(row, column) == End::DEAD) return;  // a jump forwards reaches nothing
//   StraightJumpTable::Jump jump = table.straightJump<true>(row, column, weights, 1);
//   use(jump.to, jump.weights);  // the cell where the jump ends, and the cost of its steps
//
// A jump goes on until the first cell that is a stop in its direction. A stop is dead where no step
// leads on. A cell is a dead end in a direction where the jump from it ends at a dead stop, so that
// a useless jump costs one bit test. One more bit says where the weight changes to the next cell: a
// jump over a plateau is priced by counting. The caller decides which cells are stops, and dead
// (planners/jump_point/weighted_jump_map.h). Every line must end in a stop in both directions.
//
// Lines are filled piece by piece: all cells of a word that was not written are stops, and where
// the jump from a cell leaves the written words, its end() is UNKNOWN until setEndsBefore() tells
// it. The words of 64 lines lie together, so that a tile of 64x64 cells is one page of memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/zeroed_array.h"
#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::planners {

class StraightJumpTable {
 public:
  using Bits = std::uint64_t;

  // Pairs are of the jumps forwards and of those backwards.
  struct Word {
    std::array<Bits, 2> pass;      // no stop
    std::array<Bits, 2> dead_end;  // end() is DEAD
    std::array<Bits, 2> known;     // end() is not UNKNOWN
    Bits change;                   // of the weight to the next cell
    Bits open;  // for the caller: nine cells of one weight, this one in the middle
  };
  static_assert(sizeof(Word) == 64, "a cache line");

  // What the jump from a cell ends at.
  enum class End { UNKNOWN, LIVE, DEAD };

  static std::size_t bytesFor(std::size_t lines, std::size_t length) {
    return (lines + 63) / 64 * ((length + 63) / 64) * 64 * sizeof(Word);
  }

  // No word is written, no changes.
  void reset(std::size_t lines, std::size_t length) {
    words_per_line_ = (length + 63) / 64;
    words_ = base::ZeroedArray<Word>((lines + 63) / 64 * words_per_line_ * 64);
  }

  const Word& word(std::size_t line, unsigned at) const { return words_[indexOf(line, at)]; }
  Word& word(std::size_t line, unsigned at) { return words_[indexOf(line, at)]; }

  template <bool kForward>
  End end(std::size_t line, unsigned at) const {
    constexpr int kSide = kForward ? 0 : 1;
    const Word& word = this->word(line, at);
    if ((word.dead_end[kSide] >> (at & 63U) & 1U) != 0) return End::DEAD;
    return (word.known[kSide] >> (at & 63U) & 1U) != 0 ? End::LIVE : End::UNKNOWN;
  }
  template <bool kForward>
  bool isStop(std::size_t line, unsigned at) const {
    return (word(line, at).pass[kForward ? 0 : 1] >> (at & 63U) & 1U) == 0;
  }

  // Writes the stops of a word, `dead` ones among them, and its ends. `next`: what the jump from the
  // last cell of the word ends at.
  template <bool kForward>
  static void writeStops(Word& word, Bits stops, Bits dead, End next);

  // Makes a cell of a written word a stop of one direction, dead or not, or no stop, and updates the
  // ends before it.
  template <bool kForward>
  void setStop(std::size_t line, unsigned at, bool stop, bool dead);

  // The ends of the cells from the stop before this cell to the cell before this one.
  template <bool kForward>
  void setEndsBefore(std::size_t line, unsigned at, End end);

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
  bool endsBeforeAre(std::size_t line, unsigned at, End end) const;

  std::size_t indexOf(std::size_t line, unsigned at) const {
    return ((line / 64) * words_per_line_ + at / 64) * 64 + line % 64;
  }

  std::size_t words_per_line_ = 0;
  base::ZeroedArray<Word> words_;
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
  std::uint64_t stops = ~word->pass[kSide] & (kForward ? after : before);
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
    word += kForward ? 64 : -64;
    base += kForward ? 64 : -64;
    stops = ~word->pass[kSide];
    changes = word->change;
  }
}

}  // namespace grid_path_planner::planners
