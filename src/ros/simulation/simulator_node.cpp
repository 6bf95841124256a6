#include "ros/simulation/simulator_node.h"

#include <ros/console.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>

#include "grid_path_planner/SimulatorConfig.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "grid_path_planner/simulation/world.h"
#include "ros/common/end_of_node.h"
#include "ros/common/file_kinds.h"
#include "ros/common/incoming/claimed_lengths.h"
#include "ros/common/parameters.h"

namespace grid_path_planner::nodes {

using base::InputError;
using grid::OccupancyGrid;
using simulation::readWorld;
using simulation::Vehicle;
using simulation::VehicleState;
using simulation::World;

namespace {

// Wall time that a late timer catches up on; beyond it simulated time goes slower instead of
// jumping.
constexpr double kLongestDelay = 0.05;  // s

// Wall time after a command that simulated time waits for the next one before it ends.
constexpr double kLongestWait = 0.2;  // s

VehicleState initialState(const SimulatorOptions& o) {
  return {Eigen::Vector3d(o.initial_x, o.initial_y, o.initial_z), o.initial_yaw, {}};
}

bool sameStart(const SimulatorOptions& a, const SimulatorOptions& b) {
  return a.initial_x == b.initial_x && a.initial_y == b.initial_y && a.initial_z == b.initial_z &&
         a.initial_yaw == b.initial_yaw;
}

VehicleFrameNames frameNames(const SimulatorOptions& o) {
  return {o.map_frame, o.odom_frame, o.base_frame, o.publish_map_to_odom};
}

CameraFrameNames cameraFrameNames(const SimulatorOptions& o) {
  return {o.base_frame, o.camera_frame, o.camera_optical_frame};
}

SimulatorOptions loadOptions(const ros::NodeHandle& private_nh, const NodeFiles& files) {
  SimulatorOptions options;
  loadParameters(private_nh, options);
  options.world = files.named("world", options.world);
  checkSimulatorOptions(options);
  warnUnknownParameters(private_nh, optionNames<SimulatorOptions>());
  return options;
}

}  // namespace

SimulatorNode::SimulatorNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                             const NodeFiles& files)
    : nh_(nh),
      files_(files),
      options_(loadOptions(private_nh, files)),
      vehicle_(std::make_unique<Vehicle>(options_.vehicle, initialState(options_))),
      odometry_(options_.odometry),
      vehicle_publisher_(nh_),
      contact_publisher_(nh_) {
  odometry_.reset(vehicle_->state());
  if (options_.publish_clock) clock_publisher_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  if (!options_.world.empty()) loadWorld();
  updateCamera(options_);
  startTimer();
  listen(private_nh);
}

// Last: what comes, comes in another thread while the constructor of a nodelet runs.
void SimulatorNode::listen(ros::NodeHandle& private_nh) {
  if (options_.world.empty())
    map_subscriber_ = subscribeChecked<nav_msgs::OccupancyGrid>(
        nh_, "projected_map", 1, [this](const nav_msgs::OccupancyGrid& map) { onMap(map); });
  command_subscriber_ = nh_.subscribe("cmd_vel", 10, &SimulatorNode::onCommand, this);
  reconfigurable_ = std::make_unique<Reconfigurable<SimulatorConfig, SimulatorOptions>>(
      private_nh, options_, [this](const SimulatorOptions& options) { use(options); });
}

SimulatorNode::~SimulatorNode() {
  timer_.stop();
}

void SimulatorNode::loadWorld() {
  const EndOfNode end;
  const auto read = [&](const std::string& file) {
    return readWorld(file, {options_.reading, end.token()});
  };
  world_ = std::make_shared<const World>(files_.read("world", options_.world, worldFiles(), read));
  vehicle_->setWorld(world_);
  contact_publisher_.start(*vehicle_);
}

void SimulatorNode::use(const SimulatorOptions& options) {
  checkSimulatorOptions(options);
  if (options.publish_clock != options_.publish_clock || options.start_time != options_.start_time)
    throw InputError("publish_clock and start_time cannot be changed while the simulator runs");
  if (options.world != options_.world)
    throw InputError("world cannot be changed while the simulator runs, it is '" + options_.world +
                     "'");
  updateCamera(options);
  vehicle_->setOptions(options.vehicle);
  odometry_.setOptions(options.odometry);
  if (!sameStart(options, options_)) resetVehicle(options);
  const bool other_rate = options.update_rate != options_.update_rate;
  options_ = options;
  if (other_rate) startTimer();
}

void SimulatorNode::updateCamera(const SimulatorOptions& options) {
  const CameraFrameNames frames = cameraFrameNames(options);
  vehicle_publisher_.setFixed(cameraTransforms(options.camera, frames));
  if (world_ && !(camera_ && camera_->same(options.camera, frames)))
    camera_ = std::make_unique<DepthCameraPublisher>(nh_, *world_, options.camera, frames);
}

void SimulatorNode::resetVehicle(const SimulatorOptions& options) {
  vehicle_->reset(initialState(options));
  odometry_.reset(vehicle_->state());
}

void SimulatorNode::startTimer() {
  last_tick_ = ros::SteadyTime::now();
  timer_ = nh_.createSteadyTimer(ros::WallDuration(1.0 / options_.update_rate),
                                 &SimulatorNode::onTimer, this);
}

void SimulatorNode::onCommand(const geometry_msgs::Twist& message) {
  try {
    commanded_at_ = ros::SteadyTime::now();
    vehicle_->command({message.linear.x, message.linear.y, message.linear.z, message.angular.z});
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("cmd_vel refused: " << error.what());
  }
}

void SimulatorNode::onMap(const nav_msgs::OccupancyGrid& message) {
  try {
    const std::string frame = frameName(message.header.frame_id);
    if (!frame.empty() && frame != options_.map_frame)
      throw InputError("its frame must be " + options_.map_frame + ", got '" + frame + "'");
    vehicle_->setMap(std::make_shared<OccupancyGrid>(occupancyFromMessage(message)));
    contact_publisher_.start(*vehicle_);
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("projected_map refused, the one before stays: " << error.what());
  }
}

void SimulatorNode::onTimer(const ros::SteadyTimerEvent&) {
  const double time_step = options_.vehicle.time_step;
  addElapsedTime();
  const std::int64_t before = vehicle_->timeNs();
  for (; pending_time_ >= time_step && !mustWaitForCamera() && !mustWaitForCommand();
       pending_time_ -= time_step)
    step();
  // What was waited for is not made up for: it would be many steps without an odometry between them.
  if (mustWaitForCommand()) pending_time_ = std::min(pending_time_, time_step);
  if (vehicle_->timeNs() == before) return;
  publishState();
  contact_publisher_.update(*vehicle_);
}

// Adds the time since the last call, at most what a late timer may catch up on.
void SimulatorNode::addElapsedTime() {
  const ros::SteadyTime tick = ros::SteadyTime::now();
  const double most =
      std::max(kLongestDelay, 2.0 / options_.update_rate) * options_.real_time_factor;
  pending_time_ += (tick - last_tick_).toSec() * options_.real_time_factor;
  pending_time_ =
      std::min(pending_time_, most + options_.vehicle.time_step);  // at slow factors a step is more
  last_tick_ = tick;
}

// An image is due, and the one before is not finished.
bool SimulatorNode::mustWaitForCamera() const {
  return camera_ && camera_->due(vehicle_->timeNs()) && camera_->busy();
}

// The command would end with this step, though the next one may be about to come: simulated time
// runs faster than the wall clock.
bool SimulatorNode::mustWaitForCommand() const {
  return options_.real_time_factor > 1.0 && vehicle_->commandRunsOut() &&
         (ros::SteadyTime::now() - commanded_at_).toSec() < kLongestWait;
}

void SimulatorNode::step() {
  if (camera_ && camera_->due(vehicle_->timeNs())) captureImage();
  vehicle_->step();
  odometry_.advance(vehicle_->state());
}

// With tf of exactly its stamp, sent before it.
void SimulatorNode::captureImage() {
  publishState();
  camera_->capture(vehicle_->state(), vehicle_->timeNs(), now());
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
  vehicle_publisher_.publish(vehicle_->state(), odometry_.measured(), stamp, frameNames(options_));
}

}  // namespace grid_path_planner::nodes
