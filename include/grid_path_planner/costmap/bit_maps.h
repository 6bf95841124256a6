// One bit a cell, for scans that look at 64 cells at a time.
//
//   const BitMaps& bits = map.bitMaps(stop);           // made at the first asking, then shared
//   const BitMap::Word* row = bits.rows.row(7);        // bit i of row[k]: cell (64 k + i, 7)
//   const BitMap::Word* column = bits.columns.row(3);  // bit i of column[k]: cell (3, 64 k + i)
//
// `columns` is `rows` transposed, so a vertical scan reads neighbouring words too. A row is
// surrounded by words of zeros: row(-1) and row(height) exist, and so do row(r)[-1] and
// row(r)[words()], which are 0, as are the bits beyond the width. So a scan for the next 0 ends
// inside the memory, and every neighbour of a cell of the map may be looked at without asking.
#pragma once

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

  // What bytes() of such a map is.
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

  // `weights` differs from what the bits were made of only inside `changed`. Looks at the blocks of
  // 64x64 cells that hold cells of it. Throws Stopped, and is to be called again then.
  void update(const grid::Grid<std::uint16_t>& weights, const grid::CellRect& changed,
              const base::StopToken& stop);

  static std::size_t bytesFor(const grid::GridGeometry& geometry);
  std::size_t bytes() const { return rows.bytes() + columns.bytes(); }
};

}  // namespace grid_path_planner::costmap
