#include "planners/jump_point/jump_point_density.h"

#include <algorithm>

#include "planners/jump_point/row_neighbours.h"

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using costmap::BitMap, costmap::BitMaps;
using grid::CellRect;

namespace {

using Word = BitMap::Word;

constexpr int kSampledRows = 128;  // some 10 microseconds on 1024x1024 cells

int count(Word bits) {
  return __builtin_popcountll(bits);
}
// Where a cell is free and the one before (after) it is not.
Word begins(const Word* at) {
  return *at & ~before(at);
}
Word ends(const Word* at) {
  return *at & ~after(at);
}
// Jump points of the vertical step from the row `from` to the row `to`.
Word verticalJumpPoints(const Word* from, const Word* to) {
  return *from & *to & ((~before(from) & before(to)) | (~after(from) & after(to)));
}

}  // namespace

void JumpPointDensity::sample(const BitMaps& free, const StopToken& stop) {
  const int height = free.rows.height();
  stride_ = std::max(1, (height + kSampledRows - 1) / kSampledRows);
  rows_.assign(std::size_t((height + stride_ - 1) / stride_), Counts());
  all_ = Counts();
  StopPoll poll(stop, 16);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    poll();
    replace(free.rows, int(i));
  }
}

void JumpPointDensity::update(const BitMaps& free, const CellRect& changed) {
  const CellRect near =
      changed.grown(1).intersection({0, 0, free.rows.width(), free.rows.height()});
  const int last = near.row + near.height - 1;
  for (int i = near.row / stride_; i <= last / stride_; ++i)
    if (rowOf(i) >= near.row && rowOf(i) <= last) replace(free.rows, i);
}

// One at random of every stride_ rows, as maps repeat themselves.
int JumpPointDensity::rowOf(int sample) const {
  const std::uint32_t random = std::uint32_t(sample) * 0x9E3779B1U >> 16;
  return sample * stride_ + int(random % std::uint32_t(stride_));
}

void JumpPointDensity::replace(const BitMap& free, int sample) {
  Counts& counts = rows_[std::size_t(sample)];
  const Counts now = rowOf(sample) < free.height() ? countRow(free, rowOf(sample)) : Counts();
  all_.free += now.free - counts.free;
  all_.borders += now.borders - counts.borders;
  all_.jump_points += now.jump_points - counts.jump_points;
  counts = now;
}

JumpPointDensity::Counts JumpPointDensity::countRow(const BitMap& free, int row) {
  Counts counts;
  for (int word = 0; word < free.words(); ++word) {
    const Word* at = free.row(row) + word;
    const Word* low = free.row(row - 1) + word;
    const Word* high = free.row(row + 1) + word;
    counts.free += count(*at);
    counts.borders +=
        count(begins(at)) + count(ends(at)) + count(*at & ~*low) + count(*at & ~*high);
    counts.jump_points += count(*at & before(at) & (begins(low) | begins(high))) +
                          count(*at & after(at) & (ends(low) | ends(high))) +
                          count(verticalJumpPoints(low, at)) + count(verticalJumpPoints(high, at));
  }
  return counts;
}

// Noise has 0.38 to 1.1 of jump points squared over borders and free cells, mazes with corridors of one
// cell 0.21, caves 0.18, cities 0.03.
bool JumpPointDensity::aStarPays() const {
  return 100 * all_.jump_points * all_.jump_points > 27 * all_.borders * all_.free;
}

bool JumpPointDensity::jumpsPay() const {
  return aStarPays() ? 10 * all_.borders >= 9 * all_.free : 5 * all_.jump_points > all_.free;
}

}  // namespace grid_path_planner::planners
