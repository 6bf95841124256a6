// One bit a cell, for scans that read 64 cells at a time.
//
//   const BitMaps& bits = map.bitMaps(stop);           // computed by the first call, then shared
//   const BitMap::Word* row = bits.rows.row(7);        // bit i of row[k]: cell (64 k + i, 7)
//   const BitMap::Word* column = bits.columns.row(3);  // bit i of column[k]: cell (3, 64 k + i)
//   int end = zeroFrom(row, 12);                       // the first blocked cell from column 12 on
//
// `columns` is `rows` transposed, so that a vertical scan reads neighbouring words too. A row is
// surrounded by words of zeros: row(-1) and row(height) exist, and so do row(r)[-1] and
// row(r)[words()], which are 0, as are the bits beyond the width. So a scan for the next 0 ends
// inside the memory, and every neighbour of a cell of the map can be read without a check.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/grid/grid.h"

namespace grid_path_planner::costmap {

class BitMap {
 public:
  using Word = std::uint64_t;
  static constexpr int kWordBits = 64;

  // All bits 0.
  BitMap() : BitMap(0, 0) {}
  BitMap(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  // Words that hold bits of a row; row(r + 1) - row(r) is stride().
  int words() const { return static_cast<int>(stride_) - 1; }
  std::ptrdiff_t stride() const { return stride_; }

  // Precondition: -1 <= row <= height().
  const Word* row(int row) const { return words_.data() + offset(row); }
  Word* row(int row) { return words_.data() + offset(row); }

  // Precondition: -64 <= column < 64 (words() + 1) and -1 <= row <= height().
  bool operator[](grid::Cell cell) const {
    return (row(cell.row)[cell.column >> 6] >> (cell.column & 63) & 1U) != 0;
  }
  // Precondition: the cell lies in the map.
  void set(grid::Cell cell, bool value) {
    assert(cell.column >= 0 && cell.column < width_ && cell.row >= 0 && cell.row < height_);
    Word& word = row(cell.row)[cell.column >> 6];
    const Word bit = Word{1} << (cell.column & 63);
    word = value ? word | bit : word & ~bit;
  }

  // bytes() of a map of this size.
  static std::size_t bytesFor(int width, int height);
  std::size_t bytes() const { return words_.size() * sizeof(Word); }

  friend bool operator==(const BitMap& a, const BitMap& b) {
    return a.width_ == b.width_ && a.height_ == b.height_ && a.words_ == b.words_;
  }

 private:
  std::ptrdiff_t offset(int row) const {
    assert(row >= -1 && row <= height_);
    return 1 + (std::ptrdiff_t{row} + 1) * stride_;
  }

  int width_;
  int height_;
  std::ptrdiff_t stride_;  // the words of a row and a word of zeros, which is also the next row's
  std::vector<Word> words_;
};

// 64 words of 64 bits. transpose: bit j of word i becomes bit i of word j.
using BitBlock = std::array<BitMap::Word, BitMap::kWordBits>;
void transpose(BitBlock& block);

// Bit 1: the cell's weight is not 0, so it is passable.
struct BitMaps {
  BitMap rows;
  BitMap columns;

  BitMaps() = default;
  // Throws Stopped.
  BitMaps(const grid::Grid<std::uint16_t>& weights, const base::StopToken& stop);

  // `weights` differs from the weights before only inside `changed`. Recomputes the blocks of 64x64
  // cells that hold cells of it. Throws Stopped, and must be called again then.
  void update(const grid::Grid<std::uint16_t>& weights, const grid::CellRect& changed,
              const base::StopToken& stop);

  static std::size_t bytesFor(const grid::GridGeometry& geometry);
  std::size_t bytes() const { return rows.bytes() + columns.bytes(); }
};

// Scans and fillings of a row, a word at a time. Scans rely on the zeros around the row.

inline bool bitAt(const BitMap::Word* row, int column) {
  return (row[column >> 6] >> (column & 63) & 1U) != 0;
}

// The first 0 at or after `column`. Precondition: 0 <= column <= width.
inline int zeroFrom(const BitMap::Word* row, int column) {
  int word = column >> 6;
  BitMap::Word zeros = ~row[word] >> (column & 63) << (column & 63);
  while (zeros == 0) zeros = ~row[++word];
  return word * 64 + __builtin_ctzll(zeros);
}

// The first 1 at or after `column`, or some column from `limit` on. Precondition: 0 <= column.
inline int oneFrom(const BitMap::Word* row, int column, int limit) {
  if (column >= limit) return limit;
  int word = column >> 6;
  BitMap::Word ones = row[word] >> (column & 63) << (column & 63);
  while (ones == 0) {
    if (++word * 64 >= limit) return limit;
    ones = row[word];
  }
  return word * 64 + __builtin_ctzll(ones);
}

// The last 0 before `column`, -1 at least: what follows it up to `column` is all ones.
// Precondition: 0 <= column <= width.
inline int zeroBefore(const BitMap::Word* row, int column) {
  int word = (column - 1) >> 6;  // of column 0: the word of zeros before the row
  const int shift = 63 - ((column - 1) & 63);
  BitMap::Word zeros = ~row[word] << shift >> shift;
  while (zeros == 0) zeros = ~row[--word];
  return word * 64 + 63 - __builtin_clzll(zeros);
}

// Whether all of [first, last) are ones. Precondition: 0 <= first < last <= width.
inline bool allOnes(const BitMap::Word* row, int first, int last) {
  int word = first >> 6;
  const int end = (last - 1) >> 6;
  BitMap::Word mask = ~BitMap::Word{0} << (first & 63);
  for (; word < end; ++word, mask = ~BitMap::Word{0})
    if ((~row[word] & mask) != 0) return false;
  return (~row[word] & mask) << (63 - ((last - 1) & 63)) == 0;
}

// Makes all of [first, last) ones or zeros. Precondition: 0 <= first, last <= 64 words().
inline void fillBits(BitMap::Word* row, int first, int last, bool value) {
  while (first < last) {
    const int next = std::min(last, (first | 63) + 1);
    const BitMap::Word ones = ~BitMap::Word{0} >> (64 - (next - first)) << (first & 63);
    BitMap::Word& word = row[first >> 6];
    word = value ? word | ones : word & ~ones;
    first = next;
  }
}

}  // namespace grid_path_planner::costmap
