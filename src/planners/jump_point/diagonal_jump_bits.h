// Where diagonal jumps stop, as bits in tiles of 8x8 cells: one word holds up to eight steps of a
// jump, where row by row each step would lie in another word and cache line.
//
//   DiagonalJumpBits::Stop stop = bits.stop<1, 1>(cell);
//   if (stop.horizontal) use(stop.steps);  // a straight branch leads to a jump point
//
// Tiles of cells that cannot be entered surround the map, so that every jump ends inside the
// memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::planners {

// Of one diagonal direction.
class DiagonalJumpBits {
 public:
  using Word = std::uint64_t;

  // A bit a cell. `pass`: the cell can be entered and is no stop. `horizontal`, `vertical`: it can
  // be entered and the step's straight part leads from it to a jump point. None of the three: it
  // cannot be entered.
  struct Marks {
    Word pass = 0;
    Word horizontal = 0;
    Word vertical = 0;

    friend bool operator==(const Marks& a, const Marks& b) {
      return a.pass == b.pass && a.horizontal == b.horizontal && a.vertical == b.vertical;
    }
  };

  DiagonalJumpBits() : DiagonalJumpBits(0, 0) {}
  DiagonalJumpBits(int width, int height)
      : stride_((std::ptrdiff_t{width} + 7) / 8 + 2), tiles_(tilesFor(width, height)) {}

  static std::size_t bytesFor(int width, int height) {
    return tilesFor(width, height) * sizeof(Marks);
  }
  std::size_t bytes() const { return tiles_.size() * sizeof(Marks); }

  // Sets the bits of the cells (64 word + i, row) to bits i of `marks`, which are 0 beside the map.
  void write(int row, int word, Marks marks) {
    const int shift = row % 8 * 8;
    const std::ptrdiff_t first = std::ptrdiff_t{word} * 8;
    const std::ptrdiff_t count = first + 8 <= stride_ - 2 ? 8 : stride_ - 2 - first;
    Marks* tile = tiles_.data() + index(static_cast<int>(first), row / 8);
    const auto put = [shift](Word& to, Word& from) {
      to = (to & ~(Word{255} << shift)) | (from & 255U) << shift;
      from >>= 8;
    };
    for (std::ptrdiff_t i = 0; i < count; ++i, ++tile) {
      put(tile->pass, marks.pass);
      put(tile->horizontal, marks.horizontal);
      put(tile->vertical, marks.vertical);
    }
  }

  struct Stop {
    int steps;        // to the first cell that is no pass
    bool horizontal;  // its bits: neither where it cannot be entered
    bool vertical;
  };
  // The first stop after `cell` by steps of (columns, rows), each 1 or -1.
  template <int columns, int rows>
  Stop stop(grid::Cell cell) const {
    static constexpr auto kLines = lines<columns, rows>();
    int column = cell.column + columns;
    int row = cell.row + rows;
    while (true) {
      const Marks& tile = tiles_[static_cast<std::size_t>(index(column >> 3, row >> 3))];
      const auto& line = kLines[static_cast<std::size_t>((row & 7) * 8 + (column & 7))];
      const Word stops = ~tile.pass & line.cells;
      if (stops != 0) {
        const int bit = rows > 0 ? __builtin_ctzll(stops) : 63 - __builtin_clzll(stops);
        return {((row & ~7) + bit / 8 - cell.row) * rows, (tile.horizontal >> bit & 1U) != 0,
                (tile.vertical >> bit & 1U) != 0};
      }
      column += columns * line.steps;
      row += rows * line.steps;
    }
  }

  friend bool operator==(const DiagonalJumpBits& a, const DiagonalJumpBits& b) {
    return a.stride_ == b.stride_ && a.tiles_ == b.tiles_;
  }

 private:
  // The cells of a tile on a diagonal from one of them on, which is included.
  struct Line {
    Word cells = 0;
    int steps = 0;
  };
  template <int columns, int rows>
  static constexpr std::array<Line, 64> lines() {
    std::array<Line, 64> all{};
    for (int bit = 0; bit < 64; ++bit)
      for (int column = bit % 8, row = bit / 8; column >= 0 && column < 8 && row >= 0 && row < 8;
           column += columns, row += rows) {
        all[static_cast<std::size_t>(bit)].cells |= Word{1} << (row * 8 + column);
        ++all[static_cast<std::size_t>(bit)].steps;
      }
    return all;
  }

  static std::size_t tilesFor(int width, int height) {
    return ((static_cast<std::size_t>(width) + 7) / 8 + 2) *
           ((static_cast<std::size_t>(height) + 7) / 8 + 2);
  }
  std::ptrdiff_t index(int column, int row) const {
    return (std::ptrdiff_t{row} + 1) * stride_ + column + 1;
  }

  std::ptrdiff_t stride_;
  std::vector<Marks> tiles_;
};

}  // namespace grid_path_planner::planners
