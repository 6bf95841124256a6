#include "ros/planning/path_planner_node.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "grid_path_planner/PathPlannerConfig.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/planning/replan_policy.h"
#include "grid_path_planner/planning/unused_options.h"
#include "ros/guard/clock.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/guard/master/command_claim.h"
#include "ros/guard/network_text.h"
#include "ros/guard/outgoing/topic_changes.h"
#include "ros/guard/parameters.h"
#include "ros/guard/process/memory_limit_line.h"
#include "ros/guard/scheduling/guarded_timer.h"
#include "ros/messages/file_kinds.h"
#include "ros/messages/vehicle_parameters.h"

namespace grid_path_planner::nodes {

using base::decimalText;
using base::InputError;
using base::sameOptions;
using base::Stopped;
using base::StopSource;
using base::TaskQueue;
using costmap::CostGrid;
using planners::memoryLimitOf;
using planning::keepsPath;
using planning::pathBlocked;
using planning::Plan;
using planning::PlannerOptions;
using planning::UnusedOption;
using planning::unusedOptions;

namespace {

constexpr char kGoalSlot[] = "goal";
constexpr char kMapSlot[] = "map";
constexpr char kSearchedMapSlot[] = "searched map";
constexpr char kCostToGoSlot[] = "cost to go";

// Nothing is planned for a file or a frame that will be refused.
void checkNames(const PathPlannerNodeOptions& options, const NodeFiles& files) {
  checkNetworkText("map_frame", options.map_frame);
  checkNetworkText("base_frame", options.base_frame);
  if (!options.waypoints_file.empty())
    files.toWrite("waypoints_file", options.waypoints_file, waypointFiles());
}

PathPlannerNodeOptions loadOptions(const ros::NodeHandle& private_nh, const NodeFiles& files) {
  PathPlannerNodeOptions options;
  loadParameters(private_nh, options);
  options.vehicle = loadVehicle(private_nh);
  takeFromVehicle(options);
  options.waypoints_file = files.named("waypoints_file", options.waypoints_file);
  checkPathPlannerNodeOptions(options);
  checkNames(options, files);
  auto known = withVehicleNames(optionNames<PathPlannerNodeOptions>());
  known.push_back("diagnostic_period");  // diagnostic_updater's
  warnUnknownParameters(private_nh, known);
  return options;
}

// Warns once of each option that has no effect.
void warnUnusedOptions(const PlannerOptions& options, const PlannerOptions& before = {}) {
  const std::vector<UnusedOption> known = unusedOptions(before);
  for (const UnusedOption& option : unusedOptions(options))
    if (std::find(known.begin(), known.end(), option) == known.end())
      ROS_WARN_STREAM(option.name << " changes nothing with " << option.with);
}

// Whether the same goal may have another path.
bool changesPath(const PathPlannerNodeOptions& a, const PathPlannerNodeOptions& b) {
  return !sameOptions(a.planner, b.planner) || a.goal_z_from != b.goal_z_from ||
         a.map_frame != b.map_frame || a.base_frame != b.base_frame;
}

// What the vehicle is taken for, since a file of parameters that was not read shows nowhere else.
std::string vehicleText(const PlannerOptions& options) {
  std::string text = "a vehicle of radius " + decimalText(options.costmap.radius) + " m";
  if (!options.footprint.empty()) text += " with a footprint";
  if (options.min_turning_radius > 0.0)
    text += " that turns with " + decimalText(options.min_turning_radius) + " m at least";
  return text;
}

}  // namespace

PathPlannerNode::PathPlannerNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                                 const NodeFiles& files)
    : nh_(nh) {
  const PathPlannerNodeOptions options = loadOptions(private_nh, files);
  warnUnusedOptions(options.planner);
  ROS_INFO_STREAM("Plans for " << vehicleText(options.planner));
  ROS_INFO_STREAM(memoryLimitLine("Planning", options.planner.search.memory_limit,
                                  memoryLimitOf(options.planner.search)));
  commands_ = std::make_unique<CommandClaim>(
      private_nh.getNamespace(), Commands{{}, {nh.resolveName("plan_path")}, "", false});
  server_ = std::make_unique<PlanningServer>(nh, options, files);
  planning_map_ = std::make_unique<PlanningMapPublisher>(nh, [this] { postSearchedMap(); });
  cost_to_go_ = std::make_unique<CostToGoPublisher>(private_nh, [this] { postCostToGo(); });
  services_ = std::make_unique<PlanServices>(private_nh, *server_);
  action_ = std::make_unique<PlanAction>(nh, *server_);
  commands_->refuseSimultaneous();
  diagnostics_ = std::make_unique<PlanDiagnostics>(nh, private_nh, *server_);
  reconfigurable_ = std::make_unique<Reconfigurable<PathPlannerConfig, PathPlannerNodeOptions>>(
      private_nh, options, [this](const PathPlannerNodeOptions& wanted) { onOptions(wanted); });
  server_->startMaps(nh, [this] { onMapChange(); });
  subscribers_ = {
      subscribeChecked<geometry_msgs::PoseStamped>(
          nh, "goal", 1, [this](const geometry_msgs::PoseStamped& message) { onGoal(message); }),
      subscribeChecked<geometry_msgs::PoseWithCovarianceStamped>(
          nh, "initialpose", 1, [this](const geometry_msgs::PoseWithCovarianceStamped& message) {
            onInitialPose(message);
          })};
  on_jump_back_ = NodeTime::of(nh).onJumpBack([this](double seconds) {
    ROS_WARN_STREAM("ROS time went back by "
                    << seconds << " s: transforms and start poses from before are forgotten");
    active_goal_.timeWentBack();
  });
  clock_timer_ = guardedTimer(nh, 0.05, [this] { checkTime(); });
  full_map_timer_ = guardedTimer(nh, 0.1, [this] {
    if (planning_map_->wholeMapIsDue(server_->settings().options.full_map_period))
      postSearchedMap();
  });
  replan_period_.begin(ros::Time::now());
}

PathPlannerNode::~PathPlannerNode() {
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
  clock_timer_.stop();
  full_map_timer_.stop();
  reconfigurable_.reset();
  server_->stop();
}

void PathPlannerNode::checkTime() {
  const auto placed = [this](const GoalState& goal) {
    return server_->placed(goal.path.frame_id, goal.request.goal);
  };
  if (active_goal_.retryIsDue(std::chrono::steady_clock::now(), placed)) postPlanForGoal();
  replanInTime();
}

void PathPlannerNode::replanInTime() {
  const double period = server_->settings().options.replan_period;
  if (period <= 0.0 || !replan_period_.isOver(ros::Time::now(), period)) return;
  const std::optional<GoalState> goal = active_goal_.goal();
  if (goal && goal->answered) postPlanForGoal();
}

void PathPlannerNode::onGoal(const geometry_msgs::PoseStamped& message) {
  active_goal_.setGoal(message, ros::Time::now());
  server_->vehicleLane().worker().cancel(kGoalSlot);
  postPlanForGoal();
}

void PathPlannerNode::onInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  geometry_msgs::PoseStamped start;
  start.header = message.header;
  start.pose = message.pose.pose;
  active_goal_.setStart(start);
}

void PathPlannerNode::onOptions(const PathPlannerNodeOptions& options) {
  checkPathPlannerNodeOptions(options);
  checkNames(options, server_->files());
  const PathPlannerNodeOptions before = server_->settings().options;
  warnUnusedOptions(options.planner, before.planner);
  server_->setOptions(options);
  if (options.replan_period != before.replan_period) replan_period_.begin(ros::Time::now());
  // A planning that runs has the options from before.
  if (active_goal_.goal() && changesPath(options, before)) postPlanForGoal();
  onMapChange();
}

void PathPlannerNode::onMapChange() {
  active_goal_.mapChanged();
  server_->vehicleLane().worker().post([this](const StopSource& stop) { processMap(stop); },
                                       kMapSlot);
  server_->prepareForQuestions();
}

void PathPlannerNode::postPlanForGoal() {
  server_->vehicleLane().worker().post(
      [this](const StopSource& stop) {
        planForGoal(stop);
        postCostToGo();
        server_->vehicleLane().finishLater(server_->settings().options);
      },
      kGoalSlot, TaskQueue::Turn::NEXT);
}

void PathPlannerNode::postSearchedMap() {
  server_->vehicleLane().worker().post([this](const StopSource& stop) { publishSearchedMap(stop); },
                                       kSearchedMapSlot);
}

void PathPlannerNode::postCostToGo() {
  if (!cost_to_go_->wanted()) return;
  server_->vehicleLane().worker().post([this](const StopSource& stop) { publishCostToGo(stop); },
                                       kCostToGoSlot);
}

void PathPlannerNode::planForGoal(const StopSource& stop) {
  server_->tellJumps();
  const auto goal = active_goal_.beginPlanning(std::chrono::steady_clock::now());
  try {
    planFor(*goal, stop);
  } catch (const Stopped&) {
    throw;
  } catch (...) {
    active_goal_.failed(goal->id);
    throw;
  }
}

void PathPlannerNode::planFor(const GoalState& goal, const StopSource& stop) {
  const PlanningServer::Settings settings = server_->settings();
  PlanningLane& lane = server_->vehicleLane();
  const Plan plan = lane.plan(goal.request, server_->recordingOptions(settings.options), stop).plan;
  server_->record(lane, plan, settings.options);
  if (stop.cancelled() || keepsOldPath(goal, plan, settings, stop)) return;
  const bool as_before = goal.answered && !plan.found() && plan.status == goal.status;
  const auto publish = [&] {
    server_->remember(plan);
    if (!as_before)
      server_->publisher().publishPath(lane.posesAlong(plan, settings.options), goal.given);
  };
  const auto placed = lane.placedGoal(goal.request, settings.options);
  const bool taken = active_goal_.commit(goal.id, plan, settings.revision, publish, placed);
  if (!taken) return;
  // Who drives the path does not wait for what is told of it.
  server_->publish(lane, plan, lane.statistics(plan, goal.request, settings.options), as_before);
  if (!as_before) server_->explainLater(goal.request, plan);
}

bool PathPlannerNode::keepsOldPath(const GoalState& goal, const Plan& plan,
                                   const PlanningServer::Settings& settings,
                                   const StopSource& stop) {
  if (goal.path.empty() || !plan.found() || goal.path_settings != settings.revision ||
      goal.path.frame_id != plan.path.frame_id)
    return false;
  try {
    PlanningLane& lane = server_->vehicleLane();
    const auto costs = lane.fullResolutionCosts(settings.options, stop.token());
    return keepsPath(goal.path, plan.path, *costs, settings.options.replan_hysteresis) &&
           lane.footprintContact(goal.path, plan.path.poses.front().position.head<2>(),
                                 settings.options, stop.token())
               .empty();
  } catch (const Stopped&) {
    return true;  // a new goal has come
  }
}

// What shows the map waits until the path is planned again.
void PathPlannerNode::processMap(const StopSource& stop) {
  const PathPlannerNodeOptions options = server_->settings().options;
  try {
    waitForClock(stop.token());
    server_->vehicleLane().downsampledCosts(options, stop.token());
    if (goalPathBlocked(options, stop)) postPlanForGoal();
    postSearchedMap();
    postCostToGo();
    server_->vehicleLane().prepare(options, stop.token());
    server_->vehicleLane().finishLater(options);
  } catch (const Stopped&) {
    // The node ends.
  } catch (const std::exception&) {
    // Nobody knows whether the map blocks the path: it is gone where it cannot be planned again.
    if (const auto goal = active_goal_.goal(); goal && !goal->path.empty()) postPlanForGoal();
    throw;
  }
}

void PathPlannerNode::publishSearchedMap(const StopSource& stop) {
  const PathPlannerNodeOptions options = server_->settings().options;
  PlanningLane& lane = server_->vehicleLane();
  try {
    const ros::Time newest = server_->maps().latest().stamp;  // before a newer map may come
    const auto costs = lane.downsampledCosts(options, stop.token());
    if (!costs) return;
    waitForClock(stop.token());
    planning_map_->publish(*costs, lane.downsampledChanges(), lane.frame(options), newest,
                           options.full_map_period);
    publishRectangles(options, costs);
  } catch (const Stopped&) {
    // The node ends.
  }
}

void PathPlannerNode::publishRectangles(const PathPlannerNodeOptions& options,
                                        const std::shared_ptr<const CostGrid>& costs) {
  const bool shown = rectangles_ && rectangles_->shown();
  if (!options.publish_rectangles) {
    if (shown) rectangles_->clear();
    cut_costs_.reset();
    return;
  }
  if (!rectangles_) {
    const auto alone = lockTopicsOfRunningNode();
    rectangles_ = std::make_unique<RectanglePublisher>(nh_);
  }
  if (costs != cut_costs_ || !shown)
    rectangles_->publish(costs, server_->vehicleLane().frame(options),
                         memoryLimitOf(options.planner.search));
  cut_costs_ = costs;
}

void PathPlannerNode::publishCostToGo(const StopSource& stop) {
  const std::optional<GoalState> goal = active_goal_.goal();
  if (!goal) return;
  const PathPlannerNodeOptions options = server_->settings().options;
  PlanningLane& lane = server_->vehicleLane();
  try {
    const auto costs = lane.downsampledCosts(options, stop.token());
    if (!costs) return;
    cost_to_go_->publish(costs, lane.goalOf(goal->request, options, stop.token()),
                         lane.frame(options), memoryLimitOf(options.planner.search));
  } catch (const Stopped&) {
    // The node ends.
  } catch (const InputError&) {
    // The answer to the goal says why.
  } catch (const TransformError&) {
    // The same.
  }
}

bool PathPlannerNode::goalPathBlocked(const PathPlannerNodeOptions& options,
                                      const StopSource& stop) {
  const std::optional<GoalState> goal = active_goal_.goal();
  if (!goal || goal->path.empty()) return false;
  PlanningLane& lane = server_->vehicleLane();
  const auto costs = lane.fullResolutionCosts(options, stop.token());
  if (goal->path.frame_id != lane.frame(options)) {
    ROS_INFO_STREAM("The map is in frame " << lane.frame(options) << " now, the path in "
                                           << goal->path.frame_id << ": planning again");
    return true;
  }
  const std::optional<Eigen::Vector2d> vehicle = server_->vehicle(lane.frame(options), options);
  const bool blocked = pathBlocked(goal->path, vehicle, *costs);
  const std::string contact =
      blocked ? "" : lane.footprintContact(goal->path, vehicle, options, stop.token());
  if (!blocked && contact.empty()) return false;
  ROS_INFO_STREAM("What remains of the path is blocked: planning again"
                  << (contact.empty() ? "" : "; " + contact));
  return true;
}

}  // namespace grid_path_planner::nodes
