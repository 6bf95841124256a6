// The parameters of the node `projected_map`: octomap_server's by their names and with their
// defaults, and ours.
#pragma once

#include <string>

#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/mapping/cloud_filter_options.h"
#include "grid_path_planner/mapping/octree_options.h"
#include "grid_path_planner/mapping/projection_options.h"

namespace grid_path_planner::mapping {

// How rviz shows the voxels: by their height, or all in one colour. Red, green, blue and opacity
// are from 0 to 1.
struct VoxelColors {
  bool height_map = true;
  double color_factor = 0.8;
  double r = 0.0, g = 0.0, b = 1.0, a = 1.0;
  double free_r = 0.0, free_g = 1.0, free_b = 0.0, free_a = 1.0;
};

template <class Visitor>
void visitOptions(VoxelColors& o, Visitor&& visit) {
  const auto part = [](const char* description) {
    return base::OptionInfo{description, "", 0.0, 1.0};
  };
  visit("height_map", o.height_map,
        base::OptionInfo{"Whether occupied_cells_vis_array is coloured by height; false: by color",
                         ""});
  visit("color_factor", o.color_factor,
        base::OptionInfo{"How much of the colours' circle the heights take", "", 0.0, 1.0});
  visit("color/r", o.r, part("Red of occupied voxels without height_map"));
  visit("color/g", o.g, part("Green of occupied voxels without height_map"));
  visit("color/b", o.b, part("Blue of occupied voxels without height_map"));
  visit("color/a", o.a, part("Opacity of occupied voxels without height_map"));
  visit("color_free/r", o.free_r, part("Red of free voxels"));
  visit("color_free/g", o.free_g, part("Green of free voxels"));
  visit("color_free/b", o.free_b, part("Blue of free voxels"));
  visit("color_free/a", o.free_a, part("Opacity of free voxels"));
}

struct ProjectedMapOptions {
  std::string filename;
  std::string frame_id = "map";
  std::string base_frame_id = "base_footprint";

  OctreeOptions octree;
  CloudFilterOptions cloud;
  double tf_timeout = 1.0;  // s
  int queue_size = 10;      // clouds

  double occupancy_min_z = -1e6;  // m
  double occupancy_max_z = 1e6;   // m
  std::string projection_min_z = "occupancy";
  std::string projection_max_z = "occupancy";
  ProjectionOptions projection;  // its band is the two above

  double publish_rate = 5.0;  // Hz
  bool latch = true;
  bool always_send_full_map = false;
  double full_map_period = 10.0;  // s of the wall clock
  double heartbeat_period = 1.0;  // s of the wall clock; 0: none
  bool publish_free_space = false;
  VoxelColors colors;

  std::string map_file;
  std::string octree_file;
  double autosave_period = 5.0;  // s of the wall clock; 0: never
  base::ReadOptions reading;
};

// Groups of the options, in the order of visitOptions.
template <class Visitor>
void visitCloudQueueOptions(ProjectedMapOptions& o, Visitor&& visit) {
  visit("tf_timeout", o.tf_timeout,
        base::OptionInfo{"How long a cloud waits for its transform; it holds up no other", "s", 0.0,
                         1000.0});
  visit("queue_size", o.queue_size,
        base::OptionInfo{"How many clouds wait for their transforms, and as many for their turn; "
                         "of more, one that is "
                         "not the oldest of its frame is dropped, and counted",
                         "", 1, 10000});
}

template <class Visitor>
void visitBandOptions(ProjectedMapOptions& o, Visitor&& visit) {
  visit(
      "occupancy_min_z", o.occupancy_min_z,
      base::OptionInfo{"Lowest voxels that are shown, and projected unless projection_min_z is set",
                       "m", -1e9, 1e9}
          .under("The 2-D map"));
  visit("occupancy_max_z", o.occupancy_max_z,
        base::OptionInfo{
            "Highest voxels that are shown, and projected unless projection_max_z is set", "m",
            -1e9, 1e9});
  visit("projection_min_z", o.projection_min_z,
        base::OptionInfo{
            "Lower end of the 2-D map's band in m, from projection_reference; occupancy: as "
            "occupancy_min_z",
            ""});
  visit("projection_max_z", o.projection_max_z,
        base::OptionInfo{
            "Upper end of the 2-D map's band in m, from projection_reference; occupancy: as "
            "occupancy_max_z",
            ""});
}

template <class Visitor>
void visitPublishingOptions(ProjectedMapOptions& o, Visitor&& visit) {
  visit("publish_rate", o.publish_rate,
        base::OptionInfo{"How often changes are published at most, by the wall clock", "Hz", 0.01,
                         100.0}
            .under("What is published"));
  visit(
      "latch", o.latch,
      base::OptionInfo{"Whether a new subscriber gets what there is; false: only what changes from "
                       "then on; read at the start",
                       ""});
  visit("always_send_full_map", o.always_send_full_map,
        base::OptionInfo{"Whether every change sends all of projected_map; false: that for new "
                         "geometry, new subscribers and those that do not take "
                         "projected_map_updates, else these",
                         ""});
  visit(
      "full_map_period", o.full_map_period,
      base::OptionInfo{"How long after a change all of projected_map is sent at the latest, by the "
                       "wall clock; until then a receiver that lost an update may go without it",
                       "s", 0.1, 3600.0});
  visit("heartbeat_period", o.heartbeat_period,
        base::OptionInfo{
            "How often an update of 0x0 cells, stamped with the newest cloud in the map, "
            "tells drivers that the map is kept, by the wall clock; 0: never, then a "
            "mapping that hangs is not noticed",
            "s", 0.0, 3600.0});
  visit("publish_free_space", o.publish_free_space,
        base::OptionInfo{"Whether free_cells_vis_array is published, which takes long", ""});
}

template <class Visitor>
void visitOptions(ProjectedMapOptions& o, Visitor&& visit) {
  visit("filename", o.filename,
        base::OptionInfo{
            "Octree file (.bt or .ot) below the folder to load from to begin with, a new one "
            "replaces the map; one that cannot be read ends the node; empty: none",
            ""});
  visit("frame_id", o.frame_id, base::OptionInfo{"Frame of the map; read at the start", ""});
  visit("base_frame_id", o.base_frame_id,
        base::OptionInfo{"Frame of the vehicle: for filter_ground and projection_reference vehicle",
                         ""});
  visitOptions(o.octree, visit);
  visitOptions(o.cloud, visit);
  visitCloudQueueOptions(o, visit);
  visitBandOptions(o, visit);
  visitOptions(o.projection, visit);
  visitPublishingOptions(o, visit);
  visitOptions(o.colors, visit);
  visit(
      "map_file", o.map_file,
      base::OptionInfo{
          "Where ~save_map writes, below the folder to save in, a map_server YAML, if its request "
          "names no file",
          ""}
          .under("Files"));
  visit("octree_file", o.octree_file,
        base::OptionInfo{
            "Where ~save_octree writes, below the folder to save in, .bt or .ot, if its request "
            "names no file",
            ""});
  visit("autosave_period", o.autosave_period,
        base::OptionInfo{
            "How old the file is at most that this node begins with when it was ended "
            "and starts again under the same roscore, where the machine keeps up: diagnostics "
            "warn where not; 0: there is none, and such a "
            "node begins empty; read at the start",
            "s", 0.0, 3600.0});
  visitOptions(o.reading, visit);
}

// The projection's options with their band. Throws InputError for a projection_min_z or
// projection_max_z that is neither a number nor "occupancy".
ProjectionOptions projectionOptions(const ProjectedMapOptions& options);

// Throws InputError naming the option.
void checkProjectedMapOptions(const ProjectedMapOptions& options);

// Why octomap_server's parameter `name` has no effect here; "" for other names.
std::string ignoredParameter(const std::string& name);

}  // namespace grid_path_planner::mapping
