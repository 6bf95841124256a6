// What path_planner tells the others: the latched topics.
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "grid_path_planner/PlanStatistics.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "ros/planning/planning_backend.h"

namespace grid_path_planner::nodes {

PlanStatistics statisticsMessage(const PlanningResult& answer,
                                 const geometry_msgs::PoseStamped& goal, const ros::Time& stamp);

// The map as searched: -1 unknown but passable, 100 blocked, else the weight scaled so that 1 is 0
// and the largest weight of the map 99.
nav_msgs::OccupancyGrid planningMapMessage(const costmap::CostGrid& costs,
                                           const std::string& frame_id, const ros::Time& stamp);

// Namespaces "expanded" (cells; at most 50,000 of them, evenly chosen) and "waypoints"; what an
// answer does not have is deleted from the display.
visualization_msgs::MarkerArray searchMarkers(const PlanningResult& answer, double cell_size,
                                              const ros::Time& stamp);

class PlanPublisher {
 public:
  explicit PlanPublisher(ros::NodeHandle nh);

  // `path`: empty but with frame and stamp unless found.
  void publishPath(const PlanningResult& answer);
  // `plan_statistics` and `search_markers`. `cell_size` in metres.
  void publishSearch(const PlanningResult& answer, const geometry_msgs::PoseStamped& goal,
                     double cell_size);
  // `planning_map`.
  void publishMap(const costmap::CostGrid& costs, const std::string& frame_id);

 private:
  ros::Publisher path_;
  ros::Publisher map_;
  ros::Publisher statistics_;
  ros::Publisher markers_;
};

}  // namespace grid_path_planner::nodes
