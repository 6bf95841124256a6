// planning_map, the map as it is searched, and planning_map_updates, what changes in it: made only
// where someone listens (ros/common/outgoing/map_topic.h).
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"
#include "ros/common/outgoing/map_topic.h"

namespace grid_path_planner::nodes {

// -1 unknown but passable, 100 blocked, else the weight scaled so that 1 is 0 and the largest weight
// of the map 99.
nav_msgs::OccupancyGrid planningMapMessage(const costmap::CostGrid& costs,
                                           const std::string& frame_id, const ros::Time& stamp);

// The part of it in `cells`, which lie in the map.
map_msgs::OccupancyGridUpdate planningMapUpdate(const costmap::CostGrid& costs,
                                                const grid::CellRect& cells,
                                                const std::string& frame_id,
                                                const ros::Time& stamp);

// Rectangles that hold all cells in which two costmaps of the same geometry differ; changes that are
// some rows apart have one each.
std::vector<grid::CellRect> differingCells(const costmap::CostGrid& a, const costmap::CostGrid& b);

class PlanningMapPublisher {
 public:
  // `on_subscriber` is called in the thread of `nh` for a new subscriber, who waits for publish().
  PlanningMapPublisher(ros::NodeHandle nh, std::function<void()> on_subscriber);

  // What differs from the costmap of the last call, as the subscribers need it. From one thread.
  void publish(const std::shared_ptr<const costmap::CostGrid>& costs, const std::string& frame_id,
               double full_map_period);
  // Whether publish() has a whole map to send though nothing changed.
  bool wholeMapIsDue(double full_map_period) const { return topic_.wholeMapIsDue(full_map_period); }

 private:
  bool wholeMapIsWanted(const costmap::CostGrid& costs, const std::string& frame_id,
                        double full_map_period);
  void sendChanges(const costmap::CostGrid& costs);

  MapTopic topic_;
  std::shared_ptr<const costmap::CostGrid> published_;  // null: nothing that a subscriber has
  std::string frame_id_;
};

}  // namespace grid_path_planner::nodes
