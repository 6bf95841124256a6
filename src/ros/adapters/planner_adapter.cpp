#include "ros/adapters/planner_adapter.h"

#include <nav_msgs/Path.h>
#include <ros/console.h>

#include <cmath>
#include <utility>

#include "base/current_error.h"
#include "grid_path_planner/MoveBasePluginConfig.h"
#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/ros/conversions.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "path/pose_spacing.h"
#include "ros/guard/parameters.h"
#include "ros/guard/process/memory_limit_line.h"
#include "ros/messages/pose_reading.h"

namespace grid_path_planner::nodes {

using base::currentErrorText, base::InputError, base::Status, base::StopSource;
using path::HeadingMode, path::Path, path::Pose, path::spacedPoses;
using planning::failedPlan, planning::Plan, planning::PoseRequest;

namespace {

AdapterOptions loadedOptions(const ros::NodeHandle& private_nh) {
  AdapterOptions options;
  loadParameters(private_nh, options);
  checkAdapterOptions(options);
  warnUnknownParameters(private_nh, optionNames<AdapterOptions>());
  return options;
}

// Of a vehicle, which tilts. Throws InputError where it is no pose.
Pose startPose(const geometry_msgs::Pose& message) {
  geometry_msgs::Pose level = message;
  const geometry_msgs::Quaternion& q = message.orientation;
  const double length = std::hypot(std::hypot(q.x, q.y), std::hypot(q.z, q.w));
  if (std::abs(length - 1.0) < 0.1) {
    const double yaw = yawOf(q);
    level.orientation.x = level.orientation.y = 0.0;
    level.orientation.z = std::sin(yaw / 2.0);
    level.orientation.w = std::cos(yaw / 2.0);
  }
  return poseFromMessage(level);
}

Pose goalPose(const geometry_msgs::Pose& message, ZeroHeading zero_heading) {
  const Pose pose = readPose(message, zero_heading).pose;
  checkCoordinates(pose.position);
  return pose;
}

template <class Work>
auto named(const char* which, Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(std::string(which) + ": " + error.what());
  }
}

}  // namespace

// A call of makePlan() that cancel() ends.
class PlannerAdapter::Active {
 public:
  explicit Active(PlannerAdapter& adapter) : adapter_(adapter) {
    const std::lock_guard<std::mutex> lock(adapter_.mutex_);
    stop_ = adapter_.active_.emplace(adapter_.active_.end());
  }
  ~Active() {
    const std::lock_guard<std::mutex> lock(adapter_.mutex_);
    adapter_.active_.erase(stop_);
  }
  Active(const Active&) = delete;
  Active& operator=(const Active&) = delete;

  const StopSource& stop() const { return *stop_; }

 private:
  PlannerAdapter& adapter_;
  std::list<StopSource>::iterator stop_;
};

class PlannerAdapter::Reconfiguration {
 public:
  Reconfiguration(const ros::NodeHandle& private_nh, const AdapterOptions& options,
                  PlannerAdapter& adapter)
      : server_(private_nh, options, [&adapter](const AdapterOptions& wanted) {
          checkAdapterOptions(wanted);
          const std::lock_guard<std::mutex> lock(adapter.mutex_);
          adapter.wanted_ = wanted;
        }) {}

 private:
  Reconfigurable<MoveBasePluginConfig, AdapterOptions> server_;
};

PlannerAdapter::PlannerAdapter(const ros::NodeHandle& private_nh, const std::string& frame_id)
    : frame_id_(frameName(frame_id)),
      options_(loadedOptions(private_nh)),
      planner_(options_.planner) {
  const planners::SearchOptions& search = options_.planner.search;
  ROS_INFO_STREAM(memoryLimitLine("Planning", search.memory_limit, memoryLimitOf(search)));
  plan_ = ros::NodeHandle(private_nh).advertise<nav_msgs::Path>("plan", 1);
  reconfiguration_ = std::make_unique<Reconfiguration>(private_nh, options_, *this);
}

PlannerAdapter::~PlannerAdapter() {
  cancel();
}

void PlannerAdapter::cancel() {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (StopSource& each : active_) each.cancel();
}

void PlannerAdapter::takeOptions() {
  std::optional<AdapterOptions> wanted;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    wanted.swap(wanted_);
  }
  if (!wanted) return;
  planner_.setOptions(wanted->planner);
  options_ = std::move(*wanted);
}

PlannerAdapter::Answer PlannerAdapter::makePlan(const geometry_msgs::PoseStamped& start,
                                                const geometry_msgs::PoseStamped& goal,
                                                std::optional<double> tolerance,
                                                const GiveCosts& give_costs) {
  try {
    const Active active(*this);
    const std::lock_guard<std::mutex> one_at_a_time(planning_);
    Answer answer = answerTo(start, goal, tolerance, give_costs, active.stop());
    log(answer);
    return answer;
  } catch (const std::exception&) {  // what is said here is short enough to need no memory itself
    return {Status::INVALID_REQUEST, "no memory left", 0.0, {}};
  }
}

PlannerAdapter::Answer PlannerAdapter::answerTo(const geometry_msgs::PoseStamped& start,
                                                const geometry_msgs::PoseStamped& goal,
                                                std::optional<double> tolerance,
                                                const GiveCosts& give_costs,
                                                const StopSource& stop) {
  try {
    takeOptions();
    return answerOf(plan(start, goal, tolerance, give_costs, stop));
  } catch (const std::exception&) {
    return {Status::INVALID_REQUEST, currentErrorText(), 0.0, {}};
  }
}

Plan PlannerAdapter::plan(const geometry_msgs::PoseStamped& start,
                          const geometry_msgs::PoseStamped& goal, std::optional<double> tolerance,
                          const GiveCosts& give_costs, const StopSource& stop) {
  for (const geometry_msgs::PoseStamped* each : {&start, &goal}) {
    const char* const which = each == &start ? "start" : "goal";
    const std::string frame = named(which, [&] { return frameName(each->header.frame_id); });
    if (frame != frame_id_)
      return failedPlan(Status::TRANSFORM_ERROR, std::string("the ") + which + " is in frame '" +
                                                     frame + "', the costmap in '" + frame_id_ +
                                                     "'");
  }
  PoseRequest request{named("start", [&] { return startPose(start.pose); }),
                      named("goal", [&] { return goalPose(goal.pose, options_.zero_heading); })};
  request.any_goal_heading = std::isnan(request.goal.yaw);
  if (request.any_goal_heading) request.goal.yaw = request.start.yaw;
  const double within = tolerance.value_or(options_.planner.default_tolerance);
  if (!(within >= 0.0))
    throw InputError("the tolerance must be at least 0 m, got " + std::to_string(within));
  give_costs(planner_);
  Plan plan = planner_.plan(request, within, stop);
  if (plan.found() && request.any_goal_heading) {
    const HeadingMode heading = options_.planner.heading;
    const double yaw = path::arrivalYaw(plan.path, request.start.yaw, heading);
    path::applyHeadings(plan.path, request.start.yaw, yaw, heading);
  }
  return plan;
}

PlannerAdapter::Answer PlannerAdapter::answerOf(Plan plan) {
  Answer answer{plan.status, std::move(plan.message), plan.costValue(), {}};
  if (!plan.found()) return answer;
  plan.path.frame_id = frame_id_;
  const double cell = planner_.searched()->geometry().resolution();
  const double spacing = options_.pose_spacing < 0.0 ? cell : options_.pose_spacing;
  nav_msgs::Path message =
      pathToMessage(spacedPoses(plan.path, spacing, options_.planner.heading), ros::Time::now());
  plan_.publish(message);
  answer.poses = std::move(message.poses);
  return answer;
}

void PlannerAdapter::log(const Answer& answer) {
  const std::string text = std::string(toString(answer.status)) + ": " + answer.message;
  ROS_DEBUG_STREAM_NAMED("grid_path_planner", text);
  if (answer.found()) return last_failure_.clear();
  if (text == last_failure_ || !seldom_.isDue()) return;
  ROS_WARN_STREAM("grid_path_planner: " << text);
  last_failure_ = text;
}

}  // namespace grid_path_planner::nodes
