// Which points of a cloud become obstacles. Without OctoMap, for programs that only read options.
#pragma once

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::mapping {

struct GroundFilterOptions {
  double distance = 0.04;        // m
  double angle = 0.15;           // rad
  double plane_distance = 0.07;  // m
};

struct CloudFilterOptions {
  double min_x = -1e6;  // m, frame of the tree
  double max_x = 1e6;
  double min_y = -1e6;
  double max_y = 1e6;
  double min_z = -1e6;
  double max_z = 1e6;
  bool filter_ground = false;
  GroundFilterOptions ground;
};

template <class Visitor>
void visitOptions(CloudFilterOptions& o, Visitor&& visit) {
  const auto side = [](const char* description) {
    return base::OptionInfo{description, "m", -1e9, 1e9};
  };
  visit("pointcloud_min_x", o.min_x,
        side("Points with a smaller x, in the frame of the map, are no obstacles: they only clear "
             "the ray to them")
            .under("What of a cloud becomes an obstacle"));
  visit("pointcloud_max_x", o.max_x, side("Points with a larger x are no obstacles"));
  visit("pointcloud_min_y", o.min_y, side("Points with a smaller y are no obstacles"));
  visit("pointcloud_max_y", o.max_y, side("Points with a larger y are no obstacles"));
  visit("pointcloud_min_z", o.min_z, side("Points with a smaller z are no obstacles"));
  visit("pointcloud_max_z", o.max_z, side("Points with a larger z are no obstacles"));
  visit("filter_ground", o.filter_ground,
        base::OptionInfo{
            "Whether points of the ground plane are no obstacles; needs tf to base_frame_id", ""});
  visit("ground_filter/distance", o.ground.distance,
        base::OptionInfo{"How far from the ground plane a point is ground", "m", 0.0, 100.0});
  visit("ground_filter/angle", o.ground.angle,
        base::OptionInfo{"How far from level the ground plane may lean", "rad", 0.0, 1.6});
  visit("ground_filter/plane_distance", o.ground.plane_distance,
        base::OptionInfo{"How far from the base frame's origin the ground plane may pass", "m", 0.0,
                         100.0});
}

// Throws InputError naming the option for a value outside its limits and a box that holds nothing.
void checkCloudFilterOptions(const CloudFilterOptions& options);

}  // namespace grid_path_planner::mapping
