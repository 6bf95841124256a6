// The state of projected_map: the 3-D map and the 2-D map projected from it.
//
//   MapModel model(options);                   // with options.filename: that file
//   model.insert(points, frames);
//   const OccupancyGrid& grid = model.grid();  // brought up to date with the tree
//   const ProjectionChange change = model.takeChange();
//
// For one thread.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/mapping/cloud_filter.h"
#include "grid_path_planner/mapping/octree_map.h"
#include "grid_path_planner/mapping/projected_map_options.h"
#include "grid_path_planner/mapping/projection.h"

namespace grid_path_planner::mapping {

class MapModel {
 public:
  // Throws InputError for options and for a file that cannot be used. The resolution of a file
  // replaces that of the options. `begin_with`, where it is not empty, is loaded instead of
  // options.filename, whatever that takes: without the memory for it, std::bad_alloc. `stop` ends a loading.
  explicit MapModel(const ProjectedMapOptions& options, const std::string& begin_with = "",
                    const base::StopToken& stop = {});

  // Throws InputError for options that cannot be used or not be changed (frame_id, latch, and a
  // resolution that is neither as it was asked for before nor the map's), and for a new filename that
  // cannot be loaded; then nothing has changed.
  void setOptions(const ProjectedMapOptions& asked, const base::StopToken& stop = {});
  const ProjectedMapOptions& options() const { return options_; }

  struct Inserted {
    std::size_t points = 0;
    std::size_t left_out = 0;    // too far away for the tree
    bool ground_missed = false;  // no plane was found
    bool map_is_full = false;    // OctreeMap::isFull
    double seconds = 0.0;
  };
  // `points` in m, in the sensor's frame. Throws InputError where the sensor is outside the tree.
  Inserted insert(std::vector<Eigen::Vector3d> points, const CloudFrames& frames);

  void reset();
  // Throws InputError for corners that are no box.
  void clearBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  // Lets `seconds` pass for occupied voxels (OctreeMap::decay).
  void decay(double seconds);
  // Of the vehicle, m in the frame of the map.
  void setVehicleHeight(double z) { projection_.setVehicleHeight(z); }

  const grid::OccupancyGrid& grid();
  // What changed in grid() since the last call.
  ProjectionChange takeChange();
  // What the tree holds beyond the 2-D map, for projection_max_cells: m^2, in steps of 8x8 cells.
  double areaLeftOut() const;
  // How often the tree has been projected.
  std::uint64_t projections() const { return projections_; }

  const OctreeMap& map() const { return map_; }
  // Increases with every call that may have changed the tree.
  std::uint64_t revision() const { return revision_; }

  // Throw InputError naming a file that cannot be written.
  void saveMap(const base::OutputFile& file);
  void saveOctree(const base::OutputFile& file) const { map_.save(file); }

 private:
  void replaceMap(const ProjectedMapOptions& options, const base::StopToken& stop);

  ProjectedMapOptions options_;
  double asked_resolution_ = 0.0;  // m; a file that came later has its own
  OctreeMap map_;
  Projection projection_;
  ProjectionChange change_;
  std::uint64_t revision_ = 1;
  std::uint64_t projections_ = 0;
};

}  // namespace grid_path_planner::mapping
