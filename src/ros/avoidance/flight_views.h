// What local_planner sees and intends, for people and for other programs; made only while someone listens.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "grid_path_planner/avoidance/pilot.h"

namespace grid_path_planner::nodes {

class FlightViews {
 public:
  explicit FlightViews(ros::NodeHandle& nh);

  struct View {
    const avoidance::Pilot& pilot;
    const avoidance::PilotAnswer& answer;
    const avoidance::VehiclePose& at;
    std::string map_frame, base_frame;
    ros::Time stamp;
  };
  // obstacle_distance, remembered_points, histogram_image and avoidance_markers.
  void show(const View& view);

 private:
  ros::Publisher distances_, points_, histogram_, markers_;
};

}  // namespace grid_path_planner::nodes
