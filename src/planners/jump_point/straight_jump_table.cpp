#include "planners/jump_point/straight_jump_table.h"

namespace grid_path_planner::planners {

using Bits = StraightJumpTable::Bits;

namespace {

void writeBit(Bits& word, unsigned at, bool value) {
  const Bits bit = Bits{1} << (at & 63U);
  word = value ? word | bit : word & ~bit;
}

// Each bit is that of the nearest `seed` ahead, where only cells of `pass` lie between.
template <bool kForward>
Bits spread(Bits seed, Bits pass) {
  for (unsigned shift = 1; shift < 64; shift *= 2) {
    seed |= pass & (kForward ? seed >> shift : seed << shift);
    pass &= kForward ? pass >> shift : pass << shift;
  }
  return seed;
}

}  // namespace

template <bool kForward>
void StraightJumpTable::writeStops(Word& word, Bits stops, Bits dead, End next) {
  constexpr int kSide = kForward ? 0 : 1;
  constexpr Bits kLast = kForward ? Bits{1} << 63 : 1;
  const auto ahead = [](Bits bits) { return kForward ? bits >> 1 : bits << 1; };
  const Bits pass = ahead(~stops);  // the next cell is no stop
  word.pass[kSide] = ~stops;
  word.known[kSide] = spread<kForward>(ahead(stops) | (next != End::UNKNOWN ? kLast : 0), pass);
  word.dead_end[kSide] =
      spread<kForward>(ahead(stops & dead) | (next == End::DEAD ? kLast : 0), pass);
}

// Whether the cells before have this end, or need none: where there are none, and while theirs is
// not known.
template <bool kForward>
bool StraightJumpTable::endsBeforeAre(std::size_t line, unsigned at, End end) const {
  if (kForward ? at == 0 : at + 1 == words_per_line_ * 64) return true;
  const End before = this->end<kForward>(line, kForward ? at - 1 : at + 1);
  return before == end || before == End::UNKNOWN;
}

template <bool kForward>
void StraightJumpTable::setStop(std::size_t line, unsigned at, bool stop, bool dead) {
  const End end = dead ? End::DEAD : End::LIVE;
  const bool was_stop = isStop<kForward>(line, at);
  if (was_stop == stop && (!stop || endsBeforeAre<kForward>(line, at, end))) return;
  writeBit(word(line, at).pass[kForward ? 0 : 1], at, !stop);
  setEndsBefore<kForward>(line, at, stop ? end : this->end<kForward>(line, at));
}

template <bool kForward>
void StraightJumpTable::setEndsBefore(std::size_t line, unsigned at, End end) {
  constexpr int kSide = kForward ? 0 : 1;
  Word* word = &this->word(line, at);
  const std::int64_t last = std::int64_t(words_per_line_) - 1;
  const Bits before = (Bits{1} << (at & 63U)) - 1;
  Bits reach = kForward ? before : ~before << 1;  // cells of the word whose jumps may end here
  for (std::int64_t number = at / 64;;) {
    const Bits stops = ~word->pass[kSide] & reach;
    if (stops != 0) {  // only from the nearest of them on
      const unsigned nearest =
          kForward ? 63U - unsigned(__builtin_clzll(stops)) : unsigned(__builtin_ctzll(stops));
      const Bits below = (Bits{1} << nearest) - 1;
      reach &= kForward ? ~below : below << 1 | 1U;
    }
    Bits& dead_end = word->dead_end[kSide];
    Bits& known = word->known[kSide];
    dead_end = end == End::DEAD ? dead_end | reach : dead_end & ~reach;
    known = end != End::UNKNOWN ? known | reach : known & ~reach;
    number += kForward ? -1 : 1;
    if (stops != 0 || number < 0 || number > last) return;
    word += kForward ? -64 : 64;
    reach = ~Bits{0};
  }
}

template void StraightJumpTable::writeStops<true>(Word&, Bits, Bits, End);
template void StraightJumpTable::writeStops<false>(Word&, Bits, Bits, End);
template void StraightJumpTable::setStop<true>(std::size_t, unsigned, bool, bool);
template void StraightJumpTable::setStop<false>(std::size_t, unsigned, bool, bool);
template void StraightJumpTable::setEndsBefore<true>(std::size_t, unsigned, End);
template void StraightJumpTable::setEndsBefore<false>(std::size_t, unsigned, End);

}  // namespace grid_path_planner::planners
