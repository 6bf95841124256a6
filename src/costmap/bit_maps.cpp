#include "grid_path_planner/costmap/bit_maps.h"

#include <algorithm>

namespace grid_path_planner::costmap {

using base::StopPoll, base::StopToken;
using grid::CellRect, grid::Grid, grid::GridGeometry;

namespace {

constexpr int kBits = BitMap::kWordBits;
using Word = BitMap::Word;

std::ptrdiff_t strideFor(int width) {
  return (std::ptrdiff_t{width} + kBits - 1) / kBits + 1;
}

std::size_t wordsFor(int width, int height) {
  return static_cast<std::size_t>((std::ptrdiff_t{height} + 2) * strideFor(width) + 1);
}

Word packed(const std::uint16_t* weights, int count) {
  Word word = 0;
  for (int i = 0; i < count; ++i) word |= static_cast<Word>(weights[i] != 0) << i;
  return word;
}

}  // namespace

// Halves are swapped across the diagonal, then the halves of the halves (Warren, Hacker's Delight,
// 7-3).
void transpose(BitBlock& block) {
  Word mask = 0x00000000FFFFFFFFU;
  for (int half = kBits / 2; half != 0; half /= 2, mask ^= mask << half)
    for (int i = 0; i < kBits; i = ((i | half) + 1) & ~half) {
      const Word swapped = (block[i] >> half ^ block[i | half]) & mask;
      block[i] ^= swapped << half;
      block[i | half] ^= swapped;
    }
}

namespace {

// The block of 64x64 cells whose first cell is (column, row), both multiples of 64.
void transposeBlock(const BitMap& rows, BitMap& columns, int column, int row) {
  BitBlock block{};
  const int height = std::min(kBits, rows.height() - row);
  for (int i = 0; i < height; ++i) block[i] = rows.row(row + i)[column / kBits];
  transpose(block);
  const int width = std::min(kBits, columns.height() - column);
  for (int i = 0; i < width; ++i) columns.row(column + i)[row / kBits] = block[i];
}

}  // namespace

BitMap::BitMap(int width, int height)
    : width_(width), height_(height), stride_(strideFor(width)), words_(wordsFor(width, height)) {}

std::size_t BitMap::bytesFor(int width, int height) {
  return wordsFor(width, height) * sizeof(Word);
}

BitMaps::BitMaps(const Grid<std::uint16_t>& weights, const StopToken& stop)
    : rows(weights.width(), weights.height()), columns(weights.height(), weights.width()) {
  update(weights, weights.geometry().rect(), stop);
}

void BitMaps::update(const Grid<std::uint16_t>& weights, const CellRect& changed,
                     const StopToken& stop) {
  const CellRect rect = changed.intersection(weights.geometry().rect());
  if (rect.empty()) return;
  const int first_word = rect.column / kBits;
  const int last_word = (rect.column + rect.width - 1) / kBits;
  StopPoll poll(stop, 64);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    for (int word = first_word; word <= last_word; ++word)
      rows.row(row)[word] = packed(weights.row(row) + std::ptrdiff_t{word} * kBits,
                                   std::min(kBits, weights.width() - word * kBits));
  }
  for (int row = rect.row / kBits * kBits; row < rect.row + rect.height; row += kBits) {
    poll();
    for (int word = first_word; word <= last_word; ++word)
      transposeBlock(rows, columns, word * kBits, row);
  }
}

std::size_t BitMaps::bytesFor(const GridGeometry& geometry) {
  return BitMap::bytesFor(geometry.width(), geometry.height()) +
         BitMap::bytesFor(geometry.height(), geometry.width());
}

}  // namespace grid_path_planner::costmap
