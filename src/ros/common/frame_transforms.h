// Poses from one frame into another through tf, with a sentence where that fails.
//
//   FrameTransforms transforms(nh);
//   const Pose vehicle = transforms.poseOf("base_link", "map", limit, stop);
//
// Waits on the steady clock, so that a ROS clock that stands still does not hold it up, and asks
// the stop token while waiting.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <stdexcept>
#include <string>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::nodes {

// `what()` is the sentence of a TRANSFORM_ERROR.
class TransformError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class FrameTransforms {
 public:
  explicit FrameTransforms(const ros::NodeHandle& nh);

  // `pose` in `frame`, at the pose's stamp (0: the latest). Throws InputError for a pose without a
  // frame and for what poseFromMessage refuses, TransformError, Stopped. `limit` in seconds.
  path::Pose poseIn(const std::string& frame, const geometry_msgs::PoseStamped& pose, double limit,
                    const base::StopToken& stop) const;

  // The latest pose of the frame `vehicle` in `frame`. Throws TransformError, Stopped.
  path::Pose poseOf(const std::string& vehicle, const std::string& frame, double limit,
                    const base::StopToken& stop) const;

  // Forgets everything but static transforms.
  void clear() { buffer_.clear(); }

 private:
  geometry_msgs::TransformStamped lookup(const std::string& target, const std::string& source,
                                         const ros::Time& stamp, double limit,
                                         const base::StopToken& stop) const;

  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace grid_path_planner::nodes
