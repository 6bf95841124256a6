// line_of_sight.h between the centres of two cells.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "grid_path_planner/costmap/bit_maps.h"
#include "grid_path_planner/costmap/line_of_sight.h"

namespace grid_path_planner::costmap {

using grid::Cell;

namespace {

int signOf(int value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

constexpr std::int64_t kUnit = SegmentPoint::kUnitsPerCell;

bool isCentre(SegmentPoint point) {
  return point.x % kUnit == kUnit / 2 && point.y % kUnit == kUnit / 2;
}

Cell cellOf(SegmentPoint point) {
  return {static_cast<int>(point.x / kUnit), static_cast<int>(point.y / kUnit)};
}

// Whether a line between two centres lies in the centre lattice. `bits` hold the line's major axis
// in their rows; the line rises by `rise` rows from `from` to the right.
bool inLattice(const BitMap& bits, Cell from, int run, int rise, std::ptrdiff_t stride) {
  const BitMap::Word* row = bits.row(from.row);
  if (rise == 0) return allOnes(row, from.column, from.column + run + 1);
  // Of each row, the centres of the squares above and below that the line meets.
  for (std::int64_t i = 0; i <= rise; ++i, row += stride) {
    const std::int64_t first = i == 0 ? 0 : (i - 1) * run / rise;
    const std::int64_t last = i == rise ? run : ((i + 1) * run + rise - 1) / rise;
    if (!allOnes(row, from.column + static_cast<int>(first),
                 from.column + static_cast<int>(last) + 1))
      return false;
  }
  return true;
}

// The same by the weights.
bool inLattice(const CostGrid& map, Cell from, Cell to) {
  const bool steep = std::abs(to.row - from.row) > std::abs(to.column - from.column);
  const std::ptrdiff_t width = map.geometry().width();
  const std::ptrdiff_t along_columns = signOf(to.column - from.column);
  const std::ptrdiff_t along_rows = signOf(to.row - from.row) * width;
  const std::ptrdiff_t major = steep ? along_rows : along_columns;
  const std::ptrdiff_t minor = steep ? along_columns : along_rows;
  const std::int64_t columns = std::abs(to.column - from.column);
  const std::int64_t rows = std::abs(to.row - from.row);
  const std::int64_t across = std::max(columns, rows), aside = std::min(columns, rows);
  const CostGrid::Weight* at = map.weights().row(from.row) + from.column;
  std::int64_t height = 0;  // above the centre of *at, in 1 / across cells
  for (std::int64_t piece = 0; piece < across; ++piece, at += major) {
    const std::int64_t end = height + aside;
    const std::ptrdiff_t last = end > across ? 2 : end > 0 ? 1 : 0;
    for (std::ptrdiff_t i = 0; i <= last; ++i)
      if (at[i * minor] == CostGrid::kBlocked || at[i * minor + major] == CostGrid::kBlocked)
        return false;
    height = end;
    if (height >= across) {
      height -= across;
      at += minor;
    }
  }
  return *at != CostGrid::kBlocked;
}

// By the rule of cells.
std::optional<double> costOverCells(const CostGrid& map, Cell from, Cell to, double limit) {
  const std::ptrdiff_t width = map.geometry().width();
  const int columns = to.column - from.column, rows = to.row - from.row;
  const bool steep = std::abs(rows) > std::abs(columns);
  const std::int64_t across = steep ? std::abs(rows) : std::abs(columns);  // along the major axis
  const std::int64_t aside = steep ? std::abs(columns) : std::abs(rows);
  if (across == 0) return 0.0;
  const std::ptrdiff_t along_columns = signOf(columns), along_rows = signOf(rows) * width;
  const std::ptrdiff_t major = steep ? along_rows : along_columns;
  const std::ptrdiff_t minor = steep ? along_columns : along_rows;
  const double length_per_unit = std::hypot(double(across), double(aside)) / double(across);

  // What the weights may add up to beyond those of a line of the least weight.
  const double units = limit / (length_per_unit * map.kernel()) + 1e-6;
  const std::int64_t min_weight = map.minWeight();
  std::int64_t spare = static_cast<std::int64_t>(std::min(units, 1e18)) - across * min_weight;

  // The line's height is counted from the lower edge of the current cell, in 1 / (2 across) cells:
  // half a column changes it by `aside`.
  const CostGrid::Weight* at = map.weights().row(from.row) + from.column;
  const std::int64_t cell = 2 * across;
  const bool cut_corners = map.motion().cut_corners;
  std::int64_t height = across;
  std::int64_t weighted = 0;
  for (std::int64_t piece = 0; piece < across; ++piece) {
    // 1. From the centre line of this column to its edge.
    CostGrid::Weight weight = *at;
    if (weight == CostGrid::kBlocked) return std::nullopt;
    height += aside;
    if (height == cell) {
      const bool pinch =
          at[major] == CostGrid::kBlocked && at[minor] == CostGrid::kBlocked && !cut_corners;
      if (pinch) return std::nullopt;
      at += minor;
      height = 0;
    } else if (height > cell) {
      at += minor;
      height -= cell;
      if (*at == CostGrid::kBlocked) return std::nullopt;
      weight = std::max(weight, *at);
    }
    // 2. From there to the next centre line.
    at += major;
    if (*at == CostGrid::kBlocked) return std::nullopt;
    weight = std::max(weight, *at);
    height += aside;
    if (height >= cell) {
      at += minor;
      height -= cell;
      if (height > 0) {
        if (*at == CostGrid::kBlocked) return std::nullopt;
        weight = std::max(weight, *at);
      }
    }
    weighted += weight;
    spare -= weight - min_weight;
    if (spare < 0) return std::nullopt;
  }
  return double(weighted) * length_per_unit * map.kernel();
}

}  // namespace

std::optional<double> lineCostWithin(const CostGrid& map, Cell from, Cell to, double limit) {
  const std::optional<double> cost = costOverCells(map, from, to, limit);
  const bool lattice = map.segmentRule() == SegmentRule::CENTRE_LATTICE;
  return cost && lattice && !inLattice(map, from, to) ? std::nullopt : cost;
}

bool lineOfSight(const BitMaps& bits, Cell from, Cell to, SegmentRule rule) {
  const bool steep = std::abs(to.row - from.row) > std::abs(to.column - from.column);
  const BitMap& map = steep ? bits.columns : bits.rows;
  if (steep) {
    std::swap(from.column, from.row);
    std::swap(to.column, to.row);
  }
  if (from.column > to.column) std::swap(from, to);
  const BitMap::Word* row = map.row(from.row);
  const int rise = std::abs(to.row - from.row);
  if (rise == 0) return allOnes(row, from.column, to.column + 1);

  // The column at which the line crosses to the next row: its whole part, and 1 / (2 rise) columns.
  const std::ptrdiff_t stride = (to.row > from.row ? 1 : -1) * map.stride();
  const int run = to.column - from.column;
  if (rule == SegmentRule::CENTRE_LATTICE) return inLattice(map, from, run, rise, stride);
  const bool cut_corners = rule == SegmentRule::CUT_CORNERS;
  const int column = 2 * rise;
  int whole = from.column + (rise + run) / column;
  int part = (rise + run) % column;
  const int whole_step = run / rise, part_step = 2 * (run % rise);
  int first = from.column;
  for (int crossed = 0; crossed < rise; ++crossed, row += stride) {
    if (!allOnes(row, first, part == 0 ? whole : whole + 1)) return false;
    if (part == 0 && !cut_corners && !bitAt(row, whole) && !bitAt(row + stride, whole - 1))
      return false;
    first = whole;
    whole += whole_step;
    part += part_step;
    if (part >= column) {
      ++whole;
      part -= column;
    }
  }
  return allOnes(row, first, to.column + 1);
}

std::optional<double> lineCostWithin(const CostGrid& map, const BitMaps* bits, SegmentPoint from,
                                     SegmentPoint to, double limit) {
  if (!isCentre(from) || !isCentre(to)) {
    if (!lineOfSight(map, from, to)) return std::nullopt;
    const double cost = lineCost(map, from, to);
    return cost <= limit ? std::optional<double>(cost) : std::nullopt;
  }
  const Cell a = cellOf(from), b = cellOf(to);
  if (!bits) return lineCostWithin(map, a, b, limit);
  const double columns = a.column - b.column, rows = a.row - b.row;
  const double cost = std::sqrt(columns * columns + rows * rows) * (map.kernel() * map.minWeight());
  if (cost > limit || !lineOfSight(*bits, a, b, map.segmentRule())) return std::nullopt;
  return cost;
}

}  // namespace grid_path_planner::costmap
