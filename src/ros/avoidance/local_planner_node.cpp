#include "ros/avoidance/local_planner_node.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "grid_path_planner/LocalPlannerConfig.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
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
constexpr double kOdometryAge = 0.5;           // s
constexpr double kDiagnosed = 1.0;             // s, wall time

// "/map" is "map".
void nameFrames(LocalPlannerOptions& options) {
  options.map_frame = frameName(options.map_frame);
  options.base_frame = frameName(options.base_frame);
}

LocalPlannerOptions loadLocalPlannerOptions(const ros::NodeHandle& private_nh,
                                            const NodeFiles& files) {
  LocalPlannerOptions options;
  loadParameters(private_nh, options);
  options.config_filename = files.named("config_filename", options.config_filename);
  nameFrames(options);
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

// Where the vehicle is now that was there so long ago.
avoidance::VehiclePose carriedOn(const FrameTransforms::RecentPose& recent,
                                 const BodyVelocity& velocity) {
  const double age = std::max(0.0, recent.age);
  const double turn = age * velocity.yaw_rate;
  return {recent.pose.position + age * base::inMap(velocity, recent.pose.yaw + 0.5 * turn),
          recent.pose.yaw + turn};
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
          nh_, "stop", 1, [this](const std_msgs::Bool& stop) { hold_.stop(stop.data); }),
      subscribeChecked<std_msgs::Bool>(
          nh_, "manual_control", 1, [this](const std_msgs::Bool& is) { hold_.manual(is.data); })};
}

void LocalPlannerNode::offerServices(ros::NodeHandle& private_nh) {
  using Request = std_srvs::Trigger::Request;
  using Response = std_srvs::Trigger::Response;
  using Answer = FlightHold::Answer;
  const auto offer = [&](const char* name, std::function<Answer()> act) {
    services_.push_back(
        private_nh.advertiseService<Request, Response>(name, [act](Request&, Response& response) {
          const Answer answer = act();
          response.success = answer.done;
          response.message = answer.message;
          return true;
        }));
  };
  offer("pause", [this] { return hold_.pause(flies_); });
  offer("resume", [this] { return hold_.resume(flies_); });
  offer("cancel", [this] {
    if (!flies_) return Answer{false, "nothing to cancel: nothing is flown"};
    pilot_.cancel("asked for by ~cancel");
    return Answer{true, "cancelled"};
  });
  offer("explain", [this] { return Answer{true, pilot_.explain()}; });
}

void LocalPlannerNode::use(LocalPlannerOptions options) {
  nameFrames(options);
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

// The first time, and time that jumped back: only then is it known what is from before.
bool LocalPlannerNode::noticeTime() {
  if (!clock_.hasTime()) return false;
  const ros::Time now = ros::Time::now();
  const auto back = clock_.jumpedBack(now);
  if (started_.isZero() || back) started_ = now;
  if (!back) return true;
  ROS_WARN_STREAM("ROS time went back by "
                  << *back << " s: the flight is cancelled, and what was seen is forgotten");
  transforms_.clear();
  clouds_.clear();
  odometry_.reset();
  tick(now);  // a goal that comes now is of this time
  return true;
}

// A publisher that latches sends what it published before this node was started, or restarted.
bool LocalPlannerNode::isFromBefore(const char* what, const ros::Time& stamp) {
  if (noticeTime() && stamp >= started_) return false;
  ROS_WARN_STREAM(what << " stamped " << stamp << " is not flown: local_planner started at "
                       << started_);
  return true;
}

void LocalPlannerNode::onGoal(const geometry_msgs::PoseStamped& goal) {
  if (!goal.header.stamp.isZero() && isFromBefore("A goal", goal.header.stamp)) return;
  nav_msgs::Path message;
  message.header = goal.header;
  message.poses = {goal};
  try {
    const auto path = transforms_.pathIn(message, options_.base_frame);
    fly(transforms_.pointsIn(options_.map_frame, path.frame_id, positionsOf(path)), false);
  } catch (const std::runtime_error& error) {
    ROS_ERROR_STREAM("The goal is refused: " << error.what());
  }
}

void LocalPlannerNode::onPath(const nav_msgs::Path& message) {
  if (message.poses.empty()) {
    if (flies_) pilot_.cancel("the path is empty: none was found");
    return;
  }
  if (isFromBefore("A path", message.header.stamp)) return;
  try {
    const auto path = transforms_.pathIn(message, options_.base_frame);
    fly(transforms_.pointsIn(options_.map_frame, path.frame_id, positionsOf(path)), true);
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
  input.velocity = velocityAt(now);
  try {
    const auto recent =
        transforms_.recentPoseOf(options_.base_frame, options_.map_frame, now, options_.tf_timeout);
    input.pose = carriedOn(recent, input.velocity);
    yaw_ = input.pose->yaw;
  } catch (const TransformError& error) {
    input.pose_problem = error.what();
  }
  input.hold = hold_.why(options_.master_timeout);
  frame_ = clouds_.next(transforms_, options_.map_frame, now);
  if (frame_) input.frame = &*frame_;
  return input;
}

void LocalPlannerNode::control() {
  if (noticeTime()) tick(ros::Time::now());
}

void LocalPlannerNode::tick(const ros::Time& now) {
  if (hold_.notice(now, flies_))
    ROS_WARN("The joystick commands: the flight is paused until ~resume");
  answer_ = pilot_.update(input(now));
  publish(answer_, now);
}

void LocalPlannerNode::publish(const PilotAnswer& answer, const ros::Time& now) {
  publisher_.status(answer, options_.map_frame, now);
  if (answer.new_path) publisher_.path(pilot_, options_.map_frame, now);
  if (frame_) publisher_.surroundings(pilot_, options_.map_frame, yaw_, options_.base_frame, now);
  if (hold_.stopped() || (flies_ && !hold_.isManual()))
    publisher_.command(answer.velocity, yaw_, options_.map_frame, now);
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
