// The transforms of navigate_path: the vehicle's pose, and poses of one frame in another.
#pragma once

#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/path/path.h"

namespace grid_path_planner::nodes {

class VehicleFrames {
 public:
  explicit VehicleFrames(const ros::NodeHandle& nh);

  // The newest pose of `vehicle` in `frame`; none where tf has no pose within `timeout` seconds of
  // `now`: then `why` is the reason.
  std::optional<path::Pose> pose(const std::string& vehicle, const std::string& frame,
                                 const ros::Time& now, double timeout, std::string& why) const;

  // The path in the frame of its header. Poses that name another frame are transformed by what tf
  // knows now. Throws InputError for a path without a frame, a frame that tf does not know (while
  // it knows `vehicle`), poses that cannot be transformed, and what pathFromMessage refuses.
  path::Path pathIn(const nav_msgs::Path& message, const std::string& vehicle) const;

  // Points of the frame `from` in the frame `to`. Throws InputError where tf has no transform.
  std::vector<Eigen::Vector3d> points(std::vector<Eigen::Vector3d> points, const std::string& from,
                                      const std::string& to) const;

  void clear() { buffer_.clear(); }

 private:
  void checkKnown(const std::string& frame, const std::string& vehicle) const;

  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace grid_path_planner::nodes
