// What the navigation sensors of a vehicle on a known trajectory say, as messages: for rostests.
//
//   TrajectoryMessages messages;
//   bag.write("imu/data", stamp, messages.imu(stamp, seconds));     // at so many seconds of the trajectory
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <sensor_msgs/Imu.h>

#include <vector>

#include "localization/mounted_pose.h"
#include "localization/support/trajectory.h"

namespace grid_path_planner::test {

struct TrajectoryMessages {
  using Fix = geometry_msgs::PoseWithCovarianceStamped;

  localization::Trajectory trajectory;

  // Of base_link, which is where the IMU is, but 0.1 m below.
  Eigen::Vector3d positionAt(double t) const {
    const localization::State state = trajectory.stateAt(t);
    return state.position + state.attitude * kBase;
  }

  sensor_msgs::Imu imu(const ros::Time& stamp, double t) const {
    const localization::Inertial inertial = trajectory.inertialAt(t, 9.80665);
    sensor_msgs::Imu message;
    message.header.stamp = stamp;
    message.header.frame_id = "imu_link";
    assign(message.angular_velocity, inertial.rate);
    assign(message.linear_acceleration, inertial.acceleration);
    assign(message.orientation, trajectory.stateAt(t).attitude);
    return message;
  }

  geometry_msgs::TwistWithCovarianceStamped dvl(const ros::Time& stamp, double t) const {
    const Eigen::Vector3d velocity =
        localization::velocityAt(trajectory.stateAt(t), trajectory.inertialAt(t, 9.80665).rate,
                                 {kDvl, {1.0, 0.0, 0.0, 0.0}});
    geometry_msgs::TwistWithCovarianceStamped message;
    message.header.stamp = stamp;
    message.header.frame_id = "dvl_link";
    assign(message.twist.twist.linear, velocity);
    for (const std::size_t i : {0, 7, 14}) message.twist.covariance[i] = 2.5e-5;
    return message;
  }

  Fix depth(const ros::Time& stamp, double t) const { return fix(stamp, t, kImu); }
  Fix usbl(const ros::Time& stamp, double t) const { return fix(stamp, t, kUsbl); }

  // Of base_link.
  Fix marker(const ros::Time& stamp, double t) const {
    Fix message = fix(stamp, t, kBase);
    assign(message.pose.pose.orientation, trajectory.stateAt(t).attitude);
    for (const std::size_t i : {21, 28, 35}) message.pose.covariance[i] = 0.0025;
    return message;
  }

  // Where the sensors are on the vehicle.
  std::vector<geometry_msgs::TransformStamped> frames(const ros::Time& stamp) const {
    const auto frame = [&](const char* name, const Eigen::Vector3d& in_imu) {
      geometry_msgs::TransformStamped transform;
      transform.header.stamp = stamp;
      transform.header.frame_id = "base_link";
      transform.child_frame_id = name;
      assign(transform.transform.translation, in_imu - kBase);
      transform.transform.rotation.w = 1.0;
      return transform;
    };
    return {frame("imu_link", kImu), frame("pressure_link", kImu), frame("dvl_link", kDvl),
            frame("usbl_link", kUsbl)};
  }

 protected:
  // In the frame of the IMU.
  inline static const Eigen::Vector3d kImu{0.0, 0.0, 0.0}, kBase{0.0, 0.0, -0.1},
      kDvl{-0.3, 0.0, -0.2}, kUsbl{0.0, 0.0, 0.4};

  template <class Message>
  static void assign(Message& message, const Eigen::Vector3d& v) {
    message.x = v.x();
    message.y = v.y();
    message.z = v.z();
  }
  static void assign(geometry_msgs::Quaternion& message, const Eigen::Quaterniond& q) {
    assign(message, Eigen::Vector3d(q.vec()));
    message.w = q.w();
  }

  Fix fix(const ros::Time& stamp, double t, const Eigen::Vector3d& place) const {
    const localization::State state = trajectory.stateAt(t);
    Fix message;
    message.header.stamp = stamp;
    message.header.frame_id = "map";
    assign(message.pose.pose.position, state.position + state.attitude * place);
    for (const std::size_t i : {0, 7, 14}) message.pose.covariance[i] = 0.0025;
    return message;
  }
};

}  // namespace grid_path_planner::test
