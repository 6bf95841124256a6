#include "planning/plan_on_costs.h"

#include <chrono>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>
#include <utility>

#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/path/metrics.h"
#include "planning/message_text.h"
#include "planning/path_ends.h"
#include "planning/waypoints.h"

namespace grid_path_planner::planning {

using base::InputError, base::Statistics, base::Status, base::Stopped, base::StopSource,
    base::StopToken;
using costmap::Connectivity, costmap::CostGrid, costmap::DiagonalCost, costmap::MotionModel;
using path::applyHeadings, path::applyZ, path::lengthOf, path::lengthsByClass, path::Path,
    path::Pose;
using planners::TooExpensive;

namespace {

bool finite(const Pose& pose) {
  return pose.position.allFinite() && std::isfinite(pose.yaw);
}

bool samePose(const Pose& a, const Pose& b) {
  const double turn = std::remainder(a.yaw - b.yaw, 2.0 * M_PI);
  return (a.position - b.position).norm() < 1e-9 && std::abs(turn) < 1e-9;
}

std::string number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

StopToken limited(const StopSource& stop, double timeout) {
  return timeout > 0.0 ? stop.token(std::chrono::duration<double>(timeout)) : stop.token();
}

// Whether lines of any angle have costs that compare with those of steps.
bool smooths(const PlannerOptions& options) {
  const MotionModel& motion = options.costmap.motion;
  return options.smooth && motion.connectivity == Connectivity::EIGHT &&
         motion.diagonal_cost == DiagonalCost::SQRT2;
}

Path pathOf(const Route& route, const PathEnd& start, const PathEnd& goal,
            const PoseRequest& request, const PlannerOptions& options, const CostGrid& costs) {
  Path path;
  if (!goal.moved && !start.moved && samePose(request.start, request.goal)) {
    path.poses.push_back(request.goal);
    return path;
  }
  const auto end = [&costs](const PathEnd& of) {
    return RouteEnd{of.position, costs.geometry().centre(of.cell)};
  };
  path = pathOfRoute(route, end(start), end(goal), start.moved, EndSegments(costs));
  applyZ(path, request.start.position.z(), request.goal.position.z(), options.fixed_z,
         options.path_z);
  applyHeadings(path, request.start.yaw, request.goal.yaw, options.heading);
  return path;
}

// "a path of 12.3 m, cost 45.6" and the notes.
std::string foundMessage(const Plan& plan, const PathEnd& start, const PathEnd& goal) {
  std::ostringstream text;
  text << "a path of " << metresText(plan.length_m) << ", cost " << std::setprecision(10)
       << plan.costValue();
  std::string message = text.str();
  addNote(message, plan.message);
  addNote(message, start.note);
  addNote(message, goal.note);
  return message;
}

Plan completedPlan(Route route, const PathEnd& start, const PathEnd& goal,
                   const PoseRequest& request, const PlannerOptions& options,
                   const CostGrid& costs) {
  Plan plan = std::move(route.plan);
  if (plan.status == Status::UNREACHABLE)
    plan.message = unreachableText(start.position, goal.position, options.tolerance);
  if (!plan.found()) {
    plan.cost = {};
    plan.segment_cost = 0.0;
    return plan;
  }
  for (const Leg& leg : route.legs) plan.cells += leg.result.cells.size();
  plan.cells -= route.legs.size() - 1;
  plan.path = pathOf(route, start, goal, request, options, costs);
  plan.length_m = lengthOf(plan.path);
  plan.waypoints = waypointsOf(plan.path, options, costs);
  addNote(plan.message, unknownNote(lengthsByClass(plan.path, costs.classes())));
  plan.message = foundMessage(plan, start, goal);
  return plan;
}

Route findRoute(MultiResolutionPlanner& search, const PathEnd& start, const PathEnd& goal,
                const PlannerOptions& options, bool record_expanded, const StopToken& stop) {
  Route route = search.find(start.cell, goal.cell, options.retry_finer, record_expanded, stop);
  if (smooths(options) && route.plan.found()) smoothRoute(route, stop);
  return route;
}

}  // namespace

Plan planOnCosts(const CostGrid& costs, MultiResolutionPlanner& search, const PoseRequest& request,
                 const PlannerOptions& options, const StopToken& stop) {
  const PathEnds ends(request, options, costs, search, stop);
  Plan failure;
  std::optional<PathEnd> start = ends.start(failure);
  if (!start) return failure;
  std::optional<PathEnd> goal = ends.goal(*start, failure);
  if (!goal) return failure;

  const auto routeBetween = [&](const PathEnd& from, const PathEnd& to) {
    return findRoute(search, from, to, options, request.record_expanded, stop);
  };
  Route route = routeBetween(*start, *goal);
  const auto searchAgain = [&] {
    const Statistics before = route.plan.statistics;
    route = routeBetween(*start, *goal);
    route.plan.statistics += before;
  };
  if (route.plan.status == Status::UNREACHABLE && start->moved && !goal->moved) {
    if (const std::optional<PathEnd> other = ends.escapeTowards(*goal)) {
      start = other;
      searchAgain();
    }
  }
  if (route.plan.status == Status::UNREACHABLE && !goal->moved && options.tolerance > 0.0) {
    if (const std::optional<PathEnd> other = ends.substituteGoal(*start, "is unreachable")) {
      goal = other;
      searchAgain();
    }
  }
  return completedPlan(std::move(route), *start, *goal, request, options, costs);
}

Plan planWithin(double timeout, const PoseRequest& request, const StopSource& stop,
                const std::function<Plan(const StopToken&)>& work) {
  if (!finite(request.start) || !finite(request.goal))
    return failedPlan(Status::INVALID_REQUEST, "start and goal must be finite numbers");
  Plan plan;
  try {
    plan = work(limited(stop, timeout));
  } catch (const Stopped& stopped) {
    plan = failedPlan(stopped.status(), "");
  } catch (const TooExpensive&) {
    plan = failedPlan(Status::INVALID_REQUEST, TooExpensive::kMessage);
  } catch (const InputError& error) {
    plan = failedPlan(Status::INVALID_REQUEST, error.what());
  }
  if (plan.status == Status::TIMEOUT)
    plan.message = "planning reached its time limit of " + number(timeout) + " s";
  if (plan.status == Status::CANCELLED) plan.message = "planning was cancelled";
  plan.path.frame_id = plan.waypoints.frame_id = "map";
  return plan;
}

}  // namespace grid_path_planner::planning
