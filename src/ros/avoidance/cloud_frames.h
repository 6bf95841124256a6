// Clouds that wait for the pose of their sensor, as frames for the pilot.
//
//   frames.add(cloud);                        // in the callback
//   while (auto frame = frames.next(transforms, "map", now)) use(*frame);
//
// Only the newest cloud waits: an older one tells nothing that it does not. One that waits in vain for
// longer than the time limit is dropped, and problem() says why.
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include <optional>
#include <string>

#include "grid_path_planner/avoidance/frame.h"
#include "ros/common/frame_transforms.h"

namespace grid_path_planner::nodes {

class CloudFrames {
 public:
  void add(const sensor_msgs::PointCloud2::ConstPtr& cloud);
  void setCamera(const sensor_msgs::CameraInfo& camera);
  void clear();

  // The cloud that waits, once tf knows where its sensor was.
  std::optional<avoidance::Frame> next(const FrameTransforms& transforms,
                                       const std::string& map_frame, const ros::Time& now);
  // Why the newest cloud could not be used; empty: it could.
  const std::string& problem() const { return problem_; }

 private:
  bool isOfAnotherTime(const ros::Time& now);
  std::optional<avoidance::Pinhole> pinholeOf(const sensor_msgs::PointCloud2& cloud) const;

  sensor_msgs::PointCloud2::ConstPtr waiting_;
  bool waits_for_tf_ = false;  // which was asked in vain
  std::optional<sensor_msgs::CameraInfo> camera_;
  std::string problem_;
};

}  // namespace grid_path_planner::nodes
