// The pose of the vehicle as topics and tf.
//
//   odometry/filtered  nav_msgs/Odometry in map_frame
//   odometry/local     nav_msgs/Odometry in odom_frame
//   tf                 map_frame -> odom_frame -> base_frame
//
// Where another node publishes odom_frame -> base_frame its odometry has an origin of its own: map_frame -> odom_frame is
// then what the caller has found out by it, and left out where that is nothing.
//
// Guaranteed: each stamp is published once, in rising order; what is stamped before the last is passed
// over. No transform is static.
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_ros/transform_broadcaster.h>

#include <optional>

#include "localization/lagged_filter.h"
#include "ros/localization/transform_rivals.h"
#include "ros/localization/vehicle_localizer_options.h"

namespace grid_path_planner::nodes {

// A snapshot of a filter, and the turn rate of the body (rad/s).
struct PublishedEstimate {
  localization::Estimate estimate;
  Eigen::Vector3d rate;
};

struct PublishedPoses {
  std::optional<PublishedEstimate> map, odometry;
  bool map_to_odom = false;  // whether the pose in the map may be relied on
  // map_frame -> odom_frame where another node publishes odom_frame -> base_frame (other_odometry.h).
  std::optional<localization::Mounting> map_to_other_odometry = {};
};

class PosePublisher {
 public:
  // `options`, as they are at any time, outlive this.
  PosePublisher(ros::NodeHandle& nh, const VehicleLocalizerOptions& options);

  // ROS time begins anew.
  void reset() { last_ = ros::Time(); }

  // Whether that stamp is later than the last by at least a period.
  bool isDue(const ros::Time& stamp) const;

  // `base`: of base_frame in the body frame. Transforms are left out where `rivals` knows one.
  void publish(const PublishedPoses& poses, const localization::Mounting& base,
               const ros::Time& stamp, TransformRivals& rivals);

 private:
  nav_msgs::Odometry odometryOf(const PublishedEstimate& published,
                                const localization::Mounting& base, const std::string& frame,
                                const ros::Time& stamp) const;
  std::optional<localization::Mounting> mapToOdometry(const PublishedPoses& poses,
                                                      const localization::Mounting& base) const;
  void sendTransforms(const PublishedPoses& poses, const localization::Mounting& base,
                      const ros::Time& stamp, TransformRivals& rivals);

  const VehicleLocalizerOptions& options_;
  ros::Time last_;
  ros::Publisher filtered_, local_;
  tf2_ros::TransformBroadcaster broadcaster_;
};

}  // namespace grid_path_planner::nodes
