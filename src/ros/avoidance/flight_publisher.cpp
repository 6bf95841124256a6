#include "ros/avoidance/flight_publisher.h"

#include <nav_msgs/Path.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "grid_path_planner/AvoidanceStatus.h"
#include "ros/guard/outgoing/latched_message.h"

namespace grid_path_planner::nodes {

using avoidance::Pilot;
using avoidance::PilotAnswer;
using avoidance::VehiclePose;

namespace {

constexpr double kStands = 0.02;  // m/s

using Trajectory = trajectory_msgs::MultiDOFJointTrajectory;

void addPoint(const Eigen::Vector3d& position, double yaw, const Eigen::Vector3d& velocity,
              double seconds, Trajectory& trajectory) {
  trajectory_msgs::MultiDOFJointTrajectoryPoint point;
  point.transforms.resize(1);
  point.transforms[0].translation.x = position.x();
  point.transforms[0].translation.y = position.y();
  point.transforms[0].translation.z = position.z();
  point.transforms[0].rotation.z = std::sin(0.5 * yaw);
  point.transforms[0].rotation.w = std::cos(0.5 * yaw);
  point.velocities.resize(1);
  point.velocities[0].linear.x = velocity.x();
  point.velocities[0].linear.y = velocity.y();
  point.velocities[0].linear.z = velocity.z();
  point.accelerations.resize(1);
  point.time_from_start = ros::Duration(seconds);
  trajectory.points.push_back(point);
}

// Along the open part of the path at a speed, and a stand at its end.
void addPath(const std::vector<Eigen::Vector3d>& path, double open, double yaw, double speed,
             Trajectory& trajectory) {
  double gone = 0.0;
  for (std::size_t i = 0; i + 1 < path.size() && gone < open; ++i) {
    const Eigen::Vector3d edge = path[i + 1] - path[i];
    const double length = edge.norm(), part = std::min(length, open - gone);
    if (length < 1e-6) continue;
    const Eigen::Vector3d along = edge / length;
    const double heading = edge.head<2>().norm() > 0.1 ? std::atan2(edge.y(), edge.x()) : yaw;
    gone += part;
    const bool last = gone >= open || i + 2 == path.size();
    addPoint(path[i] + along * part, heading, last ? Eigen::Vector3d(0, 0, 0) : speed * along,
             gone / speed, trajectory);
  }
}

}  // namespace

FlightPublisher::FlightPublisher(ros::NodeHandle& nh)
    : trajectory_(nh.advertise<Trajectory>("setpoint_trajectory", 10)),
      path_(nh.advertise<nav_msgs::Path>("local_path", 1, true)),
      status_(nh.advertise<AvoidanceStatus>("avoidance_status", 1, true)) {}

void FlightPublisher::path(const Pilot& pilot, const std::string& map_frame,
                           const ros::Time& stamp) {
  nav_msgs::Path message;
  message.header.frame_id = map_frame;
  message.header.stamp = stamp;
  for (const Eigen::Vector3d& point : pilot.path()) {
    geometry_msgs::PoseStamped pose;
    pose.header = message.header;
    pose.pose.position.x = point.x();
    pose.pose.position.y = point.y();
    pose.pose.position.z = point.z();
    pose.pose.orientation.w = 1.0;
    message.poses.push_back(pose);
  }
  publishLatched(path_, message);
}

void FlightPublisher::status(const PilotAnswer& answer, const std::string& map_frame,
                             const ros::Time& stamp) {
  const std::string text = std::string(toString(answer.status)) + answer.sentence;
  if (text == told_) return;
  told_ = text;
  AvoidanceStatus message;
  message.header.frame_id = map_frame;
  message.header.stamp = stamp;
  message.status = toString(answer.status);
  message.sentence = answer.sentence;
  message.clearance_m = answer.clearance;
  message.clear_path_m = answer.clear_path;
  message.cloud_age_s = answer.frame_age;
  message.waypoint = static_cast<std::uint32_t>(answer.waypoint);
  publishLatched(status_, message);
}

void FlightPublisher::trajectory(const Pilot& pilot, const PilotAnswer& answer,
                                 const VehiclePose& at, const std::string& map_frame,
                                 const std::string& base_frame, const ros::Time& stamp) {
  if (trajectory_.getNumSubscribers() == 0) return;
  const base::BodyVelocity& v = answer.velocity;
  const Eigen::Vector3d velocity = base::inMap(v, at.yaw);
  Trajectory message;
  message.header.frame_id = map_frame;
  message.header.stamp = stamp;
  message.joint_names = {base_frame};
  const double speed = velocity.norm();
  addPoint(at.position, at.yaw, velocity, 0.0, message);
  if (speed > kStands) addPath(pilot.path(), answer.clear_path, at.yaw, speed, message);
  message.points.front().velocities[0].angular.z = v.yaw_rate;
  trajectory_.publish(message);
}

}  // namespace grid_path_planner::nodes
