// Publishes the searched map as rectangles: `rectangle_map` and `rectangle_markers`, latched.
//
//   RectanglePublisher publisher(nh);
//   publisher.publish(costs, "map", memory_limit);     // returns at once
//
// A thread of its own decomposes the maps, so no caller waits for it; where maps come faster, those
// in between are left out, and the last is always published. A map whose decomposition needs more
// than the memory limit is refused with an error in the log, and the old rectangles stay.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <cstddef>
#include <memory>
#include <string>

#include "grid_path_planner/base/task_queue.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "ros/guard/guarded_queue.h"
#include "ros/planning/rectangle_messages.h"

namespace grid_path_planner::nodes {

class RectanglePublisher {
 public:
  // Advertises both topics.
  explicit RectanglePublisher(ros::NodeHandle nh);
  // Cancels the decomposition and unadvertises both topics.
  ~RectanglePublisher() { worker_.stop(); }

  // Nobody gets the last rectangle_map any longer; deletes the markers, which rviz shows on otherwise.
  void clear();
  // Whether publish() was called after the last clear().
  bool shown() const { return shown_; }

  // The passable cells of `costs`, in this frame. `memory_limit` in bytes.
  void publish(std::shared_ptr<const costmap::CostGrid> costs, const std::string& frame_id,
               std::size_t memory_limit);

 private:
  void cutAndTell(std::shared_ptr<const costmap::CostGrid> costs, const std::string& frame_id,
                  std::size_t memory_limit, const base::StopToken& stop);

  ros::Publisher map_;  // the worker's, as is markers_
  ros::Publisher markers_;
  bool shown_ = false;
  base::TaskQueue worker_{
      [](const std::string& error) { tellGivenUp("A publication of rectangles", error); }};
};

}  // namespace grid_path_planner::nodes
