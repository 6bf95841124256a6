// What a laser sees, as a layer: its rays clear the cells that they cross, its hits mark the cells they end in.
//
//   ScanLayer layer;
//   layer.reset(stack.grid(Layer::SCAN));
//   layer.insert(scan, options, stack.grid(Layer::SCAN), changed);
//   layer.expire(now, options.decay_time, stack.grid(Layer::SCAN), changed);
//
// A cell is 100 where a hit was the last that was seen of it, 0 where a ray, and -1 where nothing was. Of one scan
// the rays are taken first: no ray clears what another one hits. Not guaranteed: that a mark stays while rays of
// later scans cross a part of its cell beside the obstacle; smaller cells make that rarer.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "layers/changed_cells.h"
#include "layers/scan_layer_options.h"

namespace grid_path_planner::layers {

// In the frame of the map, metres.
struct Beam {
  Eigen::Vector2d end;
  double range = 0.0;  // m, along the ray as it was measured
  bool hit = false;    // whether something was there; else the ray is free up to the end
};

struct ScanInMap {
  double time = 0.0;  // s, of ROS
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  std::vector<Beam> beams;
};

class ScanLayer {
 public:
  // Forgets everything.
  void reset(grid::OccupancyGrid& layer);

  // Cells whose value changes are added to `changed`. Beams reach as far as the options say and no farther;
  // what lies outside the map is passed over. All numbers are finite.
  void insert(const ScanInMap& scan, const ScanLayerOptions& options, grid::OccupancyGrid& layer,
              ChangedCells& changed);

  // Marks whose last hit is more than `decay_time` seconds before `now` become unknown. 0: they stay. Of what passed since
  // the last call 10 s count at most, so that a clock that is put forward forgets nothing: no laser looked meanwhile.
  void expire(double now, double decay_time, grid::OccupancyGrid& layer, ChangedCells& changed);

 private:
  void set(grid::Cell cell, std::int8_t value, grid::OccupancyGrid& layer, ChangedCells& changed);
  void clearRay(const ScanInMap& scan, const Beam& beam, double most, grid::OccupancyGrid& layer,
                ChangedCells& changed);

  struct Mark {
    grid::Cell cell;
    double time;  // s, of its last hit; later where the clock leapt since then
  };

  std::optional<double> expired_at_;        // s, the last call of expire()
  std::vector<Mark> marks_;                 // of cells that are or were 100
  grid::Grid<std::uint32_t> mark_numbers_;  // in marks_, from 1; 0: none
};

}  // namespace grid_path_planner::layers
