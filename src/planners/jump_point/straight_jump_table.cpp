#include "planners/jump_point/straight_jump_table.h"

namespace grid_path_planner::planners {
namespace {

void writeBit(std::uint64_t& word, unsigned at, bool value) {
  const std::uint64_t bit = std::uint64_t{1} << (at & 63U);
  word = value ? word | bit : word & ~bit;
}

bool readBit(std::uint64_t word, unsigned at) {
  return (word >> (at & 63U) & 1U) != 0;
}

}  // namespace

// Whether the cell before a stop is a dead end; true where there is none.
template <bool kForward>
bool StraightJumpTable::deadEndBefore(std::size_t line, unsigned at) const {
  if (kForward ? at == 0 : at + 1 == words_per_line_ * 64) return true;
  const unsigned before = kForward ? at - 1 : at + 1;
  return readBit(word(line, before).dead_end[kForward ? 0 : 1], before);
}

// All cells from the stop before to the cell before this one have the same dead-end bit.
template <bool kForward>
void StraightJumpTable::setStop(std::size_t line, unsigned at, bool stop, bool dead) {
  constexpr int kSide = kForward ? 0 : 1;
  Word* word = &this->word(line, at);
  const bool was_stop = readBit(word->stop[kSide], at);
  if (was_stop == stop && (!stop || deadEndBefore<kForward>(line, at) == dead)) return;
  writeBit(word->stop[kSide], at, stop);
  const bool value = stop ? dead : readBit(word->dead_end[kSide], at);
  const std::int64_t last = std::int64_t(words_per_line_) - 1;
  const unsigned bit = at & 63U;
  const std::uint64_t before = (std::uint64_t{1} << bit) - 1;
  std::uint64_t reach =
      kForward ? before : ~before << 1;  // cells of the word whose jumps may end here
  for (std::int64_t number = at / 64;;) {
    const std::uint64_t stops = word->stop[kSide] & reach;
    if (stops != 0) {  // only from the nearest of them on
      const unsigned nearest =
          kForward ? 63U - unsigned(__builtin_clzll(stops)) : unsigned(__builtin_ctzll(stops));
      const std::uint64_t below = (std::uint64_t{1} << nearest) - 1;
      reach &= kForward ? ~below : below << 1 | 1U;
    }
    word->dead_end[kSide] = value ? word->dead_end[kSide] | reach : word->dead_end[kSide] & ~reach;
    number += kForward ? -1 : 1;
    if (stops != 0 || number < 0 || number > last) return;
    word += kForward ? -1 : 1;
    reach = ~std::uint64_t{0};
  }
}

template void StraightJumpTable::setStop<true>(std::size_t, unsigned, bool, bool);
template void StraightJumpTable::setStop<false>(std::size_t, unsigned, bool, bool);

}  // namespace grid_path_planner::planners
