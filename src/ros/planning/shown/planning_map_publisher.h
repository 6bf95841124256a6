// planning_map, the map as it is searched, and planning_map_updates, what changes in it: made only
// where someone listens (ros/messages/map_topic.h).
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"
#include "ros/messages/map_topic.h"

namespace grid_path_planner::nodes {

// -1 unknown but passable, 100 blocked, else the weight scaled so that 1 is 0 and the largest weight
// of the map 99.
nav_msgs::OccupancyGrid planningMapMessage(const costmap::CostGrid& costs,
                                           const std::string& frame_id, const ros::Time& stamp);

// The parts of it in `cells`, which lie in the map, an update each.
std::vector<map_msgs::OccupancyGridUpdate> planningMapUpdates(
    const costmap::CostGrid& costs, const std::vector<grid::CellRect>& cells,
    const std::string& frame_id, const ros::Time& stamp);

class PlanningMapPublisher {
 public:
  // `on_subscriber` is called in the thread of `nh` for a new subscriber, who waits for publish().
  PlanningMapPublisher(ros::NodeHandle nh, std::function<void()> on_subscriber);

  // What differs from the costmap of the last call, as the subscribers need it. `changes`: up to
  // `costs`, which hold what was measured until `newest`. From one thread.
  void publish(const costmap::CostGrid& costs, const costmap::CostChanges& changes,
               const std::string& frame_id, const ros::Time& newest, double full_map_period);
  // Whether publish() has a whole map to send though nothing changed.
  bool wholeMapIsDue(double full_map_period) const { return topic_.wholeMapIsDue(full_map_period); }

 private:
  // Of the costmap that the subscribers have.
  struct Published {
    std::uint64_t revision;
    costmap::CostGrid::Weight max_weight;  // by which the others are scaled
    std::string frame_id;
  };

  // What changed since then; nullopt where a whole map must be sent.
  std::optional<std::vector<grid::CellRect>> changed(const costmap::CostGrid& costs,
                                                     const costmap::CostChanges& changes,
                                                     const std::string& frame_id) const;

  MapTopic topic_;
  std::optional<Published> published_;
};

}  // namespace grid_path_planner::nodes
