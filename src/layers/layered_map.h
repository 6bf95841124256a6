// A static map and what is laid over it: a live map, the obstacles of a laser, keep-out zones; and the limits of
// speed that slow zones set.
//
//   LayeredMap map;
//   map.configure(options, readZones(file));
//   map.setBase(static_map);                          // gives the grid; others are resampled to it
//   map.setLive(projected_map, changed);
//   map.insert(scan);
//   for (const CellRect& rect : map.takeChanged()) publish(map.merged(), rect);
//
// Whatever came before the base waits for it. Guaranteed: merged() is what a map made anew of the same inputs
// would be. Errors (InputError) change nothing.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grid/grid_alignment.h"
#include "layers/layer_stack.h"
#include "layers/map_layers_options.h"
#include "layers/scan_layer.h"
#include "layers/speed_limits.h"
#include "layers/zones.h"

namespace grid_path_planner::layers {

class LayeredMap {
 public:
  using Map = std::shared_ptr<const grid::OccupancyGrid>;
  using Changed = std::optional<std::vector<grid::CellRect>>;  // nullopt: all may differ

  // Throws InputError for what checkSlowZones() refuses, and, later, for values of the speed mask that
  // limitsOfMask() does. Whatever it throws, nothing changes: a copy of the whole is laid, and takes its place.
  void configure(const MapLayersOptions& options, const Zones& zones);

  // Those whose origin has a yaw are laid on a grid without one: throw InputError as LevelGrid.
  // Returns whether what scans saw is forgotten: it lies elsewhere, or nobody knows what of it changed.
  bool setBase(Map base, const Changed& changed = {});
  void setLive(Map live, const Changed& changed = {});
  void setKeepOutMask(Map mask);
  // Throws InputError too for values that limitsOfMask() refuses.
  void setSpeedMask(Map mask);

  void insert(const ScanInMap& scan);
  // Obstacles that were not hit for options.scan.decay_time before `now` (s) are forgotten, as ScanLayer::expire().
  void expireScans(double now);
  void forgetScans();

  // Whether the layer counts; at first each does.
  void use(Layer layer, bool used) { stack_.use(layer, used); }

  bool hasBase() const { return stack_.hasBase(); }
  const grid::OccupancyGrid& merged() const { return stack_.merged(); }
  // Whether it has another geometry than at the last call.
  bool takeNewGeometry() { return std::exchange(new_geometry_, false); }
  std::vector<grid::CellRect> takeChanged() { return stack_.takeChanged(); }
  // In the same grid.
  const grid::OccupancyGrid& speedLimits() const { return limits_; }
  // Whether they differ from those of the last call.
  bool takeNewSpeedLimits() { return std::exchange(new_limits_, false); }

  // The names of zones that lie outside of the map; none without a base.
  const std::vector<std::string>& zonesOutside() const { return zones_outside_; }
  // Whether the live map reaches beyond the base: that part is left out.
  bool liveIsCut() const;

 private:
  Map levelled(Map map) const;
  // With the options and zones of now; `other_rule`: of what is occupied.
  void layAll(bool other_rule);
  void layLive(const std::vector<grid::CellRect>& changed);
  void layKeepOut();
  void layLimits();

  MapLayersOptions options_;
  LayerStack stack_;
  ScanLayer scans_;
  ChangedCells scan_changes_;
  Map turned_base_, turned_live_;  // as they came; null of those without a yaw
  Map live_;
  std::optional<grid::GridAlignment> live_alignment_;
  Map keep_out_mask_;
  Map speed_mask_;
  std::optional<grid::OccupancyGrid> mask_limits_;
  Zones zones_;
  std::vector<std::string> zones_outside_;
  grid::OccupancyGrid limits_;
  bool new_geometry_ = false;
  bool new_limits_ = false;
};

}  // namespace grid_path_planner::layers
