#include "ros/avoidance/flight_publisher.h"

#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <limits>

#include "grid_path_planner/AvoidanceStatus.h"

namespace grid_path_planner::nodes {

using avoidance::HistogramView;
using avoidance::Pilot;
using avoidance::PilotAnswer;
using avoidance::RememberedPoint;

namespace {

sensor_msgs::PointCloud2 cloudOf(const std::vector<RememberedPoint>& remembered) {
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(remembered.size());
  sensor_msgs::PointCloud2Iterator<float> value(cloud, "x");
  for (const RememberedPoint& point : remembered) {
    for (int axis = 0; axis < 3; ++axis) value[axis] = static_cast<float>(point.position[axis]);
    ++value;
  }
  return cloud;
}

// The nearest of each column's rows within 30 degrees of level, from behind on anticlockwise.
sensor_msgs::LaserScan scanOf(const HistogramView& view, double yaw) {
  sensor_msgs::LaserScan scan;
  const double width = 2.0 * M_PI / view.columns;
  scan.angle_min = static_cast<float>(-M_PI - yaw);
  scan.angle_increment = static_cast<float>(width);
  scan.angle_max = static_cast<float>(scan.angle_min + width * (view.columns - 1));
  scan.range_max = 12.0F;
  const int middle = view.rows / 2, reach = view.rows / 6;
  for (int column = 0; column < view.columns; ++column) {
    float nearest = std::numeric_limits<float>::infinity();
    for (int row = middle - reach; row <= middle + reach; ++row)
      nearest = std::min(nearest, view.distances[row * view.columns + column]);
    scan.ranges.push_back(nearest);
  }
  return scan;
}

}  // namespace

FlightPublisher::FlightPublisher(ros::NodeHandle& nh)
    : velocity_(nh.advertise<geometry_msgs::Twist>("cmd_vel", 10)),
      setpoint_(nh.advertise<geometry_msgs::TwistStamped>("setpoint_velocity", 10)),
      path_(nh.advertise<nav_msgs::Path>("local_path", 1, true)),
      status_(nh.advertise<AvoidanceStatus>("avoidance_status", 1, true)),
      distances_(nh.advertise<sensor_msgs::LaserScan>("obstacle_distance", 1)),
      points_(nh.advertise<sensor_msgs::PointCloud2>("remembered_points", 1)) {}

void FlightPublisher::command(const base::BodyVelocity& velocity, double yaw,
                              const std::string& map_frame, const ros::Time& stamp) {
  geometry_msgs::Twist twist;
  twist.linear.x = velocity.surge;
  twist.linear.y = velocity.sway;
  twist.linear.z = velocity.heave;
  twist.angular.z = velocity.yaw_rate;
  velocity_.publish(twist);
  geometry_msgs::TwistStamped stamped;
  stamped.header.frame_id = map_frame;
  stamped.header.stamp = stamp;
  stamped.twist = twist;
  const Eigen::Vector3d in_map = base::inMap(velocity, yaw);
  stamped.twist.linear.x = in_map.x();
  stamped.twist.linear.y = in_map.y();
  setpoint_.publish(stamped);
}

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
  path_.publish(message);
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
  status_.publish(message);
}

void FlightPublisher::surroundings(const Pilot& pilot, const std::string& map_frame, double yaw,
                                   const std::string& base_frame, const ros::Time& stamp) {
  if (distances_.getNumSubscribers() > 0) {
    sensor_msgs::LaserScan scan = scanOf(pilot.histogram(), yaw);
    scan.header.frame_id = base_frame;
    scan.header.stamp = stamp;
    distances_.publish(scan);
  }
  if (points_.getNumSubscribers() > 0) {
    sensor_msgs::PointCloud2 cloud = cloudOf(pilot.rememberedPoints());
    cloud.header.frame_id = map_frame;
    cloud.header.stamp = stamp;
    points_.publish(cloud);
  }
}

}  // namespace grid_path_planner::nodes
