#include "layers/scan_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "layers/ray_cells.h"

namespace grid_path_planner::layers {

using Eigen::Vector2d;
using grid::Cell;
using grid::OccupancyGrid;

namespace {

constexpr double kLongestStep = 10.0;  // s by which marks grow older in a call of expire() at most

}  // namespace

void ScanLayer::reset(OccupancyGrid& layer) {
  std::fill(layer.values().begin(), layer.values().end(), std::int8_t{-1});
  marks_.clear();
  expired_at_.reset();
  mark_numbers_ = grid::Grid<std::uint32_t>(layer.geometry(), 0);
}

void ScanLayer::set(Cell cell, std::int8_t value, OccupancyGrid& layer, ChangedCells& changed) {
  if (std::exchange(layer[cell], value) != value) changed.add(cell);
}

void ScanLayer::clearRay(const ScanInMap& scan, const Beam& beam, double most, OccupancyGrid& layer,
                         ChangedCells& changed) {
  const double share = beam.range > most ? most / beam.range : 1.0;
  const Vector2d end = scan.origin + share * (beam.end - scan.origin);
  visitRayCells(layer.geometry().gridFromWorld(scan.origin), layer.geometry().gridFromWorld(end),
                layer.geometry().rect(), [&](Cell cell) { set(cell, 0, layer, changed); });
}

// All rays first: a cell that a hit is in may be crossed by the ray beside it.
void ScanLayer::insert(const ScanInMap& scan, const ScanLayerOptions& options, OccupancyGrid& layer,
                       ChangedCells& changed) {
  for (const Beam& beam : scan.beams)
    clearRay(scan, beam, options.clearing_max_range, layer, changed);
  for (const Beam& beam : scan.beams) {
    if (!beam.hit || beam.range > options.obstacle_max_range) continue;
    const auto cell = layer.geometry().cellAt(beam.end);
    if (!cell) continue;
    set(*cell, 100, layer, changed);
    std::uint32_t& number = mark_numbers_[*cell];
    if (number == 0) {
      marks_.push_back({*cell, scan.time});
      number = static_cast<std::uint32_t>(marks_.size());
    }
    marks_[number - 1].time = std::max(marks_[number - 1].time, scan.time);
  }
}

void ScanLayer::expire(double now, double decay_time, OccupancyGrid& layer, ChangedCells& changed) {
  const double surplus = expired_at_ ? std::max(now - *expired_at_ - kLongestStep, 0.0) : 0.0;
  std::vector<Mark> kept;
  for (Mark mark : marks_) {
    mark.time = std::max(mark.time, std::min(mark.time + surplus, now));
    mark_numbers_[mark.cell] = 0;
    if (layer[mark.cell] != 100) continue;
    if (decay_time > 0.0 && now - mark.time > decay_time) {
      set(mark.cell, -1, layer, changed);
      continue;
    }
    kept.push_back(mark);
    mark_numbers_[mark.cell] = static_cast<std::uint32_t>(kept.size());
  }
  marks_ = std::move(kept);
  expired_at_ = now;
}

}  // namespace grid_path_planner::layers
