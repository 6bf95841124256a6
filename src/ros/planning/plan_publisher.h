// The latched topics of path_planner.
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "grid_path_planner/PlanStatistics.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/planning/plan.h"

namespace grid_path_planner::nodes {

// Without a stamp, and without what the request says and the clearance.
PlanStatistics statisticsMessage(const planning::Plan& plan);

// The map that was searched: -1 unknown but passable, 100 blocked, else the weight scaled so that 1 is 0
// and the largest weight of the map 99.
nav_msgs::OccupancyGrid planningMapMessage(const costmap::CostGrid& costs,
                                           const std::string& frame_id, const ros::Time& stamp);

// Namespaces "expanded" (cells; at most 50,000 of them, evenly chosen) and "waypoints"; a namespace
// without points is deleted from the display.
visualization_msgs::MarkerArray searchMarkers(const planning::Plan& plan, double cell_size,
                                              const ros::Time& stamp);

class PlanPublisher {
 public:
  explicit PlanPublisher(ros::NodeHandle nh);

  // `path`: empty but with frame and stamp unless found.
  void publishPath(const planning::Plan& plan);
  // `plan_statistics`, stamped now, and `search_markers`. `cell_size` in metres.
  void publishSearch(const planning::Plan& plan, PlanStatistics statistics, double cell_size);
  // `planning_map`.
  void publishMap(const costmap::CostGrid& costs, const std::string& frame_id);

 private:
  ros::Publisher path_;
  ros::Publisher map_;
  ros::Publisher statistics_;
  ros::Publisher markers_;
};

}  // namespace grid_path_planner::nodes
