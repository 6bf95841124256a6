#include "planning/plan_on_costs.h"

#include <chrono>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>
#include <utility>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/path/metrics.h"
#include "planning/message_text.h"
#include "planning/path_ends.h"
#include "planning/waypoints.h"

namespace grid_path_planner::planning {

using base::InputError, base::Statistics, base::Status, base::Stopped, base::StopSource,
    base::StopToken;
using costmap::Connectivity, costmap::CostGrid, costmap::DiagonalCost, costmap::lineCost,
    costmap::MotionModel, costmap::SegmentPoint;
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

void addLeads(Path& path, const VehicleTerms& terms) {
  std::vector<Pose>& poses = path.poses;
  const auto apart = [](const Pose& a, const Pose& b) {
    return (a.position - b.position).head<2>().norm() > 1e-9;
  };
  if (terms.from && apart(*terms.from, poses.front())) poses.insert(poses.begin(), *terms.from);
  if (terms.to && apart(*terms.to, poses.back())) poses.push_back(*terms.to);
}

Path pathOf(const Route& route, const PathEnd& start, const PathEnd& goal,
            const PoseRequest& request, const PlannerOptions& options, const CostGrid& costs,
            const VehicleTerms& terms) {
  Path path;
  const bool leads = terms.from || terms.to;
  if (!leads && !goal.moved && !start.moved && samePose(request.start, request.goal)) {
    path.poses.push_back(request.goal);
    return path;
  }
  const auto end = [&costs](const PathEnd& of) {
    return RouteEnd{of.position, costs.geometry().centre(of.cell), of.escape};
  };
  path = pathOfRoute(route, end(start), end(goal), EndSegments(costs));
  addLeads(path, terms);
  const Pose &first = terms.from ? *terms.from : request.start,
             &last = terms.to ? *terms.to : request.goal;
  applyZ(path, first.position.z(), last.position.z(), options.fixed_z, options.path_z);
  applyHeadings(path, first.yaw, last.yaw, options.heading);
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
                   const PoseRequest& request, const PlannerOptions& options, const CostGrid& costs,
                   const VehicleTerms& terms) {
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
  plan.path = pathOf(route, start, goal, request, options, costs, terms);
  if (terms.shape) terms.shape(plan);
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

// Adds the cost of a straight line.
void addLine(Route& route, const CostGrid& costs, const Pose& from, const Pose& to) {
  const auto point = [&costs](const Pose& pose) {
    return SegmentPoint::nearest(costs.geometry().gridFromWorld(pose.position.head<2>()));
  };
  route.plan.segment_cost += lineCost(costs, point(from), point(to));
}

std::string startComplaint(const PoseRequest& request, const VehicleTerms& terms) {
  return terms.complaint ? terms.complaint(request.start) : "";
}

}  // namespace

Plan planOnCosts(const CostGrid& costs, MultiResolutionPlanner& search, const PoseRequest& request,
                 const PlannerOptions& options, const StopToken& stop, const VehicleTerms& terms) {
  const PathEnds ends(request, options, costs, search, stop, terms.complaint);
  Plan failure;
  std::optional<PathEnd> start = ends.start(failure);
  if (!start) return failure;
  const std::string complaint = startComplaint(request, terms);
  if (!complaint.empty())
    return failedPlan(Status::START_OCCUPIED,
                      "start " + positionText(start->position) + " " + complaint);
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
  if (terms.priced && route.plan.found()) {
    priceRoute(route, *terms.priced);
    if (terms.from) addLine(route, *terms.priced, *terms.from, request.start);
    if (terms.to) addLine(route, *terms.priced, request.goal, *terms.to);
  }
  return completedPlan(std::move(route), *start, *goal, request, options, costs, terms);
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
