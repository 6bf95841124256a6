#include "grid_path_planner/search/jump_map.h"

#include <cassert>

#include "grid_path_planner/search/steps.h"

namespace grid_path_planner {
namespace {

// Bit d: the steps natural after d are not the default ones.
unsigned stopsOf(NaturalSteps steps) {
  unsigned stops = 0;
  for (unsigned d = 0; d < 8; ++d)
    if ((steps >> (8 * d) & 255U) != kDefaultSteps[d]) stops |= 1U << d;
  return stops;
}

void writeBit(std::uint64_t& word, unsigned position, bool value) {
  const std::uint64_t bit = std::uint64_t{1} << (position & 63U);
  word = value ? word | bit : word & ~bit;
}

bool readBit(std::uint64_t word, unsigned position) {
  return (word >> (position & 63U) & 1U) != 0;
}

// Windows repeat: most are solved by looking up where an equal one was. Forgets by overwriting.
class SolvedWindows {
 public:
  SolvedWindows() : entries_(std::size_t{1} << kBits) {}

  NaturalSteps steps(const Window& window) {
    Entry& entry = entries_[hashOf(window)];
    if (!entry.solved || entry.window != window) entry = {naturalSteps(window), window, true};
    return entry.steps;
  }

 private:
  static constexpr int kBits = 16;
  struct Entry {
    NaturalSteps steps = 0;
    Window window{};
    bool solved = false;
  };

  static std::size_t hashOf(const Window& window) {
    std::uint64_t hash = 0;
    for (const CostGrid::Weight weight : window) hash = (hash ^ weight) * 0x9E3779B97F4A7C15U;
    return hash >> (64 - kBits);
  }

  std::vector<Entry> entries_;
};

}  // namespace

std::size_t JumpMap::bytesFor(const GridGeometry& geometry) {
  const std::size_t width = std::size_t(geometry.width());
  const std::size_t height = std::size_t(geometry.height());
  return height * ((width + 63) / 64) * sizeof(RowWord) +
         width * ((height + 63) / 64) * sizeof(ColumnWord) + geometry.size() * sizeof(Kind);
}

void JumpMap::build(const CostGrid& map, const StopToken& stop) {
  width_ = map.geometry().width();
  height_ = map.geometry().height();
  row_words_ = (std::size_t(width_) + 63) / 64;
  column_words_ = (std::size_t(height_) + 63) / 64;
  rows_.assign(row_words_ * height_, RowWord());
  columns_.assign(column_words_ * width_, ColumnWord());
  kinds_.assign(map.geometry().size(), 0);
  steps_.clear();
  kind_of_.clear();
  write(map, map.geometry().rect(), stop);
}

void JumpMap::update(const CostGrid& map, const CellRect& changed, const StopToken& stop) {
  write(map, changed.grown(1).intersection(map.geometry().rect()), stop);
}

JumpMap::Kind JumpMap::kindOf(NaturalSteps steps) {
  const auto found = kind_of_.find(steps);
  if (found != kind_of_.end()) return found->second;
  if (steps_.size() == kUnlisted) return kUnlisted;
  const auto kind = static_cast<Kind>(steps_.size());
  steps_.push_back(steps);
  kind_of_.emplace(steps, kind);
  return kind;
}

void JumpMap::write(const CostGrid& map, const CellRect& rect, const StopToken& stop) {
  SolvedWindows solved;
  StopPoll poll(stop, 8);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    for (int column = rect.column; column < rect.column + rect.width; ++column) {
      const Cell cell{column, row};
      const Window window = windowAt(map, cell);
      const NaturalSteps steps = solved.steps(window);
      kinds_[map.geometry().index(cell).value()] = kindOf(steps);
      writeCell(cell, steps,
                unsigned(window[4] != window[5]) | unsigned(window[4] != window[7]) << 1);
    }
  }
}

void JumpMap::writeCell(Cell cell, NaturalSteps steps, unsigned changes) {
  writeStops(cell, stopsOf(steps));
  writeBit(rows_[std::size_t(cell.row) * row_words_ + unsigned(cell.column) / 64].lane.change,
           unsigned(cell.column), (changes & 1U) != 0);
  writeBit(columns_[std::size_t(cell.column) * column_words_ + unsigned(cell.row) / 64].lane.change,
           unsigned(cell.row), (changes & 2U) != 0);
}

// Step 0 is along the row, 1 along the column, 2 and 3 back.
void JumpMap::writeStops(Cell cell, unsigned stops) {
  const auto column = unsigned(cell.column), row = unsigned(cell.row);
  RowWord& in_row = rows_[row * row_words_ + column / 64];
  Lane& in_column = columns_[column * column_words_ + row / 64].lane;
  writeBit(in_row.lane.stop[0], column, (stops & 1U) != 0);
  writeBit(in_column.stop[0], row, (stops & 2U) != 0);
  writeBit(in_row.lane.stop[1], column, (stops & 4U) != 0);
  writeBit(in_column.stop[1], row, (stops & 8U) != 0);
  for (unsigned i = 0; i < 4; ++i)
    writeBit(in_row.diagonal[i], column, (stops >> (4 + i) & 1U) != 0);
}

unsigned JumpMap::stopsAt(Cell cell) const {
  const auto column = unsigned(cell.column), row = unsigned(cell.row);
  const RowWord& in_row = rows_[row * row_words_ + column / 64];
  const Lane& in_column = columns_[column * column_words_ + row / 64].lane;
  unsigned stops = unsigned(readBit(in_row.lane.stop[0], column)) |
                   unsigned(readBit(in_column.stop[0], row)) << 1 |
                   unsigned(readBit(in_row.lane.stop[1], column)) << 2 |
                   unsigned(readBit(in_column.stop[1], row)) << 3;
  for (unsigned i = 0; i < 4; ++i)
    stops |= unsigned(readBit(in_row.diagonal[i], column)) << (4 + i);
  return stops;
}

JumpMap::Target::Target(JumpMap& jumps, Cell cell)
    : jumps_(jumps), cell_(cell), stops_(jumps.stopsAt(cell)) {
  jumps_.writeStops(cell_, 255);
}

JumpMap::Target::~Target() {
  jumps_.writeStops(cell_, stops_);
}

}  // namespace grid_path_planner
