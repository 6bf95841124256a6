#include "planners/jump_point/jump_point_bits.h"

#include <algorithm>

#include "planners/jump_point/row_neighbours.h"

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using costmap::BitBlock, costmap::BitMap, costmap::BitMaps, costmap::transpose, costmap::zeroBefore,
    costmap::zeroFrom;
using grid::CellRect, grid::GridGeometry;

namespace {

using Word = BitMap::Word;
constexpr int kBits = BitMap::kWordBits;

// Of 64 cells of a line, those from which the jump towards higher (lower) bits ends at a jump
// point. The jump stops at `jump_points` and goes on over `passes`. `carry`: whether the neighbour
// of the last (first) cell in the next word is a jump point or leads to one; becomes the same for
// the word after.
Word leadsUp(Word jump_points, Word passes, Word& carry) {
  Word good = jump_points | (passes & carry << 63);
  for (int shift = 1; shift < kBits; shift *= 2) {
    good |= passes & good >> shift;
    passes &= passes >> shift;
  }
  const Word leads = good >> 1 | carry << 63;
  carry = good & 1U;
  return leads;
}
Word leadsDown(Word jump_points, Word passes, Word& carry) {
  Word good = jump_points | (passes & carry);
  for (int shift = 1; shift < kBits; shift *= 2) {
    good |= passes & good << shift;
    passes &= passes << shift;
  }
  const Word leads = good << 1 | carry;
  carry = good >> 63;
  return leads;
}

// The carry for word `index` of a line, from the words with higher (lower) bits.
Word carryFromAbove(const Word* free, const Word* passes, int index) {
  for (++index; true; ++index)
    if (const Word stops = ~passes[index]; stops != 0)
      return free[index] >> __builtin_ctzll(stops) & 1U;
}
Word carryFromBelow(const Word* free, const Word* passes, int index) {
  for (--index; true; --index)
    if (const Word stops = ~passes[index]; stops != 0)
      return free[index] >> (63 - __builtin_clzll(stops)) & 1U;
}

constexpr int wordOf(int position) {
  return position / kBits;
}

}  // namespace

void JumpPointBits::build(const BitMaps& free, const StopToken& stop) {
  const int width = free.rows.width();
  const int height = free.rows.height();
  for (int step = 0; step < 4; ++step) {
    passes_[step] = step % 2 == 0 ? BitMap(width, height) : BitMap(height, width);
    leads_[step] = BitMap(width, height);
    diagonals_[step] = DiagonalJumpBits(width, height);
  }
  update(free, {0, 0, width, height}, stop);
}

void JumpPointBits::update(const BitMaps& free, const CellRect& changed, const StopToken& stop) {
  const CellRect rect =
      changed.grown(1).intersection({0, 0, free.rows.width(), free.rows.height()});
  if (changed.empty() || rect.empty()) return;
  const Range columns{rect.column, rect.column + rect.width - 1};
  const Range rows{rect.row, rect.row + rect.height - 1};
  StopPoll poll(stop, 64);

  // 1. Where straight jumps stop.
  for (int row = rows.first; row <= rows.last; ++row) {
    poll();
    markStraightStops(free.rows, row, wordOf(columns.first), wordOf(columns.last), 0);
  }
  for (int column = columns.first; column <= columns.last; ++column) {
    poll();
    markStraightStops(free.columns, column, wordOf(rows.first), wordOf(rows.last), 1);
  }

  // 2. Where vertical jumps lead: blocks of 64 columns, as far as any of them is affected.
  for (int word = wordOf(columns.first); word <= wordOf(columns.last); ++word) {
    Range affected = rows;
    for (int column = std::max(columns.first, word * kBits);
         column <= std::min(columns.last, word * kBits + kBits - 1); ++column) {
      const Range in_column = affectedRange(1, column, rows);
      affected = {std::min(affected.first, in_column.first),
                  std::max(affected.last, in_column.last)};
    }
    poll();
    markColumnLeads(free.columns, word, wordOf(affected.first), wordOf(affected.last));
    for (int row = affected.first; row <= affected.last; ++row) {
      poll();
      if (row < rows.first || row > rows.last) markDiagonalStops(free.rows, row, word, word);
    }
  }

  // 3. Where horizontal jumps lead, and where diagonal ones stop because of that or of the change.
  for (int row = rows.first; row <= rows.last; ++row) {
    poll();
    const Range affected = affectedRange(0, row, columns);
    markRowLeads(free.rows, row, wordOf(affected.first), wordOf(affected.last));
    markDiagonalStops(free.rows, row, wordOf(affected.first), wordOf(affected.last));
  }
}

// Axis 0: `line` is a row of `free`; axis 1: a column of the map, `free` being transposed.
void JumpPointBits::markStraightStops(const BitMap& free, int line, int first_word, int last_word,
                                      int axis) {
  for (int index = first_word; index <= last_word; ++index) {
    const Word* at = free.row(line) + index;
    const Word* low = free.row(line - 1) + index;
    const Word* high = free.row(line + 1) + index;
    const Word jump_points_up = (*low & ~before(low)) | (*high & ~before(high));
    const Word jump_points_down = (*low & ~after(low)) | (*high & ~after(high));
    passes_[axis].row(line)[index] = *at & ~jump_points_up;
    passes_[axis + 2].row(line)[index] = *at & ~jump_points_down;
  }
}

JumpPointBits::Range JumpPointBits::affectedRange(int axis, int line, Range changed) const {
  const int first = zeroBefore(passes_[axis].row(line), changed.first);
  const int last = zeroFrom(passes_[axis + 2].row(line), changed.last + 1);
  return {std::max(first, 0), std::min(last, passes_[axis].width() - 1)};
}

void JumpPointBits::markRowLeads(const BitMap& free, int row, int first_word, int last_word) {
  const Word* at = free.row(row);
  const Word* east = passes_[0].row(row);
  const Word* west = passes_[2].row(row);
  Word carry = carryFromAbove(at, east, last_word);
  for (int index = last_word; index >= first_word; --index)
    leads_[0].row(row)[index] = at[index] & leadsUp(at[index] & ~east[index], east[index], carry);
  carry = carryFromBelow(at, west, first_word);
  for (int index = first_word; index <= last_word; ++index)
    leads_[2].row(row)[index] = at[index] & leadsDown(at[index] & ~west[index], west[index], carry);
}

// For the 64 columns of `word`: computed on columns, transposed back in blocks of 64 rows.
void JumpPointBits::markColumnLeads(const BitMap& free, int word, int first_block, int last_block) {
  const int first_column = word * kBits;
  const int count = std::min(kBits, free.height() - first_column);
  BitBlock block{};
  const auto write = [&](BitMap& leads, int index) {
    transpose(block);
    const int rows = std::min(kBits, leads.height() - index * kBits);
    for (int i = 0; i < rows; ++i) leads.row(index * kBits + i)[word] = block[i];
    block.fill(0);
  };
  std::array<Word, kBits> carry{};
  for (int i = 0; i < count; ++i)
    carry[i] =
        carryFromAbove(free.row(first_column + i), passes_[1].row(first_column + i), last_block);
  for (int index = last_block; index >= first_block; --index) {
    for (int i = 0; i < count; ++i) {
      const Word at = free.row(first_column + i)[index];
      const Word passes = passes_[1].row(first_column + i)[index];
      block[i] = at & leadsUp(at & ~passes, passes, carry[i]);
    }
    write(leads_[1], index);
  }
  for (int i = 0; i < count; ++i)
    carry[i] =
        carryFromBelow(free.row(first_column + i), passes_[3].row(first_column + i), first_block);
  for (int index = first_block; index <= last_block; ++index) {
    for (int i = 0; i < count; ++i) {
      const Word at = free.row(first_column + i)[index];
      const Word passes = passes_[3].row(first_column + i)[index];
      block[i] = at & leadsDown(at & ~passes, passes, carry[i]);
    }
    write(leads_[3], index);
  }
}

void JumpPointBits::markDiagonalStops(const BitMap& free, int row, int first_word, int last_word) {
  const auto marks = [](Word entered, Word horizontal, Word vertical) {
    return DiagonalJumpBits::Marks{entered & ~horizontal & ~vertical, entered & horizontal,
                                   entered & vertical};
  };
  for (int index = first_word; index <= last_word; ++index) {
    const Word* at = free.row(row) + index;
    const Word* low = free.row(row - 1) + index;
    const Word* high = free.row(row + 1) + index;
    const Word from_west = *at & before(at);
    const Word from_east = *at & after(at);
    const Word east = leads_[0].row(row)[index], west = leads_[2].row(row)[index];
    const Word up = leads_[1].row(row)[index], down = leads_[3].row(row)[index];
    diagonals_[0].write(row, index, marks(from_west & *low & before(low), east, up));
    diagonals_[1].write(row, index, marks(from_east & *low & after(low), west, up));
    diagonals_[2].write(row, index, marks(from_east & *high & after(high), west, down));
    diagonals_[3].write(row, index, marks(from_west & *high & before(high), east, down));
  }
}

std::size_t JumpPointBits::bytesFor(const GridGeometry& geometry) {
  return 6 * BitMap::bytesFor(geometry.width(), geometry.height()) +
         2 * BitMap::bytesFor(geometry.height(), geometry.width()) +
         4 * DiagonalJumpBits::bytesFor(geometry.width(), geometry.height());
}

std::size_t JumpPointBits::bytes() const {
  std::size_t bytes = 0;
  for (int step = 0; step < 4; ++step)
    bytes += passes_[step].bytes() + leads_[step].bytes() + diagonals_[step].bytes();
  return bytes;
}

}  // namespace grid_path_planner::planners
