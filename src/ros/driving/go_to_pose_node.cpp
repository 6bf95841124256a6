#include "ros/driving/go_to_pose_node.h"

#include <ros/console.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Empty.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <utility>

#include "grid_path_planner/GoToPoseConfig.h"
#include "grid_path_planner/ros/conversions.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/driving/go_to_messages.h"
#include "ros/guard/guarded_queue.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/guard/outgoing/diagnostics_timer.h"
#include "ros/guard/outgoing/latched_message.h"
#include "ros/guard/parameters.h"
#include "ros/guard/scheduling/guarded_timer.h"

namespace grid_path_planner::nodes {

using base::InputError;
using following::Navigator;
using following::NavigatorState;
using path::Path;

namespace {

// Wall time
constexpr double kTickPeriod = 0.05;  // s
constexpr std::chrono::milliseconds kTellPeriod(200);
constexpr double kSendingTime = 0.1;  // s, in which roscpp sends what was published last

GoToPoseOptions loadGoToPoseOptions(const ros::NodeHandle& private_nh) {
  GoToPoseOptions options;
  loadParameters(private_nh, options);
  checkGoToPoseOptions(options);
  warnUnknownParameters(private_nh, optionNames<GoToPoseOptions>());
  return options;
}

}  // namespace

GoToPoseNode::GoToPoseNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh)
    : nh_(nh),
      options_(loadGoToPoseOptions(private_nh)),
      commands_(private_nh.getNamespace(), {{}, {nh.resolveName(options_.action_name)}, "", false}),
      transforms_(nh),
      time_(NodeTime::of(nh)),
      navigator_(options_.navigator),
      planner_(
          nh, private_nh.getNamespace(), "plan_path",
          {[this](const PlanPathResult& result) { onPlan(result); }, [](const PlanPathFeedback&) {},
           [this](const std::string& sentence) {
             navigator_.planned({std::nullopt, sentence}, seconds());
             carryOutOrders();
           }}),
      driver_(nh, private_nh.getNamespace(), "navigate_path",
              {[this](const NavigatePathResult& result) { onDriveEnd(driverAnswerOf(result)); },
               [this](const NavigatePathFeedback& feedback) { onDriveFeedback(feedback); },
               [this](const std::string& why) {
                 onDriveEnd({std::nullopt, why});
               }}),
      diagnostics_(nh, private_nh, private_nh.getNamespace()) {
  path_publisher_ = nh_.advertise<nav_msgs::Path>("go_to_path", 1, true);
  status_publisher_ = nh_.advertise<GoToStatus>("go_to_status", 1, true);
  current_goal_publisher_ =
      nh_.advertise<geometry_msgs::PoseStamped>(options_.action_name + "/current_goal", 1, true);
  clear_publisher_ = nh_.advertise<std_msgs::Empty>("clear_scan", 1);
  startServer();
  subscribe();
  reconfigurable_ = std::make_unique<Reconfigurable<GoToPoseConfig, GoToPoseOptions>>(
      private_nh, options_, [this](const GoToPoseOptions& options) { use(options); });
  on_jump_back_ = time_.onJumpBack([this](double seconds) { timeWentBack(seconds); });
  startTimers();
}

GoToPoseNode::~GoToPoseNode() {
  finish();
  for (ros::Subscriber& subscriber : subscribers_)
    subscriber.shutdown();  // asks the master, which may not answer
}

void GoToPoseNode::giveUp() {
  if (std::exchange(finished_, true)) return;
  navigator_.drop();  // a plan that comes now is not driven
  carryOutOrders();
  driver_.cancel();
  driver_.forget();  // or its end might begin something new
  if (goal_) end(Order::Kind::ABORT, "go_to_pose ends");
  ros::WallDuration(kSendingTime).sleep();  // roscpp sends in a thread of its own
}

void GoToPoseNode::startServer() {
  server_ = std::make_unique<MoveBaseServer>(
      nh_, options_.action_name, [this](const MoveBaseGoal& handle) { onGoal(handle); },
      [this](const MoveBaseGoal& handle) { onCancel(handle); }, false);
  server_->start();
  commands_.refuseSimultaneous();
  goal_publisher_ =
      nh_.advertise<move_base_msgs::MoveBaseActionGoal>(options_.action_name + "/goal", 1);
  diagnostics_.add("go to pose", this, &GoToPoseNode::diagnose);
}

void GoToPoseNode::subscribe() {
  const auto on_manual = [this](const std_msgs::Bool& message) {
    if (joystick_.hear(message.data)) noteHandover();
  };
  subscribers_ = {
      subscribeChecked<geometry_msgs::PoseStamped>(
          nh_, "move_base_simple/goal", 1,
          [this](const geometry_msgs::PoseStamped& message) { onSimpleGoal(message); }),
      subscribeChecked<std_msgs::Bool>(nh_, "manual_control", 10, on_manual),
      subscribeChecked<std_msgs::Empty>(nh_, "drive_cancelled", 10, [this](const std_msgs::Empty&) {
        abortAll("CANCELLED: asked for by ~cancel");
      })};
}

void GoToPoseNode::startTimers() {
  timer_ = guardedTimer(nh_, kTickPeriod, [this] { tick(); });
  diagnostics_timer_ = diagnosticsTimer(nh_, diagnostics_);
}

void GoToPoseNode::use(const GoToPoseOptions& options) {
  checkGoToPoseOptions(options);
  if (options.action_name != options_.action_name)
    throw InputError("action_name cannot be changed while the node runs");
  navigator_.setOptions(options.navigator);
  options_ = options;
}

// Goals

// As move_base does it: others see the goal, its status and its result. It is taken before it is published, so that no
// cancel and no other goal overtakes it; when it comes back the server knows it by its id.
void GoToPoseNode::onSimpleGoal(const geometry_msgs::PoseStamped& message) {
  const ros::Time& stamp = message.header.stamp;
  if (const auto problem = time_.problemWith(stamp); problem && !stamp.isZero()) {
    ROS_WARN_STREAM("A goal stamped " << stamp << " is not driven to: " << *problem);
    return;
  }
  const auto goal = boost::make_shared<move_base_msgs::MoveBaseActionGoal>();
  goal->header.stamp = ros::Time::now();
  goal->goal_id.id = "simple_goal-" + std::to_string(ros::WallTime::now().toNSec()) + "-" +
                     std::to_string(++simple_goals_);
  goal->goal.target_pose = message;
  server_->goalCallback(goal);
  goal_publisher_.publish(goal);
}

void GoToPoseNode::onGoal(MoveBaseGoal handle) {
  const auto wanted = handle.getGoal();
  try {
    if (finished_) throw InputError("go_to_pose ends");
    checkGoal(wanted->target_pose, options_.zero_heading);
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("A goal is refused: " << error.what());
    handle.setRejected({}, std::string("INVALID_REQUEST: ") + error.what());
    return;
  }
  navigator_.drop();
  carryOutOrders();
  if (goal_) end(Order::Kind::PREEMPT, "replaced by another goal");
  handle.setAccepted();
  goal_ = Goal{handle, wanted->target_pose, {}, {}};
  publishLatched(current_goal_publisher_, goal_->asked);
  locate();
}

void GoToPoseNode::onCancel(const MoveBaseGoal& handle) {
  if (!goal_ || goal_->handle != handle) return;
  if (!goal_->pose) {
    end(Order::Kind::PREEMPT, "the goal was cancelled");
    return;
  }
  navigator_.cancel("the goal was cancelled", seconds());
  carryOutOrders();
}

Placing GoToPoseNode::placingInMap() const {
  return {frameName(options_.map_frame), options_.tf_timeout, Moving::WITH_VEHICLE,
          frameName(options_.base_frame), options_.zero_heading};
}

// Tried at every tick until tf knows it.
void GoToPoseNode::locate() {
  if (!goal_ || goal_->pose || !time_.isThere()) return;
  if (!goal_->waits_since) goal_->waits_since = std::chrono::steady_clock::now();
  try {
    geometry_msgs::PoseStamped pose;
    path::Pose placed = transforms_.place(goal_->asked, placingInMap());
    const bool any_heading = std::isnan(placed.yaw);
    if (any_heading) placed.yaw = 0.0;
    pose.pose = poseToMessage(placed);
    if (any_heading) pose.pose.orientation = {};  // the planner's zero_heading says the same
    pose.header.frame_id = frameName(options_.map_frame);
    goal_->pose = last_pose_ = pose;
    navigator_.start(seconds());
    carryOutOrders();
  } catch (const InputError& error) {
    end(Order::Kind::ABORT, std::string("INVALID_REQUEST: ") + error.what());
  } catch (const TransformError& error) {
    const std::chrono::duration<double> waited =
        std::chrono::steady_clock::now() - *goal_->waits_since;
    if (waited.count() >= options_.tf_timeout)
      end(Order::Kind::ABORT, std::string("TRANSFORM_ERROR: ") + error.what());
  }
}

void GoToPoseNode::tick() {
  if (!time_.isThere() || finished_) return;
  const ros::Time now = ros::Time::now();
  if (joystick_.expire()) noteHandover();
  locate();
  noteVehicle();
  planner_.watch(options_.server_timeout);
  driver_.watch(options_.server_timeout);
  navigator_.tick(now.toSec());
  carryOutOrders();
  if (!goal_ || std::chrono::steady_clock::now() - told_ < kTellPeriod) return;
  told_ = std::chrono::steady_clock::now();
  publishFeedback(now);
  publishStatus();
}

void GoToPoseNode::timeWentBack(double seconds) {
  if (finished_) return;
  ROS_WARN_STREAM("ROS time went back by " << seconds << " s: tf is cleared, the goal aborted");
  abortAll("ROS time went back");
}

// A drive that goes on is paused by the driver, and resumed by hand. Between drives nobody but this node knows that there is
// a goal: whoever takes the vehicle, or lets it go, would see it set off.
void GoToPoseNode::noteHandover() {
  if (!driver_heeds_joystick_) abortAll(kTakenOver);
}

void GoToPoseNode::abortAll(const std::string& reason) {
  if (goal_ && !goal_->pose) end(Order::Kind::ABORT, reason);
  navigator_.abort(reason, seconds());
  carryOutOrders();
}

void GoToPoseNode::noteVehicle() {
  try {
    vehicle_ = transforms_.placeVehicle(placingInMap()).level();
    navigator_.moved(*vehicle_);
  } catch (const TransformError&) {
    vehicle_.reset();  // the planner and the driver say why, where they need it
  }
}

// What the planner and the driver answer

void GoToPoseNode::onPlan(const PlanPathResult& result) {
  navigator_.planned(navigatorPlanOf(result, options_.map_frame), seconds());
  carryOutOrders();
}

void GoToPoseNode::onDriveFeedback(const NavigatePathFeedback& feedback) {
  distance_remaining_ = feedback.distance_remaining_m;
  time_remaining_ = feedback.time_remaining_s;
  driver_heeds_joystick_ = true;
  navigator_.drove(navigatorDriveOf(feedback), seconds());
  carryOutOrders();
}

void GoToPoseNode::onDriveEnd(const DriverAnswer& answer) {
  driver_heeds_joystick_ = false;
  navigator_.driveEnded(answer.status, answer.message, seconds());
  carryOutOrders();
}

// An order may bring about others: a goal of the driver that was not sent yet ends at once.
void GoToPoseNode::carryOutOrders() {
  if (std::exchange(carrying_out_, true)) return;
  bool any = false;
  for (auto orders = navigator_.takeOrders(); !orders.empty(); orders = navigator_.takeOrders()) {
    // One that fails keeps no other from being carried out: the next may be STOP.
    for (const Order& order : orders) guarded("An order", [&] { carryOut(order); });
    any = true;
  }
  carrying_out_ = false;
  if (any) publishStatus();
}

void GoToPoseNode::carryOut(const Order& order) {
  switch (order.kind) {
    case Order::Kind::PLAN:
      return askForPlan(order.tolerance);
    case Order::Kind::FORGET_PLAN:
      planner_.cancel();
      return planner_.forget();
    case Order::Kind::DRIVE:
      return drive(order.path);
    case Order::Kind::STOP:
      driver_heeds_joystick_ = false;
      return driver_.cancel();
    case Order::Kind::CLEAR_SCAN:
      if (clear_publisher_.getNumSubscribers() == 0)
        ROS_WARN_STREAM("No map_layers with use_scan listens to " << clear_publisher_.getTopic());
      return clear_publisher_.publish(std_msgs::Empty());
    case Order::Kind::TELL:
      ROS_INFO_STREAM(order.sentence);
      return;
    case Order::Kind::WARN:
      ROS_WARN_STREAM(order.sentence);
      return;
    case Order::Kind::SUCCEED:
    case Order::Kind::ABORT:
    case Order::Kind::PREEMPT:
      return end(order.kind, order.sentence);
  }
}

void GoToPoseNode::askForPlan(double tolerance) {
  PlanPathGoal goal;
  goal.goal = *goal_->pose;
  goal.tolerance_m = tolerance;
  planner_.send(goal);
}

void GoToPoseNode::drive(Path path) {
  path.frame_id = frameName(options_.map_frame);
  distance_remaining_ = time_remaining_ = std::numeric_limits<double>::infinity();
  NavigatePathGoal goal;
  goal.path = pathToMessage(path, ros::Time::now());
  driver_.send(goal);
  publishLatched(path_publisher_, goal.path);
}

void GoToPoseNode::showNoPath() {
  nav_msgs::Path path;
  path.header.stamp = ros::Time::now();
  path.header.frame_id = frameName(options_.map_frame);
  publishLatched(path_publisher_, path);
}

void GoToPoseNode::end(Order::Kind kind, const std::string& sentence) {
  last_sentence_ = sentence;
  distance_remaining_ = time_remaining_ = std::numeric_limits<double>::infinity();
  if (!goal_) return;
  MoveBaseGoal handle = goal_->handle;
  goal_.reset();
  showNoPath();
  if (kind == Order::Kind::SUCCEED) {
    ROS_INFO_STREAM("The goal is reached: " << sentence);
    handle.setSucceeded({}, sentence);
  } else if (kind == Order::Kind::PREEMPT) {
    ROS_INFO_STREAM("The goal is given up: " << sentence);
    handle.setCanceled({}, sentence);
  } else {
    ROS_ERROR_STREAM("The goal is aborted: " << sentence);
    handle.setAborted({}, sentence);
  }
  publishStatus();
}

}  // namespace grid_path_planner::nodes
