// What a diagonal way wants to know of the cells it enters, in tiles of 8x8 cells: up to eight of
// its steps lie in one word, where row by row each would lie in a word, and a cache line, of its
// own.
//
// Tiles in which nothing can be entered surround the map, and so do such cells beside it: a way
// ends inside the memory.
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

  // A bit a cell: it is entered and one goes on; it is entered and one step's straight way, to its
  // side or its height, leads to a turn. No bit: it cannot be entered.
  struct Marks {
    Word pass = 0;
    Word side = 0;
    Word height = 0;

    friend bool operator==(const Marks& a, const Marks& b) {
      return a.pass == b.pass && a.side == b.side && a.height == b.height;
    }
  };

  DiagonalJumpBits() : DiagonalJumpBits(0, 0) {}
  DiagonalJumpBits(int width, int height)
      : stride_((std::ptrdiff_t{width} + 7) / 8 + 2), tiles_(tilesFor(width, height)) {}

  static std::size_t bytesFor(int width, int height) {
    return tilesFor(width, height) * sizeof(Marks);
  }
  std::size_t bytes() const { return tiles_.size() * sizeof(Marks); }

  // Bits i of `marks` become those of the cell (64 word + i, row); beside the map they must be 0.
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
      put(tile->side, marks.side);
      put(tile->height, marks.height);
    }
  }

  struct Stop {
    int steps;  // to the first cell that is no pass
    bool side;  // its marks: neither where it cannot be entered
    bool height;
  };
  // From `cell` by steps of (columns, rows), each 1 or -1.
  template <int columns, int rows>
  Stop stop(grid::Cell cell) const {
    static constexpr auto kWays = ways<columns, rows>();
    int column = cell.column + columns;
    int row = cell.row + rows;
    while (true) {
      const Marks& tile = tiles_[static_cast<std::size_t>(index(column >> 3, row >> 3))];
      const auto& way = kWays[static_cast<std::size_t>((row & 7) * 8 + (column & 7))];
      const Word stops = ~tile.pass & way.cells;
      if (stops != 0) {
        const int bit = rows > 0 ? __builtin_ctzll(stops) : 63 - __builtin_clzll(stops);
        return {((row & ~7) + bit / 8 - cell.row) * rows, (tile.side >> bit & 1U) != 0,
                (tile.height >> bit & 1U) != 0};
      }
      column += columns * way.steps;
      row += rows * way.steps;
    }
  }

  friend bool operator==(const DiagonalJumpBits& a, const DiagonalJumpBits& b) {
    return a.stride_ == b.stride_ && a.tiles_ == b.tiles_;
  }

 private:
  // From a bit of a tile along a diagonal: the cells of the tile on it, this one too.
  struct Way {
    Word cells = 0;
    int steps = 0;
  };
  template <int columns, int rows>
  static constexpr std::array<Way, 64> ways() {
    std::array<Way, 64> all{};
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
