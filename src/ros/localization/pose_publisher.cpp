#include "ros/localization/pose_publisher.h"

#include <vector>

#include "localization/measurement_models.h"
#include "localization/mounted_pose.h"
#include "ros/guard/clock.h"

namespace grid_path_planner::nodes {

using localization::kErrors;
using localization::MountedPose;
using localization::Mounting;
using localization::PoseCovariance;

namespace {

geometry_msgs::Quaternion messageOf(const Eigen::Quaterniond& q) {
  geometry_msgs::Quaternion message;
  message.w = q.w();
  message.x = q.x();
  message.y = q.y();
  message.z = q.z();
  return message;
}

template <class Message>
Message messageOf(const Eigen::Vector3d& v) {
  Message message;
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
  return message;
}

void fill(boost::array<double, 36>& covariance, const PoseCovariance& matrix) {
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(covariance.data()) = matrix;
}

// Of the velocity of the base in its own frame; that of the turn rate is the gyro's bias.
PoseCovariance twistCovariance(const localization::Estimate& estimate, const Mounting& base) {
  localization::Jacobian<6> jacobian;
  jacobian.topRows<3>() = localization::velocityJacobian(estimate.state, base);
  jacobian.bottomRows<3>().setZero();
  jacobian.block<3, 3>(3, localization::kGyroBias) = -base.rotation.toRotationMatrix().transpose();
  return jacobian * estimate.covariance * jacobian.transpose();
}

Mounting baseIn(const PublishedEstimate& published, const Mounting& base) {
  const localization::State& state = published.estimate.state;
  return Mounting{state.position, state.attitude} * base;
}

geometry_msgs::TransformStamped transformOf(const Mounting& pose, const std::string& frame,
                                            const std::string& child, const ros::Time& stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = frame;
  transform.header.stamp = stamp;
  transform.child_frame_id = child;
  transform.transform.translation = messageOf<geometry_msgs::Vector3>(pose.position);
  transform.transform.rotation = messageOf(pose.rotation.normalized());
  return transform;
}

}  // namespace

PosePublisher::PosePublisher(ros::NodeHandle& nh, const VehicleLocalizerOptions& options)
    : options_(options),
      filtered_(nh.advertise<nav_msgs::Odometry>("odometry/filtered", 10)),
      local_(nh.advertise<nav_msgs::Odometry>("odometry/local", 10)) {}

bool PosePublisher::isDue(const ros::Time& stamp) const {
  // A quarter less: stamps of sensors come in steps of their own.
  return secondsBetween(last_, stamp) > 0.75 / options_.publish_rate;
}

nav_msgs::Odometry PosePublisher::odometryOf(const PublishedEstimate& published,
                                             const Mounting& base, const std::string& frame,
                                             const ros::Time& stamp) const {
  const MountedPose pose = localization::carried(localization::poseOf(published.estimate), base);
  nav_msgs::Odometry message;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  message.child_frame_id = options_.base_frame;
  message.pose.pose.position = messageOf<geometry_msgs::Point>(pose.position);
  message.pose.pose.orientation = messageOf(pose.attitude.normalized());
  fill(message.pose.covariance, localization::worldCovariance(pose));
  message.twist.twist.linear = messageOf<geometry_msgs::Vector3>(
      localization::velocityAt(published.estimate.state, published.rate, base));
  message.twist.twist.angular =
      messageOf<geometry_msgs::Vector3>(base.rotation.conjugate() * published.rate);
  fill(message.twist.covariance, twistCovariance(published.estimate, base));
  return message;
}

std::optional<Mounting> PosePublisher::mapToOdometry(const PublishedPoses& poses,
                                                     const Mounting& base) const {
  if (!options_.publish_map_to_odom || !poses.map || !poses.map_to_odom) return {};
  if (!options_.publish_odom_to_base) return poses.map_to_other_odometry;
  return baseIn(*poses.map, base) * localization::inverse(baseIn(*poses.odometry, base));
}

void PosePublisher::sendTransforms(const PublishedPoses& poses, const Mounting& base,
                                   const ros::Time& stamp, TransformRivals& rivals) {
  std::vector<geometry_msgs::TransformStamped> transforms;
  if (options_.publish_odom_to_base)
    transforms.push_back(transformOf(baseIn(*poses.odometry, base), options_.odom_frame,
                                     options_.base_frame, stamp));
  if (const auto odometry = mapToOdometry(poses, base))
    transforms.push_back(transformOf(*odometry, options_.map_frame, options_.odom_frame, stamp));
  if (transforms.empty()) return;
  for (const auto& transform : transforms) rivals.sent(transform.child_frame_id, stamp);
  broadcaster_.sendTransform(transforms);
}

void PosePublisher::publish(const PublishedPoses& poses, const Mounting& base,
                            const ros::Time& stamp, TransformRivals& rivals) {
  last_ = stamp;
  if (poses.odometry) {
    local_.publish(odometryOf(*poses.odometry, base, options_.odom_frame, stamp));
    if (rivals.rival().empty()) sendTransforms(poses, base, stamp, rivals);
  }
  if (poses.map) filtered_.publish(odometryOf(*poses.map, base, options_.map_frame, stamp));
}

}  // namespace grid_path_planner::nodes
