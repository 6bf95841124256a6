#include "ros/avoidance/local_planner_node.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "grid_path_planner/LocalPlannerConfig.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/common/file_kinds.h"
#include "ros/common/incoming/claimed_lengths.h"
#include "ros/common/master/system_state.h"
#include "ros/common/parameters.h"

namespace grid_path_planner::nodes {

using avoidance::PilotAnswer;
using avoidance::PilotInput;
using avoidance::PilotStatus;
using base::BodyVelocity;
using base::InputError;
using diagnostic_msgs::DiagnosticStatus;

namespace {

constexpr std::size_t kMostClouds = 64 << 20;  // bytes that wait
constexpr double kManualTime = 2.5;            // s, wall time, that a joystick's word holds
constexpr double kOdometryAge = 0.5;           // s
constexpr double kDiagnosed = 1.0;             // s, wall time

LocalPlannerOptions loadLocalPlannerOptions(const ros::NodeHandle& private_nh,
                                            const NodeFiles& files) {
  LocalPlannerOptions options;
  loadParameters(private_nh, options);
  options.config_filename = files.named("config_filename", options.config_filename);
  checkLocalPlannerOptions(options);
  warnUnknownParameters(private_nh, optionNames<LocalPlannerOptions>());
  return options;
}

Commands commandsOf(const ros::NodeHandle& nh, const LocalPlannerOptions& options) {
  Commands commands;
  if (!options.share_cmd_vel) commands.topics = {nh.resolveName("cmd_vel")};
  commands.manual_control = nh.resolveName("manual_control");
  refuseOtherCommander(commands);
  return commands;
}

std::vector<Eigen::Vector3d> positionsOf(const path::Path& path) {
  std::vector<Eigen::Vector3d> points;
  for (const path::Pose& pose : path.poses) points.push_back(pose.position);
  return points;
}

std::vector<Eigen::Vector3d> waypointsOf(const LocalPlannerOptions& options,
                                         const NodeFiles& files) {
  const auto read = [](const std::string& file) { return path::readWaypointFile(file); };
  return positionsOf(
      files.read("config_filename", options.config_filename, waypointFiles(), read).path);
}

}  // namespace

LocalPlannerNode::LocalPlannerNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                                   const NodeFiles& files)
    : nh_(nh),
      options_(loadLocalPlannerOptions(private_nh, files)),
      transforms_(nh),
      pilot_(options_.pilot),
      publisher_((commandsOf(nh_, options_), nh_)),
      diagnostics_(nh, private_nh, private_nh.getNamespace()) {
  refuseSimultaneousCommander(commandsOf(nh_, options_));
  if (!options_.config_filename.empty()) fly(waypointsOf(options_, files), false);
  subscribe();
  offerServices(private_nh);
  reconfigurable_ = std::make_unique<Reconfigurable<LocalPlannerConfig, LocalPlannerOptions>>(
      private_nh, options_, [this](const LocalPlannerOptions& options) { use(options); });
  startTimer();
  startDiagnostics();
}

LocalPlannerNode::~LocalPlannerNode() {
  control_timer_.stop();
  diagnostics_timer_.stop();
  cloud_subscription_->shutdown();
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
  for (ros::ServiceServer& service : services_) service.shutdown();
  reconfigurable_.reset();
  if (!flies_) return;
  publisher_.command({}, yaw_, options_.map_frame, ros::Time::now());
  if (publisher_.anyListener())
    ros::WallDuration(0.1).sleep();  // roscpp sends in a thread of its own and says not when it has
}

void LocalPlannerNode::subscribe() {
  using CloudEvent = ros::MessageEvent<const sensor_msgs::PointCloud2>;
  cloud_subscription_ = std::make_unique<BoundedSubscription<sensor_msgs::PointCloud2>>(
      nh_, "points", kMostClouds,
      [this](const CloudEvent& event) { clouds_.add(event.getMessage()); });
  subscribers_ = {
      subscribeChecked<sensor_msgs::CameraInfo>(
          nh_, "camera_info", 1,
          [this](const sensor_msgs::CameraInfo& camera) { clouds_.setCamera(camera); }),
      subscribeChecked<nav_msgs::Odometry>(
          nh_, "odom", 1, [this](const nav_msgs::Odometry& odometry) { odometry_ = odometry; }),
      subscribeChecked<geometry_msgs::PoseStamped>(
          nh_, "goal", 1, [this](const geometry_msgs::PoseStamped& goal) { onGoal(goal); }),
      subscribeChecked<nav_msgs::Path>(nh_, "path", 1,
                                       [this](const nav_msgs::Path& path) { onPath(path); }),
      subscribeChecked<std_msgs::Bool>(
          nh_, "stop", 1, [this](const std_msgs::Bool& stop) { stopped_ = stop.data; }),
      subscribeChecked<std_msgs::Bool>(nh_, "manual_control", 1, [this](const std_msgs::Bool& is) {
        manual_until_ = ros::SteadyTime::now() + ros::WallDuration(is.data ? kManualTime : 0.0);
      })};
}

void LocalPlannerNode::offerServices(ros::NodeHandle& private_nh) {
  using Request = std_srvs::Trigger::Request;
  using Response = std_srvs::Trigger::Response;
  const auto offer = [&](const char* name, std::function<std::string()> act) {
    services_.push_back(private_nh.advertiseService<Request, Response>(
        name, [this, act](Request&, Response& response) {
          response.message = act();
          response.success = flies_ || !response.message.empty();
          return true;
        }));
  };
  offer("pause", [this] {
    paused_ = true;
    return std::string("paused until ~resume");
  });
  offer("resume", [this] {
    paused_ = false;
    return std::string("resumed");
  });
  offer("cancel", [this] {
    if (flies_) pilot_.cancel("asked for by ~cancel");
    return std::string(flies_ ? "cancelled" : "nothing was flown");
  });
  offer("explain", [this] { return pilot_.explain(); });
}

void LocalPlannerNode::use(const LocalPlannerOptions& options) {
  checkLocalPlannerOptions(options);
  if (options.config_filename != options_.config_filename ||
      options.share_cmd_vel != options_.share_cmd_vel || options.map_frame != options_.map_frame)
    throw InputError(
        "config_filename, share_cmd_vel and map_frame cannot be changed while the node runs");
  pilot_.setOptions(options.pilot);
  const bool other_rate = options.control_rate != options_.control_rate;
  options_ = options;
  if (other_rate) startTimer();
}

void LocalPlannerNode::startTimer() {
  control_timer_ = nh_.createSteadyTimer(ros::WallDuration(1.0 / options_.control_rate),
                                         [this](const ros::SteadyTimerEvent&) { control(); });
}

void LocalPlannerNode::startDiagnostics() {
  diagnostics_.setHardwareID("none");
  diagnostics_.add("flight", this, &LocalPlannerNode::diagnose);
  // force_update: the updater's own clock is ROS time, which may jump back.
  diagnostics_timer_ =
      nh_.createSteadyTimer(ros::WallDuration(kDiagnosed),
                            [this](const ros::SteadyTimerEvent&) { diagnostics_.force_update(); });
}

void LocalPlannerNode::onGoal(const geometry_msgs::PoseStamped& goal) {
  nav_msgs::Path message;
  message.header = goal.header;
  message.poses = {goal};
  try {
    const auto path = transforms_.pathIn(message, options_.base_frame);
    fly(transforms_.pointsIn(options_.map_frame, goal.header.frame_id, positionsOf(path)), false);
  } catch (const std::runtime_error& error) {
    ROS_ERROR_STREAM("The goal is refused: " << error.what());
  }
}

void LocalPlannerNode::onPath(const nav_msgs::Path& message) {
  if (message.poses.empty()) {
    if (flies_) pilot_.cancel("the path is empty: none was found");
    return;
  }
  try {
    const auto path = transforms_.pathIn(message, options_.base_frame);
    fly(transforms_.pointsIn(options_.map_frame, message.header.frame_id, positionsOf(path)), true);
  } catch (const std::runtime_error& error) {
    ROS_ERROR_STREAM("The path is refused: " << error.what());
  }
}

void LocalPlannerNode::fly(std::vector<Eigen::Vector3d> points, bool along) {
  if (along)
    pilot_.setPath(points);
  else
    pilot_.setRoute(points);
  flies_ = true;
}

bool LocalPlannerNode::isHeld() const {
  return paused_ || stopped_ || ros::SteadyTime::now() < manual_until_;
}

// As measured; without odometry that commanded last.
BodyVelocity LocalPlannerNode::velocityAt(const ros::Time& now) const {
  if (!odometry_ || std::abs(secondsBetween(odometry_->header.stamp, now)) >= kOdometryAge)
    return answer_.velocity;
  const geometry_msgs::Twist& twist = odometry_->twist.twist;
  return {twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.z};
}

PilotInput LocalPlannerNode::input(const ros::Time& now) {
  PilotInput input;
  input.time = now.toSec();
  try {
    const path::Pose pose =
        transforms_.recentPoseOf(options_.base_frame, options_.map_frame, now, options_.tf_timeout);
    input.pose = avoidance::VehiclePose{pose.position, pose.yaw};
    yaw_ = pose.yaw;
  } catch (const TransformError& error) {
    input.pose_problem = error.what();
  }
  input.velocity = velocityAt(now);
  frame_ = clouds_.next(transforms_, options_.map_frame, now);
  if (frame_) input.frame = &*frame_;
  return input;
}

void LocalPlannerNode::control() {
  if (!clock_.hasTime()) return;
  const ros::Time now = ros::Time::now();
  if (const auto back = clock_.jumpedBack(now)) {
    ROS_WARN_STREAM("ROS time went back by "
                    << *back << " s: the flight is cancelled, and what was seen is forgotten");
    clouds_.clear();
    odometry_.reset();
  }
  if (isHeld())
    pilot_.pause();
  else
    pilot_.resume();
  answer_ = pilot_.update(input(now));
  publish(answer_, now);
}

void LocalPlannerNode::publish(const PilotAnswer& answer, const ros::Time& now) {
  publisher_.status(answer, options_.map_frame, now);
  if (answer.new_path) publisher_.path(pilot_, options_.map_frame, now);
  if (frame_) publisher_.surroundings(pilot_, options_.map_frame, yaw_, options_.base_frame, now);
  const bool joystick = ros::SteadyTime::now() < manual_until_ && !stopped_;
  if ((flies_ || stopped_) && !joystick)
    publisher_.command(stopped_ ? BodyVelocity{} : answer.velocity, yaw_, options_.map_frame, now);
  const bool ended = answer.status == PilotStatus::ARRIVED || answer.status == PilotStatus::STUCK ||
                     answer.status == PilotStatus::CANCELLED;
  if (flies_ && ended) {
    ROS_INFO_STREAM(toString(answer.status) << ": " << answer.sentence);
    flies_ = false;
  }
}

void LocalPlannerNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const bool well = answer_.status == PilotStatus::IDLE || answer_.status == PilotStatus::FLYING ||
                    answer_.status == PilotStatus::ARRIVED ||
                    answer_.status == PilotStatus::CANCELLED;
  status.summary(well ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                 std::string(toString(answer_.status)) + ": " + answer_.sentence);
  status.add("newest cloud (s old)", answer_.frame_age);
  status.add("nearest point (m)", answer_.clearance);
  status.add("open path (m)", answer_.clear_path);
  status.add("problem of the newest cloud", clouds_.problem());
}

}  // namespace grid_path_planner::nodes
