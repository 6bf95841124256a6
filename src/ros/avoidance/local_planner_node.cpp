#include "ros/avoidance/local_planner_node.h"

#include <ros/callback_queue_interface.h>
#include <ros/console.h>
#include <std_msgs/Empty.h>

#include <algorithm>
#include <utility>

#include "grid_path_planner/LocalPlannerConfig.h"
#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/guarded_queue.h"
#include "ros/guard/incoming/advertised_service.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/guard/parameters.h"
#include "ros/guard/scheduling/guarded_timer.h"
#include "ros/messages/file_kinds.h"
#include "ros/messages/velocity_message.h"
#include "ros/messages/waypoint_reading.h"

namespace grid_path_planner::nodes {

using avoidance::PilotAnswer;
using avoidance::PilotInput;
using avoidance::PilotStatus;
using base::BodyVelocity;
using base::InputError;

namespace {

constexpr double kOdometryAge = 0.5;  // s

LocalPlannerOptions loadLocalPlannerOptions(const ros::NodeHandle& private_nh,
                                            const NodeFiles& files) {
  LocalPlannerOptions options;
  loadParameters(private_nh, options);
  options.config_filename = files.named("config_filename", options.config_filename);
  nameFrames(options);
  options.log = files.named("log", options.log);
  checkLocalPlannerOptions(options);
  warnUnknownParameters(private_nh, optionNames<LocalPlannerOptions>());
  return options;
}

Commands commandsOf(const ros::NodeHandle& nh, const LocalPlannerOptions& options) {
  Commands commands;
  if (!options.share_cmd_vel) commands.topics = {nh.resolveName("cmd_vel")};
  commands.actions = {nh.resolveName("navigate_path")};
  commands.manual_control = nh.resolveName("manual_control");
  return commands;
}

// Where the vehicle is now that was there so long ago.
avoidance::VehiclePose carriedOn(const Placed& placed, const BodyVelocity& velocity) {
  const path::Pose then = placed.level();
  const double age = std::max(0.0, placed.age);
  const double turn = age * velocity.yaw_rate;
  return {then.position + age * base::inMap(velocity, then.yaw + 0.5 * turn), then.yaw + turn};
}

std::vector<Eigen::Vector3d> positionsOf(const path::Path& path) {
  std::vector<Eigen::Vector3d> points;
  for (const path::Pose& pose : path.poses) points.push_back(pose.position);
  return points;
}

}  // namespace

LocalPlannerNode::LocalPlannerNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                                   const NodeFiles& files)
    : nh_(nh),
      options_(loadLocalPlannerOptions(private_nh, files)),
      commands_(private_nh.getNamespace(), commandsOf(nh_, options_)),
      transforms_(nh),
      pilot_(options_.pilot),
      clouds_(nh_, options_, transforms_),
      publisher_(nh_),
      views_(nh_),
      commander_(nh_, options_, [this](unsigned handovers) { noteHandover(handovers); }),
      diagnostics_(nh, private_nh, private_nh.getNamespace()) {
  action_ = std::make_unique<FlightAction>(nh_, files, actionCallbacks());
  commands_.refuseSimultaneous();
  startLog(files);
  if (MapPlanner::isBuilt())
    pilot_.setMapPlan([this](const auto& from, const auto& goal) { return map_.plan(from, goal); });
  else
    ROS_INFO("Built without the component mapping: there is no map to plan on without progress");
  if (!options_.config_filename.empty()) flyFile(files);
  subscribe();
  offerServices(private_nh);
  reconfigurable_ = std::make_unique<Reconfigurable<LocalPlannerConfig, LocalPlannerOptions>>(
      private_nh, options_, [this](const LocalPlannerOptions& options) { use(options); });
  on_jump_back_ = NodeTime::of(nh_).onJumpBack([this](double seconds) { timeWentBack(seconds); });
  startTimer();
  startDiagnostics();
}

// Without tf yet, by which those of another frame could be laid into the map.
void LocalPlannerNode::flyFile(const NodeFiles& files) {
  const path::Path waypoints = readWaypoints(files, options_.config_filename);
  if (waypoints.frame_id != options_.map_frame)
    throw InputError(options_.config_filename, "its waypoints are in frame '" + waypoints.frame_id +
                                                   "', map_frame is '" + options_.map_frame + "'");
  fly(waypoints, false, handovers_);
}

LocalPlannerNode::~LocalPlannerNode() {
  on_jump_back_.reset();
  control_timer_.stop();
  diagnostics_timer_.stop();
  stop();
  // No handover is noted any more, and what waits for the action does not outlive it.
  nh_.getCallbackQueue()->removeByID(reinterpret_cast<std::uint64_t>(this));
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
  for (ros::ServiceServer& service : services_) service.shutdown();
  reconfigurable_.reset();
  action_.reset();
}

void LocalPlannerNode::startLog(const NodeFiles& files) {
  if (options_.log.empty()) return;
  pilot_.logTo(files.toWrite("log", options_.log, flightLogs()), options_.log_limit);
  ROS_INFO_STREAM("What the pilot is given and answers is written to " << options_.log);
}

FlightAction::Callbacks LocalPlannerNode::actionCallbacks() {
  return {[this](const path::Path& path, bool along, unsigned handovers) {
            const path::Path flown = transforms_.place(path, placingInMap());
            fly(flown, along, handovers);
            finished_goals_.endAllUntil(ros::Time::now());
            return flown;
          },
          [this] { return handovers_; },
          [this](const std::string& reason) {
            endGoalsUntilNow();
            if (flies_) pilot_.cancel(reason);
          },
          [this](const nav_msgs::Path& path) { return transforms_.place(path, placingInMap()); }};
}

// Whoever took the vehicle that stood still does not find it flying off when he lets it go. What waits in the queue was
// given before that.
void LocalPlannerNode::noteHandover(unsigned handovers) {
  const auto note = [this, handovers] {
    handovers_ = std::max(handovers_, handovers);
    endGoalsUntilNow();
    action_->cancelReading(kTakenOver);
  };
  nh_.getCallbackQueue()->addCallback(callbackOf(note), reinterpret_cast<std::uint64_t>(this));
}

void LocalPlannerNode::endGoalsUntilNow() {
  finished_goals_.endAllUntil(ros::Time::now());
}

void LocalPlannerNode::subscribe() {
  subscribers_ = {
      subscribeChecked<nav_msgs::Odometry>(
          nh_, "odom", 1, [this](const nav_msgs::Odometry& odometry) { odometry_ = odometry; }),
      subscribeChecked<geometry_msgs::PoseStamped>(
          nh_, "goal", 1, [this](const geometry_msgs::PoseStamped& goal) { onGoal(goal); }),
      subscribeChecked<nav_msgs::Path>(nh_, "path", 1,
                                       [this](const nav_msgs::Path& path) { onPath(path); })};
}

void LocalPlannerNode::offerServices(ros::NodeHandle& private_nh) {
  using Answer = FlightHold::Answer;
  cancelled_publisher_ = nh_.advertise<std_msgs::Empty>("drive_cancelled", 1);
  const auto offer = [&](const char* name, std::function<Answer()> act) {
    services_.push_back(
        advertiseService<std_srvs::Trigger>(private_nh, name, [act](auto&, auto& response) {
          const Answer answer = act();
          response.success = answer.done;
          response.message = answer.message;
          return true;
        }));
  };
  offer("pause", [this] { return commander_.pause(hasFlight()); });
  offer("resume", [this] { return commander_.resume(hasFlight()); });
  offer("cancel", [this] { return cancelByHand(); });
  offer("explain", [this] { return Answer{true, pilot_.pilot().explain()}; });
}

// Whoever plans for this flight, or is about to send another, hears of it too.
FlightHold::Answer LocalPlannerNode::cancelByHand() {
  cancelled_publisher_.publish(std_msgs::Empty());
  endGoalsUntilNow();
  const bool was_read = action_->cancelReading("cancelled by ~cancel while its file was read");
  if (flies_) pilot_.cancel("asked for by ~cancel");
  const bool was_paused =
      commander_.endPause();  // last: what was not cancelled, for want of memory, stays paused
  if (flies_) return {true, "cancelled"};
  if (was_read) return {true, "cancelled while its file was read"};
  if (was_paused) return {true, "nothing is flown, and the next flight does not wait any more"};
  return {false, "nothing to cancel: nothing is flown"};
}

void LocalPlannerNode::use(LocalPlannerOptions options) {
  nameFrames(options);
  checkLocalPlannerOptions(options);
  if (options.config_filename != options_.config_filename ||
      options.share_cmd_vel != options_.share_cmd_vel || options.map_frame != options_.map_frame ||
      options.log != options_.log || options.log_limit != options_.log_limit ||
      options.cloud_topics != options_.cloud_topics)
    throw InputError(
        "config_filename, share_cmd_vel, map_frame, log, log_limit and cloud_topics cannot be "
        "changed while the node runs");
  pilot_.setOptions(options.pilot);
  commander_.setOptions(options);
  clouds_.setOptions(options);
  const bool other_rate = options.control_rate != options_.control_rate;
  options_ = options;
  if (other_rate) startTimer();
}

void LocalPlannerNode::startTimer() {
  control_timer_ = guardedTimer(nh_, 1.0 / options_.control_rate, [this] { control(); });
}

bool LocalPlannerNode::hasTime() {
  if (!NodeTime::isThere()) return false;
  if (!std::exchange(had_time_, true)) endGoalsUntilNow();  // of one that was there before
  return true;
}

void LocalPlannerNode::timeWentBack(double seconds) {
  ROS_WARN_STREAM("ROS time went back by "
                  << seconds << " s: the flight is cancelled, and what was seen is forgotten");
  if (flies_) pilot_.cancel("time went back by " + std::to_string(seconds) + " s");
  map_.forget();
  odometry_.reset();
  finished_goals_.timeWentBack();
  action_->cancelReading("ROS time went back");
  tick(ros::Time::now());  // a goal that comes now is of this time
}

// A publisher that latches sends what it published before this node was started, or restarted, or in a time that ROS
// time went back from.
bool LocalPlannerNode::isOfAnotherTime(const char* what, const ros::Time& stamp) {
  hasTime();  // or goals from before are not known to be over
  const auto problem = NodeTime::of(nh_).problemWith(stamp);
  if (problem) ROS_WARN_STREAM(what << " stamped " << stamp << " is not flown: " << *problem);
  return problem.has_value();
}

void LocalPlannerNode::onGoal(const geometry_msgs::PoseStamped& goal) {
  if (action_->isActive()) {
    ROS_WARN("A goal is not flown to: a goal of the action navigate_path is");
    return;
  }
  if (!goal.header.stamp.isZero() && isOfAnotherTime("A goal", goal.header.stamp)) return;
  try {
    path::Path route{options_.map_frame, {transforms_.place(goal, placingInMap())}};
    path::lookAlongPath(route);
    fly(route, false, handovers_);
  } catch (const std::runtime_error& error) {
    ROS_ERROR_STREAM("The goal is refused: " << error.what());
  }
}

void LocalPlannerNode::onPath(const nav_msgs::Path& message) {
  if (action_->isActive()) {
    ROS_WARN("A path is not flown: a goal of the action navigate_path is");
    endGoalsUntilNow();
    return;
  }
  if (message.poses.empty()) {
    if (flies_) pilot_.cancel("the path is empty: none was found");
    return;
  }
  if (isOfAnotherTime("A path", message.header.stamp)) return;
  if (finished_goals_.isOver(message)) {
    ROS_INFO("A path is not flown: its goal was reached or cancelled; give it again");
    return;
  }
  try {
    fly(transforms_.place(message, placingInMap()), true, handovers_);
    finished_goals_.drive(message);
  } catch (const std::runtime_error& error) {
    ROS_ERROR_STREAM("The path is refused: " << error.what());
  }
}

void LocalPlannerNode::fly(const path::Path& path, bool along, unsigned handovers) {
  if (along)
    pilot_.setPath(positionsOf(path));
  else
    pilot_.setRoute(positionsOf(path));
  map_.dropPlan();
  publisher_.beginFlight();
  flies_ = true;
  if (!commander_.begin(handovers)) pilot_.cancel(kTakenOver);
}

// As measured; without odometry, or with one that is not finite, that commanded last.
BodyVelocity LocalPlannerNode::velocityAt(const ros::Time& now) const {
  const auto measured = odometry_ ? measuredVelocity(*odometry_, now, kOdometryAge) : std::nullopt;
  return measured ? *measured : commander_.gate().sent();
}

PilotInput LocalPlannerNode::input(const ros::Time& now) {
  PilotInput input;
  input.time = now.toSec();
  input.velocity = velocityAt(now);
  double pose_for = 0.0;  // s, until it is too old
  try {
    const Placed vehicle = transforms_.placeVehicle(placingInMap());
    at_ = carriedOn(vehicle, input.velocity);
    input.pose = at_;
    pose_for = options_.tf_timeout - vehicle.age;
  } catch (const TransformError& error) {
    input.pose_problem = error.what();
  }
  input.hold = commander_.hold();
  takeFrames(input);
  good_for_ = std::min(pose_for, options_.pilot.cloud_timeout - clouds_.age(now));
  return input;
}

// All but the newest are seen first.
void LocalPlannerNode::takeFrames(PilotInput& input) {
  frames_ = clouds_.take(options_.pilot);
  for (std::size_t i = 0; i + 1 < frames_.size(); ++i) pilot_.see(frames_[i]);
  if (!frames_.empty()) input.frame = &frames_.back();
  if (options_.pilot.recover)
    for (const avoidance::Frame& frame : frames_) map_.see(frame, options_.pilot);
  input.cloud_problem = clouds_.problem().value_or("");
}

void LocalPlannerNode::control() {
  if (hasTime()) tick(ros::Time::now());
}

void LocalPlannerNode::tick(const ros::Time& now) {
  const bool yields = commander_.notice(hasFlight());
  const PilotInput given = input(now);
  answer_ = pilot_.update(given);
  const bool ended = answer_.status == PilotStatus::ARRIVED ||
                     answer_.status == PilotStatus::STUCK ||
                     answer_.status == PilotStatus::CANCELLED;
  if (flies_ && answer_.status == PilotStatus::ARRIVED) finished_goals_.end();
  if (flies_)
    commander_.command({answer_.velocity, given.velocity, at_.yaw, now, good_for_, ended});
  if (yields) ROS_WARN("The joystick commands: the flight is paused until ~resume");
  if (const auto problem = pilot_.takeLogProblem()) ROS_WARN_STREAM(*problem);
  publish(now);
  if (ended && std::exchange(flies_, false))
    ROS_INFO_STREAM(toString(answer_.status) << ": " << answer_.sentence);
  action_->report(answer_, at_);
}

// Or will have it, once its file is read: a pause outlives the goal that is replaced.
bool LocalPlannerNode::hasFlight() const {
  return flies_ || action_->isActive();
}

void LocalPlannerNode::publish(const ros::Time& now) {
  const std::string &map = options_.map_frame, &base = options_.base_frame;
  publisher_.status(answer_, map, now);
  if (answer_.new_path) publisher_.path(pilot_.pilot(), map, now);
  if (!frames_.empty()) views_.show({pilot_.pilot(), answer_, at_, map, base, now});
  const CommandGate& gate = commander_.gate();
  if (gate.stopped() || (flies_ && !gate.isManual()))
    publisher_.trajectory(pilot_.pilot(), answer_, at_, map, base, now);
}

}  // namespace grid_path_planner::nodes
