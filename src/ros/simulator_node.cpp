#include "grid_path_planner/ros/simulator_node.h"

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/console.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/UInt32.h>

#include <algorithm>
#include <cmath>

#include "grid_path_planner/SimulatorConfig.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "grid_path_planner/ros/parameters.h"

namespace grid_path_planner {
namespace {

// Wall time that a late timer makes up for; beyond it simulated time goes slower instead of
// leaping.
constexpr double kLongestDelay = 0.05;  // s

VehicleState initialState(const SimulatorOptions& o) {
  return {Eigen::Vector3d(o.initial_x, o.initial_y, o.initial_z), o.initial_yaw, {}};
}

bool sameStart(const SimulatorOptions& a, const SimulatorOptions& b) {
  return a.initial_x == b.initial_x && a.initial_y == b.initial_y && a.initial_z == b.initial_z &&
         a.initial_yaw == b.initial_yaw;
}

SimulatorOptions loadOptions(const ros::NodeHandle& private_nh) {
  SimulatorOptions options;
  loadParameters(private_nh, options);
  checkSimulatorOptions(options);
  warnUnknownParameters(private_nh, optionNames<SimulatorOptions>());
  return options;
}

geometry_msgs::Quaternion quaternionOf(double yaw) {
  geometry_msgs::Quaternion q;
  q.z = std::sin(0.5 * yaw);
  q.w = std::cos(0.5 * yaw);
  return q;
}

nav_msgs::Odometry odometryOf(const VehicleState& state, const SimulatorOptions& options) {
  nav_msgs::Odometry message;
  message.header.frame_id = options.odom_frame;
  message.child_frame_id = options.base_frame;
  message.pose.pose.position.x = state.position.x();
  message.pose.pose.position.y = state.position.y();
  message.pose.pose.position.z = state.position.z();
  message.pose.pose.orientation = quaternionOf(state.yaw);
  message.twist.twist.linear.x = state.velocity.surge;
  message.twist.twist.linear.y = state.velocity.sway;
  message.twist.twist.linear.z = state.velocity.heave;
  message.twist.twist.angular.z = state.velocity.yaw_rate;
  return message;
}

geometry_msgs::TransformStamped transformOf(const nav_msgs::Odometry& odometry) {
  geometry_msgs::TransformStamped transform;
  transform.header = odometry.header;
  transform.child_frame_id = odometry.child_frame_id;
  transform.transform.translation.x = odometry.pose.pose.position.x;
  transform.transform.translation.y = odometry.pose.pose.position.y;
  transform.transform.translation.z = odometry.pose.pose.position.z;
  transform.transform.rotation = odometry.pose.pose.orientation;
  return transform;
}

// Not a static transform: a listener that clears its buffer as time jumps back would not get that
// again.
geometry_msgs::TransformStamped identity(const SimulatorOptions& options, const ros::Time& stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = options.map_frame;
  transform.child_frame_id = options.odom_frame;
  transform.transform.rotation.w = 1.0;
  return transform;
}

}  // namespace

SimulatorNode::SimulatorNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh)
    : nh_(nh),
      options_(loadOptions(private_nh)),
      vehicle_(std::make_unique<Vehicle>(options_.vehicle, initialState(options_))) {
  odometry_publisher_ = nh_.advertise<nav_msgs::Odometry>("odom", 10);
  contacts_publisher_ = nh_.advertise<std_msgs::UInt32>("contacts", 1, true);
  if (options_.publish_clock) clock_publisher_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  command_subscriber_ = nh_.subscribe("cmd_vel", 10, &SimulatorNode::onCommand, this);
  map_subscriber_ = nh_.subscribe("projected_map", 1, &SimulatorNode::onMap, this);
  reconfigurable_ = std::make_unique<Reconfigurable<SimulatorConfig, SimulatorOptions>>(
      private_nh, options_, [this](const SimulatorOptions& options) { use(options); });
  startTimer();
}

SimulatorNode::~SimulatorNode() {
  timer_.stop();
}

void SimulatorNode::use(const SimulatorOptions& options) {
  checkSimulatorOptions(options);
  if (options.publish_clock != options_.publish_clock || options.start_time != options_.start_time)
    throw InputError("publish_clock and start_time cannot be changed while the simulator runs");
  vehicle_->setOptions(options.vehicle);
  if (!sameStart(options, options_)) vehicle_->reset(initialState(options));
  const bool other_rate = options.update_rate != options_.update_rate;
  options_ = options;
  if (other_rate) startTimer();
}

void SimulatorNode::startTimer() {
  last_tick_ = ros::SteadyTime::now();
  timer_ = nh_.createSteadyTimer(ros::WallDuration(1.0 / options_.update_rate),
                                 &SimulatorNode::onTimer, this);
}

void SimulatorNode::onCommand(const geometry_msgs::Twist& message) {
  try {
    vehicle_->command({message.linear.x, message.linear.y, message.linear.z, message.angular.z});
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("cmd_vel refused: " << error.what());
  }
}

void SimulatorNode::onMap(const nav_msgs::OccupancyGrid& message) {
  try {
    const std::string frame = frameName(message.header.frame_id);
    if (frame != options_.map_frame)
      throw InputError("its frame must be " + options_.map_frame + ", got '" + frame + "'");
    vehicle_->setMap(std::make_shared<OccupancyGrid>(occupancyFromMessage(message)));
    publishContacts();
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("projected_map refused, the one before stays: " << error.what());
  }
}

void SimulatorNode::onTimer(const ros::SteadyTimerEvent&) {
  const ros::SteadyTime tick = ros::SteadyTime::now();
  const double longest = std::max(kLongestDelay, 2.0 / options_.update_rate);
  owed_ += std::min((tick - last_tick_).toSec(), longest) * options_.real_time_factor;
  last_tick_ = tick;
  const double time_step = options_.vehicle.time_step;
  if (owed_ < time_step) return;
  for (; owed_ >= time_step; owed_ -= time_step) vehicle_->step();
  publishState();
  if (published_contacts_ >= 0 && published_contacts_ != vehicle_->contacts()) publishContacts();
}

ros::Time SimulatorNode::now() const {
  if (!options_.publish_clock) return ros::Time::now();
  ros::Time start(options_.start_time);
  ros::Duration passed;
  passed.fromNSec(vehicle_->timeNs());
  return start + passed;
}

void SimulatorNode::publishState() {
  const ros::Time stamp = now();
  if (stamp == last_stamp_) return;  // tf warns about repeated stamps
  last_stamp_ = stamp;
  if (options_.publish_clock) {
    rosgraph_msgs::Clock clock;
    clock.clock = stamp;
    clock_publisher_.publish(clock);
  }
  nav_msgs::Odometry odometry = odometryOf(vehicle_->state(), options_);
  odometry.header.stamp = stamp;
  odometry_publisher_.publish(odometry);
  std::vector<geometry_msgs::TransformStamped> transforms{transformOf(odometry)};
  if (options_.publish_map_to_odom) transforms.push_back(identity(options_, stamp));
  broadcaster_.sendTransform(transforms);
}

void SimulatorNode::publishContacts() {
  published_contacts_ = vehicle_->contacts();
  std_msgs::UInt32 message;
  message.data = static_cast<std::uint32_t>(published_contacts_);
  contacts_publisher_.publish(message);
  if (published_contacts_ > 0)
    ROS_WARN_STREAM("The vehicle has run into an obstacle, contacts so far: " << message.data);
}

}  // namespace grid_path_planner
