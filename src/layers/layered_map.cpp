#include "layers/layered_map.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "grid/level_grid.h"
#include "layers/resampling.h"

namespace grid_path_planner::layers {

using grid::CellRect;
using grid::GridAlignment;
using grid::hasYaw;
using grid::OccupancyGrid;

namespace {

constexpr int kAnyValue = 1;  // of a keep-out mask; which of them count is seen when it is laid

OccupancyGrid levelLimitsOfMask(const OccupancyGrid& mask, const SpeedMaskScale& scale) {
  OccupancyGrid limits = limitsOfMask(mask, scale);
  return hasYaw(limits.geometry()) ? levelLimits(limits) : limits;
}

}  // namespace

void LayeredMap::configure(const MapLayersOptions& options, const Zones& zones) {
  static_assert(std::is_nothrow_move_assignable_v<LayeredMap>);
  checkSlowZones(zones, options.max_speed);
  LayeredMap next = *this;
  if (speed_mask_) next.mask_limits_ = levelLimitsOfMask(*speed_mask_, options.speed_mask);
  const bool other_rule = options.occupied_min != options_.occupied_min;
  next.options_ = options;
  next.zones_ = zones;
  next.layAll(other_rule);
  *this = std::move(next);
}

void LayeredMap::layAll(bool other_rule) {
  if (other_rule && turned_base_) setBase(turned_base_, Changed::value_type{});
  if (other_rule && turned_live_) setLive(turned_live_);
  if (!hasBase()) return;
  if (live_) layLive({live_->geometry().rect()});
  layKeepOut();
  layLimits();
}

// All of a turned map is laid anew, whatever of it changed.
LayeredMap::Map LayeredMap::levelled(Map map) const {
  if (!hasYaw(map->geometry())) return map;
  return std::make_shared<OccupancyGrid>(levelOccupancy(*map, options_.occupied_min));
}

bool LayeredMap::setBase(Map base, const Changed& changed) {
  const Map given = base;
  base = levelled(std::move(base));
  turned_base_ = given == base ? nullptr : given;
  if (hasBase() && changed && base->geometry() == merged().geometry()) {
    const std::vector<CellRect> all{base->geometry().rect()};
    stack_.setBase(std::move(base), turned_base_ ? all : *changed);
    return false;
  }
  stack_.setBase(std::move(base));
  new_geometry_ = true;
  scans_.reset(stack_.grid(Layer::SCAN));
  scan_changes_.clear();
  live_alignment_.reset();
  if (live_) layLive({live_->geometry().rect()});
  layKeepOut();
  layLimits();
  return true;
}

void LayeredMap::setLive(Map live, const Changed& changed) {
  const Map given = live;
  live = levelled(std::move(live));
  turned_live_ = given == live ? nullptr : given;
  const bool elsewhere =
      !live_ || !changed || turned_live_ || live_->geometry() != live->geometry();
  live_ = std::move(live);
  if (!hasBase()) return;
  if (elsewhere) {
    OccupancyGrid& layer = stack_.grid(Layer::LIVE);
    std::fill(layer.values().begin(), layer.values().end(), std::int8_t{-1});
    live_alignment_.reset();
    layLive({live_->geometry().rect()});
    stack_.merge({layer.geometry().rect()});
    return;
  }
  layLive(*changed);
}

void LayeredMap::layLive(const std::vector<CellRect>& changed) {
  if (!live_alignment_) live_alignment_.emplace(live_->geometry(), merged().geometry());
  std::vector<CellRect> touched;
  for (const CellRect& rect : changed) {
    touched.push_back(live_alignment_->touched(rect));
    resampleOccupancy(*live_, *live_alignment_, touched.back(), options_.occupied_min,
                      stack_.grid(Layer::LIVE));
  }
  stack_.merge(touched);
}

bool LayeredMap::liveIsCut() const {
  if (!live_ || !hasBase()) return false;
  const GridAlignment back(merged().geometry(), live_->geometry());
  const CellRect cells = live_->geometry().rect();
  return !back.covers({0, 0}) || !back.covers({cells.width - 1, cells.height - 1});
}

void LayeredMap::setKeepOutMask(Map mask) {
  keep_out_mask_ = hasYaw(mask->geometry())
                       ? std::make_shared<OccupancyGrid>(levelOccupancy(*mask, kAnyValue))
                       : std::move(mask);
  if (hasBase()) layKeepOut();
}

void LayeredMap::setSpeedMask(Map mask) {
  mask_limits_ = levelLimitsOfMask(*mask, options_.speed_mask);
  speed_mask_ = std::move(mask);
  if (hasBase()) layLimits();
}

void LayeredMap::layKeepOut() {
  OccupancyGrid& layer = stack_.grid(Layer::KEEP_OUT);
  std::fill(layer.values().begin(), layer.values().end(), std::int8_t{-1});
  zones_outside_ = drawKeepOutZones(zones_, layer);
  if (keep_out_mask_)
    addMask(*keep_out_mask_, GridAlignment(keep_out_mask_->geometry(), layer.geometry()),
            options_.occupied_min, layer);
  stack_.merge({layer.geometry().rect()});
}

void LayeredMap::layLimits() {
  OccupancyGrid limits(merged().geometry(), 0);
  addSlowZones(zones_, options_.max_speed, limits);
  if (mask_limits_)
    addLimits(*mask_limits_, GridAlignment(mask_limits_->geometry(), limits.geometry()), limits);
  if (limits_ == limits) return;
  limits_ = std::move(limits);
  new_limits_ = true;
}

void LayeredMap::insert(const ScanInMap& scan) {
  if (!hasBase()) return;
  scans_.insert(scan, options_.scan, stack_.grid(Layer::SCAN), scan_changes_);
  stack_.merge(scan_changes_.take());
}

void LayeredMap::expireScans(double now) {
  if (!hasBase()) return;
  scans_.expire(now, options_.scan.decay_time, stack_.grid(Layer::SCAN), scan_changes_);
  stack_.merge(scan_changes_.take());
}

void LayeredMap::forgetScans() {
  if (!hasBase()) return;
  scans_.reset(stack_.grid(Layer::SCAN));
  stack_.merge({merged().geometry().rect()});
}

}  // namespace grid_path_planner::layers
