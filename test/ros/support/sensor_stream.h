// Messages of the navigation sensors of a vehicle on a known trajectory, for rostests.
//
//   SensorStream stream(nh);
//   stream.send(stamp, seconds);       // what is due at so many seconds of the trajectory
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <tf2_ros/transform_broadcaster.h>

#include <atomic>
#include <thread>
#include <vector>

#include "localization/mounted_pose.h"
#include "localization/support/trajectory.h"

namespace grid_path_planner::test {

class SensorStream {
 public:
  explicit SensorStream(ros::NodeHandle nh)
      : imu_(nh.advertise<sensor_msgs::Imu>("imu/data", 100)),
        dvl_(nh.advertise<geometry_msgs::TwistWithCovarianceStamped>("dvl/twist", 100)),
        depth_(nh.advertise<geometry_msgs::PoseWithCovarianceStamped>("depth", 100)),
        usbl_(nh.advertise<geometry_msgs::PoseWithCovarianceStamped>("usbl/pose", 100)) {}

  // Each tick is 10 ms of the trajectory.
  void send(const ros::Time& stamp, int tick) {
    const double t = 0.01 * tick;
    if (tick % 5 == 0) sendFrames(stamp);
    if (sends_imu) imu_.publish(imu(stamp, t));
    if (sends_dvl && tick % 14 == 0) dvl_.publish(dvl(stamp, t));
    if (sends_fixes && tick % 10 == 0) depth_.publish(fix(stamp, t, kImu));
    if (sends_fixes && tick % 20 == 0) usbl_.publish(fix(stamp, t, kUsbl));
  }

  // Of base_link, which is where the IMU is, but 0.1 m below.
  Eigen::Vector3d positionAt(double t) const {
    const localization::State state = trajectory.stateAt(t);
    return state.position + state.attitude * Eigen::Vector3d(0.0, 0.0, -0.1);
  }

  geometry_msgs::TwistWithCovarianceStamped dvl(const ros::Time& stamp, double t) const {
    const localization::State state = trajectory.stateAt(t);
    const Eigen::Vector3d velocity = localization::velocityAt(
        state, trajectory.inertialAt(t, 9.80665).rate, {kDvl, Eigen::Quaterniond::Identity()});
    geometry_msgs::TwistWithCovarianceStamped message;
    message.header.stamp = stamp;
    message.header.frame_id = "dvl_link";
    assign(message.twist.twist.linear, velocity);
    for (const std::size_t i : {0, 7, 14}) message.twist.covariance[i] = 2.5e-5;
    return message;
  }

  localization::Trajectory trajectory;
  std::atomic<bool> sends_imu{true}, sends_dvl{true}, sends_fixes{true};

 private:
  // In the frame of the IMU.
  inline static const Eigen::Vector3d kImu{0.0, 0.0, 0.0}, kDvl{-0.3, 0.0, -0.2},
      kUsbl{0.0, 0.0, 0.4};

  template <class Message>
  static void assign(Message& message, const Eigen::Vector3d& v) {
    message.x = v.x();
    message.y = v.y();
    message.z = v.z();
  }

  sensor_msgs::Imu imu(const ros::Time& stamp, double t) const {
    const localization::Inertial inertial = trajectory.inertialAt(t, 9.80665);
    const Eigen::Quaterniond attitude = trajectory.stateAt(t).attitude;
    sensor_msgs::Imu message;
    message.header.stamp = stamp;
    message.header.frame_id = "imu_link";
    assign(message.angular_velocity, inertial.rate);
    assign(message.linear_acceleration, inertial.acceleration);
    assign(message.orientation, attitude.vec());
    message.orientation.w = attitude.w();
    return message;
  }

  geometry_msgs::PoseWithCovarianceStamped fix(const ros::Time& stamp, double t,
                                               const Eigen::Vector3d& place) const {
    const localization::State state = trajectory.stateAt(t);
    geometry_msgs::PoseWithCovarianceStamped message;
    message.header.stamp = stamp;
    message.header.frame_id = "map";
    assign(message.pose.pose.position, state.position + state.attitude * place);
    for (const std::size_t i : {0, 7, 14}) message.pose.covariance[i] = 0.0025;
    return message;
  }

  void sendFrames(const ros::Time& stamp) {
    const auto frame = [&](const char* name, const Eigen::Vector3d& in_imu) {
      geometry_msgs::TransformStamped transform;
      transform.header.stamp = stamp;
      transform.header.frame_id = "base_link";
      transform.child_frame_id = name;
      assign(transform.transform.translation, in_imu + Eigen::Vector3d(0.0, 0.0, 0.1));
      transform.transform.rotation.w = 1.0;
      return transform;
    };
    broadcaster_.sendTransform(std::vector<geometry_msgs::TransformStamped>{
        frame("imu_link", kImu), frame("pressure_link", kImu), frame("dvl_link", kDvl),
        frame("usbl_link", kUsbl)});
  }

  ros::Publisher imu_, dvl_, depth_, usbl_;
  tf2_ros::TransformBroadcaster broadcaster_;
};

}  // namespace grid_path_planner::test
