// Messages of the navigation sensors of a vehicle on a known trajectory, sent live, for rostests.
//
//   SensorStream stream(nh);
//   stream.send(stamp, tick);       // what is due then
#pragma once

#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <atomic>
#include <thread>

#include "ros/support/trajectory_messages.h"

namespace grid_path_planner::test {

class SensorStream : public TrajectoryMessages {
 public:
  explicit SensorStream(ros::NodeHandle nh)
      : imu_(nh.advertise<sensor_msgs::Imu>("imu/data", 100)),
        dvl_(nh.advertise<geometry_msgs::TwistWithCovarianceStamped>("dvl/twist", 100)),
        depth_(nh.advertise<Fix>("depth", 100)),
        usbl_(nh.advertise<Fix>("usbl/pose", 100)) {}

  // Each tick is 10 ms of the trajectory.
  void send(const ros::Time& stamp, int tick) {
    const double t = 0.01 * tick;
    if (tick % 5 == 0) broadcaster_.sendTransform(frames(stamp));
    if (sends_imu) imu_.publish(drifted(imu(stamp, t)));
    if (sends_dvl && tick % 14 == 0) dvl_.publish(dvl(stamp, t));
    if (sends_fixes && tick % 10 == 0) depth_.publish(depth(stamp, t));
    if (sends_fixes && tick % 20 == 0) usbl_.publish(usbl(stamp, t));
  }

  std::atomic<bool> sends_imu{true}, sends_dvl{true}, sends_fixes{true};
  std::atomic<double> drift{0.0};  // rad, of the IMU's heading

 private:
  // Of a plain one.
  sensor_msgs::Imu drifted(sensor_msgs::Imu message) const {
    const auto& o = message.orientation;
    assign(message.orientation,
           Eigen::Quaterniond(Eigen::AngleAxisd(drift, Eigen::Vector3d::UnitZ()) *
                              Eigen::Quaterniond(o.w, o.x, o.y, o.z)));
    return message;
  }

  ros::Publisher imu_, dvl_, depth_, usbl_;
  tf2_ros::TransformBroadcaster broadcaster_;
};

// Sends in a thread of its own, by the wall clock.
class LiveStream {
 public:
  explicit LiveStream(SensorStream& stream) : thread_([this, &stream] { run(stream); }) {}
  ~LiveStream() {
    over_ = true;
    thread_.join();
  }
  double secondsAt(const ros::Time& stamp) const { return (stamp - start_).toSec(); }

 private:
  void run(SensorStream& stream) {
    for (int tick = 0; !over_; ++tick) {
      const ros::Time due = start_ + ros::Duration(0.01 * tick);
      while (ros::Time::now() < due) ros::WallDuration(0.001).sleep();
      stream.send(due, tick);
    }
  }
  const ros::Time start_ = ros::Time::now();
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace grid_path_planner::test
