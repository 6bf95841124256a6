#include "grid_path_planner/search/region_map.h"

#include <algorithm>

namespace grid_path_planner {
namespace {

constexpr std::uint8_t kNone = 255;  // a sector has at most 128 regions

}  // namespace

std::size_t RegionMap::bytesFor(const GridGeometry& geometry) {
  const std::size_t sectors = geometry.size() / (kSide * kSide) + 1;
  return geometry.size() + sectors * (sizeof(std::vector<Region>) + 2 * sizeof(Region));
}

void RegionMap::build(const CostGrid& map, const StepMasks& masks, const StopToken& stop) {
  const GridGeometry& geometry = map.geometry();
  columns_ = (geometry.width() + kSide - 1) / kSide;
  rows_ = (geometry.height() + kSide - 1) / kSide;
  numbers_.assign(geometry.size(), kNone);
  regions_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), {});
  update(map, masks, geometry.rect(), stop);
}

void RegionMap::update(const CostGrid& map, const StepMasks& masks, const CellRect& changed,
                       const StopToken& stop) {
  const CellRect rect = changed.intersection(map.geometry().rect());
  if (rect.empty()) return;
  StopPoll poll(stop, 64);
  const int last_row = (rect.row + rect.height - 1) >> kShift;
  const int last_column = (rect.column + rect.width - 1) >> kShift;
  for (int row = rect.row >> kShift; row <= last_row; ++row)
    for (int column = rect.column >> kShift; column <= last_column; ++column) {
      poll();
      cut(map, masks, static_cast<std::uint32_t>(row * columns_ + column));
    }
}

CellRect RegionMap::cellsOf(std::uint32_t sector, const GridGeometry& geometry) const {
  const int row = static_cast<int>(sector) / columns_;
  const int column = static_cast<int>(sector) % columns_;
  return CellRect{column * kSide, row * kSide, kSide, kSide}.intersection(geometry.rect());
}

void RegionMap::cut(const CostGrid& map, const StepMasks& masks, std::uint32_t sector) {
  const GridGeometry& geometry = map.geometry();
  const CellRect cells = cellsOf(sector, geometry);
  const auto number = [&](int column, int row) -> std::uint8_t& {
    return numbers_[geometry.index({column, row}).value()];
  };
  for (int row = cells.row; row < cells.row + cells.height; ++row)
    std::fill_n(&number(cells.column, row), cells.width, kNone);
  std::vector<Region>& regions = regions_[sector];
  regions.clear();
  for (int row = cells.row; row < cells.row + cells.height; ++row)
    for (int column = cells.column; column < cells.column + cells.width; ++column) {
      const bool known = number(column, row) != kNone;
      if (known || map.weight({column, row}) == CostGrid::kBlocked) continue;
      const auto next = static_cast<std::uint8_t>(regions.size());
      regions.push_back(collect(map, masks, cells, {column, row}, next));
    }
}

// Numbers the cells that are connected with `first` inside the sector.
RegionMap::Region RegionMap::collect(const CostGrid& map, const StepMasks& masks,
                                     const CellRect& sector, Cell first, std::uint8_t number) {
  const GridGeometry& geometry = map.geometry();
  collected_.assign(1, first);
  numbers_[geometry.index(first).value()] = number;
  double columns = 0.0;
  double rows = 0.0;
  double weights = 0.0;
  CostGrid::Weight cheapest = map.weight(first);
  for (std::size_t i = 0; i < collected_.size(); ++i) {
    const Cell cell = collected_[i];
    columns += cell.column;
    rows += cell.row;
    weights += map.weight(cell);
    cheapest = std::min(cheapest, map.weight(cell));
    for (unsigned mask = masks[geometry.index(cell).value()]; mask != 0; mask &= mask - 1) {
      const Cell step = kSteps[static_cast<std::size_t>(__builtin_ctz(mask))];
      const Cell to{cell.column + step.column, cell.row + step.row};
      if (!sector.contains(to)) continue;
      std::uint8_t& known = numbers_[geometry.index(to).value()];
      if (known != kNone) continue;
      known = number;
      collected_.push_back(to);
    }
  }
  const auto size = static_cast<double>(collected_.size());
  const auto fromMiddle = [&](Cell cell) {
    const double x = cell.column - columns / size;
    const double y = cell.row - rows / size;
    return x * x + y * y;
  };
  const auto nearer = [&](Cell a, Cell b) { return fromMiddle(a) < fromMiddle(b); };
  return {*std::min_element(collected_.begin(), collected_.end(), nearer),
          static_cast<float>((weights / size + 3.0 * cheapest) / 4.0)};
}

void RegionMap::neighbours(const GridGeometry& geometry, const StepMasks& masks, Id id,
                           std::vector<Id>& ids) const {
  ids.clear();
  const CellRect cells = cellsOf(id >> 8, geometry);
  const auto look = [&](Cell cell) {
    const std::uint32_t index = geometry.index(cell).value();
    if (numbers_[index] != (id & 0xFFU)) return;
    for (unsigned mask = masks[index]; mask != 0; mask &= mask - 1) {
      const Cell step = kSteps[static_cast<std::size_t>(__builtin_ctz(mask))];
      const Cell to{cell.column + step.column, cell.row + step.row};
      if (cells.contains(to)) continue;
      const Id other = regionAt(geometry, to);
      if (std::find(ids.begin(), ids.end(), other) == ids.end()) ids.push_back(other);
    }
  };
  for (int column = cells.column; column < cells.column + cells.width; ++column) {
    look({column, cells.row});
    look({column, cells.row + cells.height - 1});
  }
  for (int row = cells.row; row < cells.row + cells.height; ++row) {
    look({cells.column, row});
    look({cells.column + cells.width - 1, row});
  }
}

}  // namespace grid_path_planner
