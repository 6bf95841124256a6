#include "planning/route.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "grid_path_planner/planning/smooth_result.h"

namespace grid_path_planner::planning {

using base::StopToken;
using costmap::CostGrid, costmap::costOfSteps, costmap::lineCost, costmap::lineOfSight,
    costmap::SegmentPoint, costmap::worldOf;
using grid::Cell;
using path::Path, path::Pose;

namespace {

struct RoutePoint {
  Eigen::Vector2d position;
  const CostGrid* map;  // on which the segments at this point are judged
};

bool neighbours(Cell a, Cell b) {
  return std::abs(a.column - b.column) <= 1 && std::abs(a.row - b.row) <= 1;
}

bool anyAngle(const Leg& leg) {
  return !leg.result.points.empty();
}

Eigen::Vector2d positionOf(const Leg& leg, std::size_t i) {
  return anyAngle(leg) ? worldOf(*leg.map, leg.result.points[i])
                       : leg.map->waypoint(leg.result.cells[i]);
}

// A vehicle cannot tell poses apart that are this near, in metres.
bool samePlace(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a - b).norm() < 1e-9;
}

// Whether the step passes the corner of a blocked neighbour, which only cut_corners allows. Longer
// segments are judged where they lie.
bool cutsCorner(const CostGrid& map, Cell from, Cell to) {
  if (!map.motion().cut_corners) return false;
  if (from.column == to.column || from.row == to.row || !neighbours(from, to)) return false;
  return !map.passable({from.column, to.row}) || !map.passable({to.column, from.row});
}

Eigen::Vector2d sharedCorner(const CostGrid& map, Cell a, Cell b) {
  return map.geometry().worldFromGrid(Eigen::Vector2d(std::max(a.column, b.column),  //
                                                      std::max(a.row, b.row)));
}

// Two legs meet in the middle of one block: the point of the leg at full resolution stands for
// both, except where turning points are legal only as they are.
std::vector<RoutePoint> pointsOf(const Route& route) {
  std::vector<RoutePoint> points;
  const bool keep_both = std::any_of(route.legs.begin(), route.legs.end(), anyAngle);
  for (const Leg& leg : route.legs) {
    const std::vector<Cell>& cells = leg.result.cells;
    const bool coarse = leg.map->kernel() > 1;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const RoutePoint point{positionOf(leg, i), leg.map.get()};
      // The middles of blocks are not always their centres: past a blocked one the path leads
      // exactly over the corner.
      if (coarse && i > 0 && cutsCorner(*leg.map, cells[i - 1], cells[i])) {
        const Eigen::Vector2d corner = sharedCorner(*leg.map, cells[i - 1], cells[i]);
        if (!samePlace(corner, points.back().position) && !samePlace(corner, point.position))
          points.push_back({corner, leg.map.get()});
      }
      if (keep_both && !points.empty() && samePlace(points.back().position, point.position))
        continue;
      const bool joins = i == 0 && !points.empty() && !keep_both;
      if (joins && coarse) continue;
      if (joins) points.pop_back();
      points.push_back(point);
    }
  }
  return points;
}

using Positions = std::vector<Eigen::Vector2d>;

Path pathThrough(const Eigen::Vector2d& start, const Positions& between,
                 const Eigen::Vector2d& goal) {
  Path path;
  const auto add = [&path](const Eigen::Vector2d& position) {
    Pose pose;
    pose.position << position, 0.0;
    path.poses.push_back(pose);
  };
  add(start);
  for (const Eigen::Vector2d& position : between)
    if (!samePlace(position, start) && !samePlace(position, goal)) add(position);
  add(goal);
  return path;
}

}  // namespace

void smoothRoute(Route& route, const StopToken& stop) {
  if (route.shortest) return;
  std::vector<Leg> legs = route.legs;
  bool smooth = true;
  double cost = 0.0;
  for (Leg& leg : legs) {
    leg.result.statistics.time_s = 0.0;
    smooth = smoothResult(*leg.map, leg.result, stop) && smooth;
    cost += leg.result.segment_cost;
    route.plan.statistics.time_s += leg.result.statistics.time_s;
  }
  if (!smooth) return;
  route.legs = std::move(legs);
  route.plan.optimal = false;
  route.plan.cost = {};
  route.plan.segment_cost = cost;
}

bool straightLineLegal(const CostGrid& map, const Eigen::Vector2d& from,
                       const Eigen::Vector2d& to) {
  return lineOfSight(map, SegmentPoint::nearest(map.geometry().gridFromWorld(from)),
                     SegmentPoint::nearest(map.geometry().gridFromWorld(to)));
}

void priceRoute(Route& route, const CostGrid& costs) {
  route.plan.cost = {};
  route.plan.segment_cost = 0.0;
  for (const Leg& leg : route.legs) {
    const std::vector<SegmentPoint>& points = leg.result.points;
    if (!anyAngle(leg)) route.plan.cost += costOfSteps(costs, leg.result.cells);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      route.plan.segment_cost += lineCost(costs, points[i], points[i + 1]);
  }
}

Path pathOfRoute(const Route& route, const RouteEnd& start, const RouteEnd& goal,
                 const EndSegments& segments) {
  const std::vector<RoutePoint> points = pointsOf(route);
  assert(!points.empty());
  const CostGrid &first_map = *points.front().map, &last_map = *points.back().map;
  const Eigen::Vector2d first = start.escape.value_or(start.position);
  const auto leaves = [&](const Eigen::Vector2d& to) {
    return segments.measured() ? segments.leavesStart(first, to)
                               : straightLineLegal(first_map, first, to);
  };
  const auto arrives = [&](const Eigen::Vector2d& from) {
    return segments.measured() ? segments.keeps(from, goal.position)
                               : straightLineLegal(last_map, from, goal.position);
  };
  Positions positions;
  for (const RoutePoint& point : points) positions.push_back(point.position);
  const Eigen::Vector2d next = positions.size() > 1 ? positions[1] : goal.position;
  if (leaves(next))
    positions.erase(positions.begin());
  else if (segments.measured() && !leaves(positions[0]))
    positions.insert(positions.begin(), start.centre);
  if (!positions.empty()) {
    const bool at_start = positions.size() == 1;
    if (at_start ? leaves(goal.position) : arrives(positions[positions.size() - 2]))
      positions.pop_back();
    else if (segments.measured() && !arrives(positions.back()))
      positions.push_back(goal.centre);
  }
  if (start.escape && (positions.empty() || !samePlace(positions.front(), first)))
    positions.insert(positions.begin(), first);
  return pathThrough(start.position, positions, goal.position);
}

}  // namespace grid_path_planner::planning
