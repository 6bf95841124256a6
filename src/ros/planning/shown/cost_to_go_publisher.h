// What it costs to reach the goal from every cell of the searched map: ~cost_to_go, a map to look at,
// and ~cost_to_go_image, the values themselves. Both are made only for a topic that has a subscriber.
//
//   CostToGoPublisher publisher(private_nh, [&] { postCostToGo(); });
//   if (publisher.wanted()) publisher.publish(costs, goal, "map", memory_limit);  // returns at once
//
// A thread of its own computes them, so no caller waits; of what comes meanwhile only the last is
// published. A map for which that takes more than the memory limit is refused with an error in the log.
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sensor_msgs/Image.h>

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/base/task_queue.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/tables/cost_to_go.h"
#include "ros/guard/guarded_queue.h"

namespace grid_path_planner::nodes {

// A value a cell, row by row as in nav_msgs/OccupancyGrid: cost to the goal in metres x weight,
// infinite where no path leads there.
std::vector<float> costsToGo(const planners::CostToGo& field);

// 0 at the goal, 100 where the path is the costliest, -1 where there is none.
nav_msgs::OccupancyGrid costToGoMap(const grid::GridGeometry& geometry,
                                    const std::vector<float>& costs, const std::string& frame_id,
                                    const ros::Time& stamp);
// Encoding 32FC1; its row 0 is the map's.
sensor_msgs::Image costToGoImage(const grid::GridGeometry& geometry,
                                 const std::vector<float>& costs, const std::string& frame_id,
                                 const ros::Time& stamp);

class CostToGoPublisher {
 public:
  // Advertises both topics below `private_nh`. `on_subscriber` is called in the thread of its queue for
  // a new subscriber, who waits for publish().
  CostToGoPublisher(ros::NodeHandle private_nh, std::function<void()> on_subscriber);
  // Cancels what is computed and unadvertises both topics.
  ~CostToGoPublisher() { worker_.stop(); }

  bool wanted() const { return map_.getNumSubscribers() + image_.getNumSubscribers() > 0; }

  // Of this goal in the map's frame, metres. Nothing is published for a goal outside the map.
  // `memory_limit` in bytes.
  void publish(std::shared_ptr<const costmap::CostGrid> costs, const Eigen::Vector2d& goal,
               const std::string& frame_id, std::size_t memory_limit);

 private:
  void computeAndTell(std::shared_ptr<const costmap::CostGrid> costs, grid::Cell goal,
                      const std::string& frame_id, const base::StopToken& stop);

  ros::Publisher map_;
  ros::Publisher image_;
  base::TaskQueue worker_{
      [](const std::string& error) { tellGivenUp("A publication of costs to go", error); }};
};

}  // namespace grid_path_planner::nodes
