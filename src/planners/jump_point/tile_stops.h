// What a tile of 64x64 cells adds to the straight jump tables of its rows and columns, as bits:
// filled by eight cells of a row at a time, written line by line
// (planners/jump_point/weighted_jump_map.h).
#pragma once

#include <array>
#include <cstdint>

#include "grid_path_planner/costmap/bit_maps.h"
#include "planners/core/natural_moves.h"
#include "planners/jump_point/dead_ends.h"

namespace grid_path_planner::planners {

class TileStops {
 public:
  using Bits = std::uint64_t;
  using Lines = costmap::BitBlock;

  // Of a cell: bits 0 to 3: a stop of that step; 4 to 7: a dead one.
  static constexpr std::uint8_t kPass = 0;
  static constexpr std::uint8_t kBlocked = 255;
  // `steps`: those worth taking at the cell. It is a pass if only the step itself is worth taking.
  static constexpr std::uint8_t stopsOf(NaturalMoves steps) {
    constexpr NaturalMoves kStraightOn = 0x08040201U;
    constexpr NaturalMoves kStraight = 0xFFFFFFFFU;
    const unsigned pass = deadAfter((steps & kStraight) ^ kStraightOn);
    return static_cast<std::uint8_t>((~pass & 15U) | (deadAfter(steps) & 15U) << 4);
  }

  // Of a cell: bit 0: the weight changes to the next cell of the row; 1: to that of the column;
  // 2: the nine cells around have one weight.
  static constexpr std::uint8_t kRowChange = 1;
  static constexpr std::uint8_t kColumnChange = 2;
  static constexpr std::uint8_t kOpen = 4;

  // A byte a cell, the first one lowest, of the cells (8 eight + i, row).
  void add(int row, int eight, std::uint64_t stops, std::uint64_t changes) {
    addEach(stops, row, eight, all_.data());
    addEach(changes, row, eight, all_.data() + 8);
  }
  // To be called once, after the last add().
  void finish() {
    for (const std::size_t columns : {1U, 3U, 5U, 7U, 9U}) costmap::transpose(all_[columns]);
  }

  // By row for the steps 0 and 2, by column for 1 and 3.
  const Lines& stop(unsigned step) const { return all_[step]; }
  const Lines& dead(unsigned step) const { return all_[step + 4]; }
  const Lines& rowChange() const { return all_[8]; }
  const Lines& columnChange() const { return all_[9]; }
  const Lines& open() const { return all_[10]; }

  // The bits of a line of `length` cells in the tile that lie beyond it.
  static Bits beyond(int length) { return length == 64 ? 0 : ~Bits{0} << unsigned(length); }

 private:
  // Adds bit k of every byte to lines[k].
  static void addEach(std::uint64_t bytes, int row, int eight, Lines* lines) {
    if (bytes == 0) return;
    std::uint64_t swapped = (bytes ^ bytes >> 7) & 0x00AA00AA00AA00AAU;
    bytes ^= swapped ^ swapped << 7;
    swapped = (bytes ^ bytes >> 14) & 0x0000CCCC0000CCCCU;
    bytes ^= swapped ^ swapped << 14;
    swapped = (bytes ^ bytes >> 28) & 0x00000000F0F0F0F0U;
    bytes ^= swapped ^ swapped << 28;
    for (; bytes != 0; bytes >>= 8, ++lines)
      (*lines)[std::size_t(row)] |= (bytes & 255U) << unsigned(8 * eight);
  }

  std::array<Lines, 11> all_{};
};

}  // namespace grid_path_planner::planners
