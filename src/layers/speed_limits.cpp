#include "layers/speed_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "grid/level_grid.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "layers/zone_cells.h"

namespace grid_path_planner::layers {

using base::decimalText;
using base::InputError;
using grid::Cell;
using grid::CellRect;
using grid::GridAlignment;
using grid::LevelGrid;
using grid::OccupancyGrid;
using grid::RowSpan;

namespace {

constexpr double kRounding = 1e-9;  // percent: 0.4 of 0.8 m/s is 50

// Of two limits.
std::int8_t lower(std::int8_t a, std::int8_t b) {
  if (a == 0 || b == 0) return std::max(a, b);
  return std::min(a, b);
}

std::int8_t limitOf(double percent, const std::string& what) {
  if (percent >= 100.0) return 0;
  if (percent < 1.0 - kRounding)
    throw InputError(what + " comes to " + decimalText(percent) +
                     " % of the largest speed: less than 1 % cannot be told");
  return static_cast<std::int8_t>(std::floor(percent + kRounding));
}

std::int8_t limitOf(const Zone& zone, double max_speed) {
  return limitOf(100.0 * zone.max_speed / max_speed,
                 "max_speed " + decimalText(zone.max_speed) + " m/s of zone '" + zone.name + "'");
}

}  // namespace

void checkSlowZones(const Zones& zones, double max_speed) {
  for (const Zone& zone : zones.zones)
    if (zone.kind == Zone::Kind::SLOW) limitOf(zone, max_speed);
}

void addSlowZones(const Zones& zones, double max_speed, OccupancyGrid& limits) {
  for (const Zone& zone : zones.zones) {
    if (zone.kind != Zone::Kind::SLOW) continue;
    const std::int8_t limit = limitOf(zone, max_speed);
    if (limit == 0) continue;
    for (const RowSpan& span : cellsOf(zone, limits.geometry()))
      for (int column = span.first; column < span.end; ++column)
        limits.row(span.row)[column] = lower(limits.row(span.row)[column], limit);
  }
}

OccupancyGrid limitsOfMask(const OccupancyGrid& mask, const SpeedMaskScale& scale) {
  std::array<std::optional<std::int8_t>, 101> limits;
  OccupancyGrid of_mask(mask.geometry(), 0);
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    const std::int8_t value = mask.values()[i];
    if (value <= 0) continue;
    auto& limit = limits[static_cast<std::size_t>(value)];
    if (!limit)
      limit = limitOf(scale.base + scale.multiplier * value,
                      "the value " + std::to_string(value) + " of a speed mask");
    of_mask.values()[i] = *limit;
  }
  return of_mask;
}

OccupancyGrid levelLimits(const OccupancyGrid& limits) {
  const LevelGrid level(limits.geometry());
  OccupancyGrid to(level.geometry(), 0);
  for (int row = 0; row < to.height(); ++row)
    for (int column = 0; column < to.width(); ++column)
      level.sources({column, row}, [&](Cell source) {
        to[{column, row}] = lower(to[{column, row}], limits[source]);
      });
  return to;
}

void addLimits(const OccupancyGrid& others, const GridAlignment& alignment, OccupancyGrid& limits) {
  const CellRect cells = alignment.touched(others.geometry().rect());
  for (int row = cells.row; row < cells.row + cells.height; ++row)
    for (int column = cells.column; column < cells.column + cells.width; ++column) {
      const CellRect sources = alignment.sources({column, row});
      std::int8_t& limit = limits.row(row)[column];
      for (int y = sources.row; y < sources.row + sources.height; ++y)
        for (int x = sources.column; x < sources.column + sources.width; ++x)
          limit = lower(limit, others.row(y)[x]);
    }
}

}  // namespace grid_path_planner::layers
