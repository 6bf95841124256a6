// Messages of the navigation sensors of a vehicle on a known trajectory, sent live, for rostests.
//
//   SensorStream stream(nh);
//   stream.send(stamp, tick);       // what is due then
#pragma once

#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <atomic>

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
    if (sends_imu) imu_.publish(imu(stamp, t));
    if (sends_dvl && tick % 14 == 0) dvl_.publish(dvl(stamp, t));
    if (sends_fixes && tick % 10 == 0) depth_.publish(depth(stamp, t));
    if (sends_fixes && tick % 20 == 0) usbl_.publish(usbl(stamp, t));
  }

  std::atomic<bool> sends_imu{true}, sends_dvl{true}, sends_fixes{true};

 private:
  ros::Publisher imu_, dvl_, depth_, usbl_;
  tf2_ros::TransformBroadcaster broadcaster_;
};

}  // namespace grid_path_planner::test
