#include "ros/planning/path_planner_node.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "grid_path_planner/PathPlannerConfig.h"
#include "grid_path_planner/planning/replan_policy.h"
#include "grid_path_planner/planning/unused_options.h"
#include "ros/common/clock.h"
#include "ros/common/parameters.h"

namespace grid_path_planner::nodes {

using base::Stopped;
using base::StopSource;
using base::TaskQueue;
using planners::memoryLimitOf;
using planning::keepsPath;
using planning::pathBlocked;
using planning::PlannerOptions;
using planning::UnusedOption;
using planning::unusedOptions;

namespace {

constexpr char kGoalSlot[] = "goal";
constexpr char kMapSlot[] = "map";

PathPlannerNodeOptions loadOptions(const ros::NodeHandle& private_nh) {
  PathPlannerNodeOptions options;
  loadParameters(private_nh, options);
  checkPathPlannerNodeOptions(options);
  auto known = optionNames<PathPlannerNodeOptions>();
  known.push_back("diagnostic_period");  // diagnostic_updater's
  warnUnknownParameters(private_nh, known);
  return options;
}

// Says of each option once that it was set in vain.
void warnUnusedOptions(const PlannerOptions& options, const PlannerOptions& before = {}) {
  const std::vector<UnusedOption> told = unusedOptions(before);
  for (const UnusedOption& each : unusedOptions(options))
    if (std::find(told.begin(), told.end(), each) == told.end())
      ROS_WARN_STREAM(each.name << " changes nothing with " << each.with);
}

}  // namespace

PathPlannerNode::PathPlannerNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh) : nh_(nh) {
  const PathPlannerNodeOptions options = loadOptions(private_nh);
  warnUnusedOptions(options.planner);
  desk_ = std::make_unique<PlanningServer>(nh, options, [this] { goals_.forgetStart(); });
  services_ = std::make_unique<PlanServices>(private_nh, *desk_);
  action_ = std::make_unique<PlanAction>(nh, *desk_);
  diagnostics_ = std::make_unique<PlanDiagnostics>(nh, private_nh, *desk_);
  reconfigurable_ = std::make_unique<Reconfigurable<PathPlannerConfig, PathPlannerNodeOptions>>(
      private_nh, options, [this](const PathPlannerNodeOptions& wanted) { onOptions(wanted); });
  desk_->maps().start(nh, [this] { onMapChange(); });
  goal_subscriber_ = nh.subscribe("goal", 1, &PathPlannerNode::onGoal, this);
  initial_pose_subscriber_ = nh.subscribe("initialpose", 1, &PathPlannerNode::onInitialPose, this);
  clock_timer_ = nh.createWallTimer(ros::WallDuration(0.05),
                                    [this](const ros::WallTimerEvent&) { desk_->checkClock(); });
  startReplanTimer(options.replan_period);
}

PathPlannerNode::~PathPlannerNode() {
  goal_subscriber_.shutdown();
  initial_pose_subscriber_.shutdown();
  replan_timer_.stop();
  clock_timer_.stop();
  reconfigurable_.reset();
  desk_->stop();
}

void PathPlannerNode::onGoal(const geometry_msgs::PoseStamped& message) {
  desk_->checkClock();
  goals_.setGoal(message);
  desk_->worker().cancel(kGoalSlot);
  postPlanForGoal();
}

void PathPlannerNode::onInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  desk_->checkClock();
  geometry_msgs::PoseStamped start;
  start.header = message.header;
  start.pose = message.pose.pose;
  goals_.setStart(start);
}

void PathPlannerNode::onOptions(const PathPlannerNodeOptions& options) {
  checkPathPlannerNodeOptions(options);
  const PathPlannerNodeOptions before = desk_->settings().options;
  warnUnusedOptions(options.planner, before.planner);
  desk_->setOptions(options);
  if (options.replan_period != before.replan_period) startReplanTimer(options.replan_period);
  onMapChange();
}

void PathPlannerNode::onMapChange() {
  desk_->worker().post([this](const StopSource& stop) { useMap(stop); }, kMapSlot);
}

void PathPlannerNode::startReplanTimer(double period) {
  replan_timer_.stop();
  if (period <= 0.0) return;
  replan_timer_ = nh_.createTimer(ros::Duration(period), [this](const ros::TimerEvent&) {
    const std::optional<GoalState> goal = goals_.goal();
    if (goal && goal->answered) postPlanForGoal();
  });
}

void PathPlannerNode::postPlanForGoal() {
  desk_->worker().post([this](const StopSource& stop) { planForGoal(stop); }, kGoalSlot,
                       TaskQueue::Turn::NEXT);
}

void PathPlannerNode::planForGoal(const StopSource& stop) {
  const std::optional<GoalState> goal = goals_.goal();
  const PlanningServer::Settings settings = desk_->settings();
  const PlanningResult answer = desk_->answer(goal->question, settings.options, stop);
  if (stop.cancelled() || keepsOldPath(*goal, answer, settings, stop)) return;
  goals_.commit(goal->id, answer.report.path, settings.revision, [&] {
    desk_->publisher().publishPath(answer);
    desk_->publish(answer, goal->question.goal);
  });
}

bool PathPlannerNode::keepsOldPath(const GoalState& goal, const PlanningResult& answer,
                                   const PlanningServer::Settings& settings,
                                   const StopSource& stop) {
  if (goal.path.empty() || !answer.found() || goal.path_settings != settings.revision) return false;
  try {
    const auto costs = desk_->engine().fineCosts(settings.options, stop.token());
    return keepsPath(goal.path, answer.report.path, *costs, settings.options.replan_hysteresis);
  } catch (const Stopped&) {
    return true;  // a new goal is there
  }
}

void PathPlannerNode::useMap(const StopSource& stop) {
  const PathPlannerNodeOptions options = desk_->settings().options;
  try {
    waitForClock(stop.token());
    publishSearchedMap(options, stop);
    if (goalPathBlocked(options, stop)) postPlanForGoal();
  } catch (const Stopped&) {
    // The node ends.
  }
}

void PathPlannerNode::publishSearchedMap(const PathPlannerNodeOptions& options,
                                         const StopSource& stop) {
  const auto costs = desk_->engine().searchedCosts(options, stop.token());
  const bool changed = costs && costs != published_costs_;
  if (changed) desk_->publisher().publishMap(*costs, desk_->engine().frame(options));
  published_costs_ = costs;
  publishRectangles(options, changed);
}

void PathPlannerNode::publishRectangles(const PathPlannerNodeOptions& options, bool map_changed) {
  const bool shown = rectangles_ && rectangles_->shown();
  if (!options.publish_rectangles) {
    if (shown) rectangles_->clear();
    return;
  }
  if (!rectangles_) rectangles_ = std::make_unique<RectanglePublisher>(nh_);
  if (published_costs_ && (map_changed || !shown))
    rectangles_->publish(published_costs_, desk_->engine().frame(options),
                         memoryLimitOf(options.planner.search));
}

bool PathPlannerNode::goalPathBlocked(const PathPlannerNodeOptions& options,
                                      const StopSource& stop) {
  const std::optional<GoalState> goal = goals_.goal();
  if (!goal || goal->path.empty()) return false;
  const auto costs = desk_->engine().fineCosts(options, stop.token());
  if (!pathBlocked(goal->path, desk_->engine().vehicle(options), *costs)) return false;
  ROS_INFO("What remains of the path is blocked: planning again");
  return true;
}

}  // namespace grid_path_planner::nodes
