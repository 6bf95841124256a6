#include "planners/any_angle/lattice_bits.h"

#include <algorithm>

namespace grid_path_planner::planners {

using base::StopPoll;
using base::StopToken;
using costmap::BitMap;
using grid::CellRect;

namespace {

using Word = BitMap::Word;

// The bits of the next column, and of the column before.
Word right(const Word* row, int word) {
  return row[word] >> 1 | row[word + 1] << 63;
}
Word left(const Word* row, int word) {
  return row[word] << 1 | row[word - 1] >> 63;
}

void writeSquares(const BitMap& passable, int row, BitMap& squares) {
  const Word *here = passable.row(row), *above = passable.row(row + 1);
  for (int i = 0; i < passable.words(); ++i)
    squares.row(row)[i] = here[i] & above[i] & right(here, i) & right(above, i);
}

void writePortals(const BitMap& passable, const BitMap& squares, int row, BitMap& portals) {
  const Word *here = passable.row(row), *above = passable.row(row + 1);
  const Word* below = passable.row(row - 1);
  const Word *upper = squares.row(row), *lower = squares.row(row - 1);
  for (int i = 0; i < passable.words(); ++i) {
    const Word ne = upper[i], nw = left(upper, i), se = lower[i], sw = left(lower, i);
    const Word thin = (right(here, i) & ~ne & ~se) | (left(here, i) & ~nw & ~sw) |
                      (above[i] & ~ne & ~nw) | (below[i] & ~se & ~sw);
    const Word meeting = (ne & sw & ~nw & ~se) | (nw & se & ~ne & ~sw);
    portals.row(row)[i] = here[i] & (thin | meeting);
  }
}

}  // namespace

LatticeBits::LatticeBits(const BitMap& passable, const StopToken& stop)
    : squares(passable.width(), passable.height()), portals(passable.width(), passable.height()) {
  update(passable, {0, 0, passable.width(), passable.height()}, stop);
}

void LatticeBits::update(const BitMap& passable, const CellRect& changed, const StopToken& stop) {
  const int height = passable.height();
  const int first = std::max(0, changed.row - 1);
  StopPoll poll(stop, 64);
  for (int row = first; row < std::min(height, changed.row + changed.height); ++row) {
    poll();
    writeSquares(passable, row, squares);
  }
  for (int row = first; row < std::min(height, changed.row + changed.height + 1); ++row) {
    poll();
    writePortals(passable, squares, row, portals);
  }
}

}  // namespace grid_path_planner::planners
