// Where straight and diagonal runs of a weighted map must stop: what weighted_jump_point makes of a
// map before it searches.
//
//   JumpMap jumps;
//   jumps.build(map, stop);
//   JumpMap::Run run = jumps.alongRow<true>(cell, map);  // east from a cell: up to where, how dear
//
// A cell is a stop of step d where the natural steps after d (search/canonical_steps.h) are not the
// default ones: a turn may begin there, or nothing leads on. One bit a cell and step, in words of
// 64 cells along the row, for the vertical steps along the column, so that a run over cells of no
// interest costs a word operation for 64 of them. One more bit says where the weight changes from
// one cell to the next: a run over a plateau is priced by counting.
//
// An edit recomputes the cells around it and nothing else.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/search/canonical_steps.h"
#include "grid_path_planner/terrain/cost_grid.h"

namespace grid_path_planner {

class JumpMap {
 public:
  // Cells whose natural steps are the same are of one kind. There is room for 65535 kinds; cells of
  // further ones are kUnlisted and their steps are computed when asked for.
  using Kind = std::uint16_t;
  static constexpr Kind kUnlisted = 65535;

  static std::size_t bytesFor(const GridGeometry& geometry);

  // Throw Stopped. `changed`: the cells whose weights changed since.
  void build(const CostGrid& map, const StopToken& stop);
  void update(const CostGrid& map, const CellRect& changed, const StopToken& stop);

  NaturalSteps natural(const CostGrid& map, std::uint32_t index) const {
    const Kind kind = kinds_[index];
    if (kind != kUnlisted) return steps_[kind];
    return naturalSteps(windowAt(map, map.geometry().cell(CellIndex(index))));
  }

  // Of a straight run from a cell that may be left that way: the column (row) of the first stop,
  // and the sum of max(weight, weight) over its steps.
  struct Run {
    std::uint32_t to;
    std::uint64_t weights;
  };
  template <bool kForward>
  Run alongRow(Cell from, const CostGrid::Weight* weights) const {
    return run<kForward>(&rows_[std::size_t(from.row) * row_words_], unsigned(from.column),
                         weights + std::size_t(from.row) * width_, 1);
  }
  template <bool kForward>
  Run alongColumn(Cell from, const CostGrid::Weight* weights) const {
    return run<kForward>(&columns_[std::size_t(from.column) * column_words_], unsigned(from.row),
                         weights + from.column, width_);
  }

  // Whether a diagonal run by step 4..7 stops at the cell.
  bool stopsDiagonal(Cell cell, int step) const {
    return (row(cell).diagonal[step - 4] >> (unsigned(cell.column) & 63U) & 1U) != 0;
  }

  // While one lives every run stops at its cell, which keeps its natural steps.
  class Target {
   public:
    Target(JumpMap& jumps, Cell cell);
    ~Target();
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

   private:
    JumpMap& jumps_;
    Cell cell_;
    unsigned stops_;
  };

 private:
  struct Lane {                         // 64 cells of a row or column
    std::array<std::uint64_t, 2> stop;  // forwards, backwards
    std::uint64_t change;               // to the next cell
  };
  struct RowWord {
    Lane lane;
    std::array<std::uint64_t, 4> diagonal;
    std::uint64_t spare;  // a word is a line of the cache
  };
  struct ColumnWord {
    Lane lane;
  };

  template <bool kForward, class Word>
  static Run run(const Word* lane, unsigned from, const CostGrid::Weight* weights,
                 std::ptrdiff_t stride);

  const RowWord& row(Cell cell) const {
    return rows_[std::size_t(cell.row) * row_words_ + unsigned(cell.column) / 64];
  }
  void write(const CostGrid& map, const CellRect& rect, const StopToken& stop);
  void writeCell(Cell cell, NaturalSteps steps, unsigned changes);
  void writeStops(Cell cell, unsigned stops);
  unsigned stopsAt(Cell cell) const;
  Kind kindOf(NaturalSteps steps);

  int width_ = 0;
  int height_ = 0;
  std::size_t row_words_ = 0;
  std::size_t column_words_ = 0;
  std::vector<RowWord> rows_;
  std::vector<ColumnWord> columns_;
  std::vector<Kind> kinds_;
  std::vector<NaturalSteps> steps_;  // by kind
  std::unordered_map<NaturalSteps, Kind> kind_of_;
};

template <bool kForward, class Word>
JumpMap::Run JumpMap::run(const Word* words, unsigned from, const CostGrid::Weight* weights,
                          std::ptrdiff_t stride) {
  const Word* word = words + from / 64;
  const unsigned bit = from & 63U;
  const std::uint64_t before = (std::uint64_t{1} << bit) - 1;
  const std::uint64_t after = bit == 63 ? 0 : ~std::uint64_t{0} << (bit + 1);
  std::uint64_t stops = word->lane.stop[kForward ? 0 : 1] & (kForward ? after : before);
  std::uint64_t changes = word->lane.change & (kForward ? ~before : before);
  std::int64_t base = from & ~63U;
  std::int64_t at = from;
  std::uint64_t weight = weights[at * stride];
  std::uint64_t sum = 0;
  for (;;) {
    const bool stopped = stops != 0;
    unsigned stop = 0;
    if (stopped) {
      stop = kForward ? unsigned(__builtin_ctzll(stops)) : 63U - unsigned(__builtin_clzll(stops));
      const std::uint64_t below_stop = (std::uint64_t{1} << stop) - 1;
      changes &= kForward ? below_stop : ~below_stop;
    }
    while (changes != 0) {
      const unsigned change =
          kForward ? unsigned(__builtin_ctzll(changes)) : 63U - unsigned(__builtin_clzll(changes));
      changes &= ~(std::uint64_t{1} << change);
      const std::int64_t last = base + change + (kForward ? 0 : 1);
      const std::int64_t next = base + change + (kForward ? 1 : 0);
      sum += weight * std::uint64_t(kForward ? last - at : at - last);
      const std::uint64_t next_weight = weights[next * stride];
      sum += weight > next_weight ? weight : next_weight;
      weight = next_weight;
      at = next;
    }
    if (stopped) {
      const std::int64_t to = base + stop;
      sum += weight * std::uint64_t(kForward ? to - at : at - to);
      return {std::uint32_t(to), sum};
    }
    word += kForward ? 1 : -1;
    base += kForward ? 64 : -64;
    stops = word->lane.stop[kForward ? 0 : 1];
    changes = word->lane.change;
  }
}

}  // namespace grid_path_planner
