#include "planning/plan_attempt.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <utility>

#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/planning/nearest_cell.h"
#include "grid_path_planner/planning/smooth_route.h"
#include "planning/route_path.h"

namespace grid_path_planner::planning {

using base::Statistics;
using base::Status;
using base::StopToken;
using costmap::CostmapOptions;
using grid::Cell;
using grid::GridGeometry;
using grid::Occupancy;
using path::applyHeadings;
using path::applyZ;
using path::lengthOf;
using path::Path;
using path::Pose;

namespace {

Eigen::Vector2d planar(const Pose& pose) {
  return pose.position.head<2>();
}

std::string text(const Eigen::Vector2d& position) {
  std::ostringstream out;
  out << std::setprecision(6) << '(' << position.x() << ", " << position.y() << ')';
  return out.str();
}

std::string metres(double length) {
  std::ostringstream out;
  out << std::setprecision(4) << length << " m";
  return out.str();
}

std::string extentOf(const GridGeometry& geometry) {
  std::ostringstream out;
  out << geometry.width() << 'x' << geometry.height() << " cells of " << geometry.resolution()
      << " m from " << text({geometry.origin().x, geometry.origin().y});
  return out.str();
}

bool samePose(const Pose& a, const Pose& b) {
  const double turn = std::remainder(a.yaw - b.yaw, 2.0 * M_PI);
  return (a.position - b.position).norm() < 1e-9 && std::abs(turn) < 1e-9;
}

void addNote(std::string& message, const std::string& note) {
  if (!note.empty()) message += "; " + note;
}

}  // namespace

PlanAttempt::PlanAttempt(PathPlanner& planner, const PoseRequest& request, const StopToken& stop)
    : planner_(planner), request_(request), stop_(stop), fine_(planner.fullResolutionCosts(stop)) {}

Plan PlanAttempt::run() {
  Plan report;
  std::optional<End> start = startEnd(report);
  if (!start) return report;
  std::optional<End> goal = goalEnd(*start, report);
  if (!goal) return report;

  Route route = search(*start, *goal);
  if (route.status == Status::UNREACHABLE && start->moved && !goal->moved) {
    const std::optional<End> other = escapeTowards(*goal);
    if (other) {
      const Statistics before = route.statistics;
      start = other;
      route = search(*start, *goal);
      route.statistics += before;
    }
  }
  if (route.status == Status::UNREACHABLE && !goal->moved && planner_.options().tolerance > 0.0) {
    const std::optional<End> substitute = substituteGoal(*start, "is unreachable");
    if (substitute) {
      const Statistics before = route.statistics;
      goal = substitute;
      route = search(*start, *goal);
      route.statistics += before;
    }
  }
  fill(report, *start, *goal, std::move(route));
  return report;
}

std::optional<PlanAttempt::End> PlanAttempt::startEnd(Plan& report) const {
  const Eigen::Vector2d position = planar(request_.start);
  const std::optional<Cell> cell = fine_->geometry().cellAt(position);
  if (!cell) {
    report.status = Status::START_OUTSIDE_MAP;
    report.message =
        "start " + text(position) + " lies outside the map of " + extentOf(fine_->geometry());
    return std::nullopt;
  }
  if (fine_->passable(*cell)) return End{*cell, position, "", false};

  const std::optional<End> escape =
      escapeStart([this](Cell each) { return fine_->passable(each); });
  if (escape) return escape;
  const double radius = planner_.options().start_escape_radius;
  report.status = Status::START_OCCUPIED;
  report.message = "start " + text(position) + " " + whyBlocked(*cell);
  if (radius > 0.0) report.message += ", with no passable cell within " + metres(radius);
  return std::nullopt;
}

template <class Usable>
std::optional<PlanAttempt::End> PlanAttempt::escapeStart(Usable&& usable) const {
  const Eigen::Vector2d position = planar(request_.start);
  const double radius = planner_.options().start_escape_radius;
  if (radius <= 0.0) return std::nullopt;
  const auto nearest = nearestCell(fine_->geometry(), position, radius, usable);
  if (!nearest) return std::nullopt;
  return End{nearest->cell, position,
             "start " + whyBlocked(*fine_->geometry().cellAt(position)) +
                 ": the path leaves it for a passable cell " + metres(nearest->distance) + " away",
             true};
}

std::optional<PlanAttempt::End> PlanAttempt::escapeTowards(const End& goal) const {
  const std::vector<std::uint8_t> reached =
      planner_.routes_->reachable(goal.cell, planner_.options().retry_finer, stop_);
  return escapeStart(
      [&](Cell cell) { return reached[fine_->geometry().index(cell).value()] != 0; });
}

std::optional<PlanAttempt::End> PlanAttempt::goalEnd(const End& start, Plan& report) {
  const Eigen::Vector2d position = planar(request_.goal);
  const std::optional<Cell> cell = fine_->geometry().cellAt(position);
  if (!cell) {
    report.status = Status::GOAL_OUTSIDE_MAP;
    report.message =
        "goal " + text(position) + " lies outside the map of " + extentOf(fine_->geometry());
    return std::nullopt;
  }
  if (fine_->passable(*cell)) return End{*cell, position, "", false};

  const double tolerance = planner_.options().tolerance;
  if (tolerance > 0.0) {
    const std::optional<End> substitute = substituteGoal(start, whyBlocked(*cell));
    if (substitute) return substitute;
  }
  report.status = Status::GOAL_OCCUPIED;
  report.message = "goal " + text(position) + " " + whyBlocked(*cell);
  if (tolerance > 0.0)
    report.message += ", with no reachable cell within the tolerance of " + metres(tolerance);
  return std::nullopt;
}

std::optional<PlanAttempt::End> PlanAttempt::substituteGoal(const End& start,
                                                            const std::string& why) {
  const std::vector<std::uint8_t> reached =
      planner_.routes_->reachable(start.cell, planner_.options().retry_finer, stop_);
  const GridGeometry& geometry = fine_->geometry();
  const auto nearest =
      nearestCell(geometry, planar(request_.goal), planner_.options().tolerance,
                  [&](Cell cell) { return reached[geometry.index(cell).value()] != 0; });
  if (!nearest) return std::nullopt;
  return End{nearest->cell, geometry.centre(nearest->cell),
             "goal " + why + ": the path ends " + metres(nearest->distance) + " from it", true};
}

std::string PlanAttempt::whyBlocked(Cell cell) const {
  const CostmapOptions& terrain = planner_.options().terrain;
  switch (fine_->occupancy(cell)) {
    case Occupancy::OCCUPIED:
      if (!terrain.occupied_is_passable) return "is in an occupied cell";
      break;
    case Occupancy::UNKNOWN:
      if (!terrain.unknown_is_passable)
        return "is in an unknown cell and unknown_is_passable is false";
      break;
    case Occupancy::FREE:
      break;
  }
  return "is nearer than the radius of " + metres(terrain.radius) + " to an occupied cell";
}

Route PlanAttempt::search(const End& start, const End& goal) {
  Route route = planner_.routes_->find(start.cell, goal.cell, planner_.options().retry_finer,
                                       request_.record_expanded, stop_);
  if (planner_.options().smooth && route.status == Status::FOUND) smoothRoute(route, stop_);
  return route;
}

void PlanAttempt::fill(Plan& report, const End& start, const End& goal, Route route) const {
  report.status = route.status;
  report.kernel = route.kernel;
  report.statistics = route.statistics;
  report.expanded = std::move(route.expanded);
  if (route.status == Status::UNREACHABLE) {
    report.message = "no way leads from " + text(start.position) + " to " + text(goal.position);
    if (planner_.options().tolerance > 0.0)
      report.message += " or within " + metres(planner_.options().tolerance) + " of it";
    return;
  }
  report.message = route.message;
  if (route.status != Status::FOUND) return;

  report.cost = route.cost;
  report.segment_cost = route.segment_cost;
  report.optimal = route.optimal;
  for (const Leg& leg : route.legs) report.cells += leg.cells.size();
  report.cells -= route.legs.size() - 1;
  report.path = pathOf(start, goal, route);
  report.length_m = lengthOf(report.path);
  std::ostringstream message;
  message << "a path of " << metres(report.length_m) << ", cost " << std::setprecision(10)
          << report.costValue();
  report.message = message.str();
  addNote(report.message, route.message);
  addNote(report.message, start.note);
  addNote(report.message, goal.note);
}

Path PlanAttempt::pathOf(const End& start, const End& goal, const Route& route) const {
  const PlannerOptions& options = planner_.options();
  if (!goal.moved && !start.moved && samePose(request_.start, request_.goal)) {
    Path path;
    path.poses.push_back(request_.goal);
    return path;
  }
  Path path = pathOfRoute(route, start.position, goal.position, start.moved);
  applyZ(path, request_.start.position.z(), request_.goal.position.z(), options.fixed_z,
         options.path_z);
  applyHeadings(path, request_.start.yaw, request_.goal.yaw, options.heading);
  return path;
}

}  // namespace grid_path_planner::planning
