#include "ros/simulation/simulator_node.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "grid_path_planner/SimulatorConfig.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "grid_path_planner/simulation/world.h"
#include "ros/guard/ending/shutdown_flag.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/guard/outgoing/topic_changes.h"
#include "ros/guard/parameters.h"
#include "ros/guard/scheduling/guarded_timer.h"
#include "ros/messages/file_kinds.h"
#include "ros/messages/vehicle_parameters.h"
#include "ros/messages/velocity_message.h"
#include "ros/simulation/transform_message.h"
#include "simulation/camera/pinhole.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::sameOptions;
using grid::OccupancyGrid;
using simulation::readSensorFaults;
using simulation::readWorld;
using simulation::SensorFault;
using simulation::Vehicle;
using simulation::VehicleState;
using simulation::World;

namespace {

// Wall time after a command that simulated time waits for the next one before it ends.
constexpr double kLongestWait = 0.2;  // s

VehicleState initialState(const SimulatorOptions& o) {
  return {Eigen::Vector3d(o.initial.x, o.initial.y, o.initial.z), o.initial.yaw, {}};
}

// A vehicle that starts where it cannot drive is told before somebody wonders why it does not.
void warnOfStart(const OccupancyGrid& map, const VehicleState& state, const SimulatorOptions& o) {
  const Eigen::Vector2d at = state.position.head<2>();
  const auto cell = map.geometry().cellAt(at);
  if (cell && map[*cell] < o.vehicle.occupied_min) return;
  ROS_WARN_STREAM("The vehicle starts at ("
                  << at.x() << ", " << at.y() << "), "
                  << (cell ? "in an occupied cell" : "outside the map")
                  << ": initial_x and initial_y (x and y of map_demo.launch) put it elsewhere");
}

VehicleFrameNames frameNames(const SimulatorOptions& o) {
  return {o.map_frame, o.odom_frame, o.base_frame, o.publish_map_to_odom, o.publish_odom_to_base};
}

CameraFrameNames cameraFrameNames(const SimulatorOptions& o) {
  return {o.base_frame, o.camera_frame, o.camera_optical_frame};
}

std::vector<geometry_msgs::TransformStamped> fixedTransforms(const SimulatorOptions& o) {
  auto transforms = cameraTransforms(o.camera, cameraFrameNames(o));
  const auto sensors = sensorTransforms(o.sensors, o.base_frame, o.sensor_frames);
  transforms.insert(transforms.end(), sensors.begin(), sensors.end());
  if (o.image_camera.enabled)
    transforms.push_back(transformOf(o.base_frame, o.sensor_frames.image_camera,
                                     o.image_camera.mounting.pose() * simulation::opticalFrame()));
  return transforms;
}

SimulatorOptions loadOptions(const ros::NodeHandle& private_nh, const NodeFiles& files) {
  SimulatorOptions options;
  loadParameters(private_nh, options);
  if (const auto vehicle = loadVehicle(private_nh)) takeFromVehicle(options, *vehicle);
  options.world = files.named("world", options.world);
  options.sensor_faults = files.named("sensor_faults", options.sensor_faults);
  checkSimulatorOptions(options);
  warnUnknownParameters(private_nh, withVehicleNames(optionNames<SimulatorOptions>()));
  return options;
}

std::shared_ptr<const World> loadWorld(const SimulatorOptions& options, const NodeFiles& files) {
  if (options.world.empty()) return nullptr;
  const ShutdownFlag end;
  return std::make_shared<const World>(
      files.read("world", options.world, worldFiles(), [&](const std::string& file) {
        return readWorld(file, {options.reading, end.token()});
      }));
}

std::vector<SensorFault> loadFaults(const SimulatorOptions& options, const NodeFiles& files) {
  if (options.sensor_faults.empty()) return {};
  return files.read(
      "sensor_faults", options.sensor_faults, sensorFaultFiles(),
      [&](const std::string& file) { return readSensorFaults(file, options.reading); });
}

}  // namespace

SimulatorNode::SimulatorNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                             const NodeFiles& files)
    : nh_(nh),
      options_(loadOptions(private_nh, files)),
      vehicle_(std::make_unique<Vehicle>(options_.vehicle, initialState(options_))),
      odometry_(options_.odometry),
      clock_(nh, options_),
      vehicle_publisher_(nh),
      contact_publisher_(nh),
      world_(loadWorld(options_, files)),
      faults_(loadFaults(options_, files)),
      sensor_publisher_(nh, options_.sensors, world_, faults_) {
  odometry_.reset(vehicle_->state());
  if (world_) {
    vehicle_->setWorld(world_);
    contact_publisher_.start(*vehicle_);
  }
  updateCamera(options_);
  startTimer();
  listen(private_nh);
}

// Last: what comes, comes in another thread while the constructor of a nodelet runs.
void SimulatorNode::listen(ros::NodeHandle& private_nh) {
  if (options_.world.empty())
    map_subscriber_ = subscribeChecked<nav_msgs::OccupancyGrid, const MapEvent&>(
        nh_, "projected_map", 1, [this](const MapEvent& event) { onMap(event); });
  command_subscriber_ = subscribeChecked<geometry_msgs::Twist>(
      nh_, "cmd_vel", 10, [this](const geometry_msgs::Twist& message) { onCommand(message); });
  reconfigurable_ = std::make_unique<Reconfigurable<SimulatorConfig, SimulatorOptions>>(
      private_nh, options_, [this](const SimulatorOptions& options) { use(options); });
}

SimulatorNode::~SimulatorNode() = default;

void SimulatorNode::use(const SimulatorOptions& options) {
  checkSimulatorOptions(options);
  if (options.publish_clock != options_.publish_clock || options.start_time != options_.start_time)
    throw InputError("publish_clock and start_time cannot be changed while the simulator runs");
  if (options.world != options_.world)
    throw InputError("world cannot be changed while the simulator runs, it is '" + options_.world +
                     "'");
  if (options.sensor_faults != options_.sensor_faults)
    throw InputError("sensor_faults cannot be changed while the simulator runs, it is '" +
                     options_.sensor_faults + "'");
  vehicle_->setOptions(options.vehicle);  // which the map may refuse, before anything has changed
  sensor_publisher_.setOptions(options.sensors);
  updateCamera(options);
  odometry_.setOptions(options.odometry);
  if (!sameOptions(options.initial, options_.initial)) resetVehicle(options);
  const bool other_rate = options.update_rate != options_.update_rate;
  options_ = options;
  if (other_rate) startTimer();
}

void SimulatorNode::updateCamera(const SimulatorOptions& options) {
  const CameraFrameNames frames = cameraFrameNames(options);
  vehicle_publisher_.setFixed(fixedTransforms(options));
  if (world_ && !(camera_ && camera_->same(options.camera, frames))) {
    const auto alone = lockTopicsOfRunningNode();
    camera_ = std::make_unique<DepthCameraPublisher>(nh_, *world_, options.camera, frames);
  }
  updateImageCamera(options.image_camera);
}

void SimulatorNode::updateImageCamera(const simulation::ImageCameraOptions& options) {
  if (image_camera_ && sameOptions(options, image_camera_->options())) return;
  const auto alone = lockTopicsOfRunningNode();
  image_camera_.reset();
  if (options.enabled)
    image_camera_ = std::make_unique<ImageCameraPublisher>(nh_, *world_, options, faults_);
}

void SimulatorNode::resetVehicle(const SimulatorOptions& options) {
  vehicle_->reset(initialState(options));
  odometry_.reset(vehicle_->state());
  sensor_publisher_.jump();
}

void SimulatorNode::startTimer() {
  clock_.start();
  timer_ = guardedTimer(nh_, 1.0 / options_.update_rate, [this] { onTimer(); });
}

void SimulatorNode::onCommand(const geometry_msgs::Twist& message) {
  try {
    vehicle_->command(velocityFromMessage(message));
    commanded_at_ = ros::SteadyTime::now();  // one that is refused is not waited for
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("cmd_vel refused: " << error.what());
  }
}

void SimulatorNode::onMap(const MapEvent& event) {
  if (isNotYet(event)) return;
  const nav_msgs::OccupancyGrid& message = *event.getConstMessage();
  try {
    const std::string frame = frameInMap(message.header.frame_id, options_.map_frame);
    if (frame != options_.map_frame)
      throw InputError("its frame must be " + options_.map_frame + ", got '" + frame + "'");
    const auto map = std::make_shared<OccupancyGrid>(occupancyFromMessage(message));
    tellTraits(event);
    vehicle_->setMap(map);
    if (!std::exchange(has_map_, true)) warnOfStart(*map, vehicle_->state(), options_);
    contact_publisher_.start(*vehicle_);
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("projected_map refused, the one before stays: " << error.what());
  }
}

void SimulatorNode::onTimer() {
  clock_.addElapsed();
  const std::int64_t before = vehicle_->timeNs();
  for (; clock_.isStepDue() && !mustWaitForCamera() && !mustWaitForCommand(); clock_.takeStep())
    step();
  // What was waited for is not made up for: it would be many steps without an odometry between them.
  if (mustWaitForCommand()) clock_.dropSteps();
  if (vehicle_->timeNs() == before) return;
  publishState();
  contact_publisher_.update(*vehicle_);
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
  const std::int64_t time = vehicle_->timeNs();
  if (camera_ && camera_->due(time)) camera_->capture(vehicle_->state(), time, publishState());
  if (image_camera_ && image_camera_->wants(time))
    image_camera_->capture(vehicle_->state(), time,
                           {options_.sensor_frames.image_camera, publishState()});
  vehicle_->step();
  odometry_.advance(vehicle_->state());
  sensor_publisher_.advance(vehicle_->state(), vehicle_->timeNs());
}

// Nothing measured is stamped ahead of time: /clock goes before it. tf warns about repeated stamps.
ros::Time SimulatorNode::publishState() {
  const ros::Time stamp = clock_.now(vehicle_->timeNs());
  if (!clock_.publish(stamp)) {
    sensor_publisher_.dropOld(stamp);
    return stamp;
  }
  vehicle_publisher_.publish(vehicle_->state(), odometry_.measured(), stamp, frameNames(options_));
  sensor_publisher_.publish(
      options_.sensor_frames, options_.map_frame,
      [this](std::int64_t time_ns) { return clock_.stampOf(time_ns, vehicle_->timeNs()); });
  return stamp;
}

}  // namespace grid_path_planner::nodes
