#include "planners/rectangles/rectangle_route.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace grid_path_planner::planners {

using base::Statistics, base::StopPoll, base::StopToken;
using grid::Cell, grid::CellRect;

namespace {

Eigen::Vector2d centreOf(const CellRect& rect) {
  return {rect.column + 0.5 * rect.width, rect.row + 0.5 * rect.height};
}

// In cells, from the corner of the map.
Eigen::Vector2d pointOf(Cell cell) {
  return {cell.column + 0.5, cell.row + 0.5};
}

double distance(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a - b).norm();
}

}  // namespace

double stepWeight(const RectangleGraph& map, RectangleWeight weight, std::uint32_t from,
                  const Connection& step) {
  switch (weight) {
    case RectangleWeight::AREA:
      return step.to + 1.0;
    case RectangleWeight::BORDER:
      return 1.0 / step.length;
    case RectangleWeight::DISTANCE:
      return (centreOf(map.rectangles()[from]) - centreOf(map.rectangles()[step.to])).norm();
    case RectangleWeight::CONNECTIONS:
      return 1.0 / static_cast<double>(map.connections().of(step.to).size());
    case RectangleWeight::LENGTH:
      break;
  }
  assert(false);
  return 0.0;
}

BorderMiddle middleOf(const CellRect& from, const Connection& step) {
  const double middle = step.first + 0.5 * step.length;
  const double east = from.column + from.width, north = from.row + from.height;
  switch (step.side) {
    case Side::EAST:
      return {{east - 0.5, middle}, {east + 0.5, middle}};
    case Side::WEST:
      return {{from.column + 0.5, middle}, {from.column - 0.5, middle}};
    case Side::NORTH:
      return {{middle, north - 0.5}, {middle, north + 0.5}};
    case Side::SOUTH:
      return {{middle, from.row + 0.5}, {middle, from.row - 0.5}};
    case Side::CORNER:
      break;
  }
  assert(false);
  return {};
}

std::size_t RectangleSearch::bytes() const {
  return nodes_.capacity() * sizeof(Node) + open_.bytes();
}

void RectangleSearch::startQuery(std::size_t nodes) {
  open_.clear();
  if (nodes_.size() < nodes) nodes_.resize(nodes);
  stamp_.next([this] { std::fill(nodes_.begin(), nodes_.end(), Node()); });
}

void RectangleSearch::relax(std::uint32_t node, double g, double h, std::uint32_t parent,
                            std::uint32_t step, Statistics& counts) {
  Node& known = nodes_[node];
  if (stamp_.wrote(known.state) && ((known.state & kClosed) != 0 || known.g <= g)) return;
  known = {g, parent, step, stamp_.word()};
  open_.push({g + h, node});
  ++counts.generated;
  counts.peak_open = std::max(counts.peak_open, open_.size());
}

bool RectangleSearch::popNode(std::uint32_t& node, Statistics& counts) {
  while (!open_.empty()) {
    node = open_.pop().node;
    if ((nodes_[node].state & kClosed) != 0) continue;
    nodes_[node].state |= kClosed;
    ++counts.expanded;
    return true;
  }
  return false;
}

RectangleRoute RectangleSearch::find(const RectangleGraph& map, RectangleWeight weight, Cell start,
                                     Cell goal, const StopToken& stop) {
  RectangleRoute route = weight == RectangleWeight::LENGTH
                             ? findOverBorders(map, start, goal, stop)
                             : findOverRectangles(map, weight, start, goal, stop);
  std::reverse(route.steps.begin(), route.steps.end());
  route.statistics.search_bytes = bytes();
  return route;
}

RectangleRoute RectangleSearch::findOverRectangles(const RectangleGraph& map,
                                                   RectangleWeight weight, Cell start, Cell goal,
                                                   const StopToken& stop) {
  const Connections& connections = map.connections();
  const std::uint32_t last = map.at(goal).value();
  RectangleRoute route;
  route.first = map.at(start).value();
  // Of the published weights only the distance has a lower bound above 0.
  const Eigen::Vector2d end = centreOf(map.rectangles()[last]);
  const auto bound = [&](std::uint32_t rectangle) {
    return weight == RectangleWeight::DISTANCE
               ? (centreOf(map.rectangles()[rectangle]) - end).norm()
               : 0.0;
  };

  startQuery(map.rectangles().size());
  relax(route.first, 0.0, bound(route.first), route.first, 0, route.statistics);
  StopPoll poll(stop);
  for (std::uint32_t from = 0; popNode(from, route.statistics);) {
    poll();
    route.expanded.push_back(from);
    if (from == last) {
      route.found = true;
      route.weight = nodes_[last].g;
      for (std::uint32_t at = last; at != route.first; at = nodes_[at].parent)
        route.steps.push_back(connections[nodes_[at].step]);
      break;
    }
    auto number = static_cast<std::uint32_t>(connections.firstOf(from));
    for (const Connection& step : connections.of(from))
      relax(step.to, nodes_[from].g + stepWeight(map, weight, from, step), bound(step.to), from,
            number++, route.statistics);
  }
  return route;
}

// A node is a connection that was crossed, and stands for its middle on the inward side. The last two
// nodes are the start and the goal.
RectangleRoute RectangleSearch::findOverBorders(const RectangleGraph& map, Cell start, Cell goal,
                                                const StopToken& stop) {
  const Connections& connections = map.connections();
  const auto origin = static_cast<std::uint32_t>(connections.size());
  const std::uint32_t target = origin + 1;
  const std::uint32_t last = map.at(goal).value();
  RectangleRoute route;
  route.first = map.at(start).value();
  const auto rectangleOf = [&](std::uint32_t node) {
    return node == origin ? route.first : connections[node].to;
  };
  const Eigen::Vector2d begin = pointOf(start), end = pointOf(goal);
  const auto placeOf = [&](std::uint32_t node) {
    if (node == origin) return begin;
    const std::uint32_t from = rectangleOf(nodes_[node].parent);
    return middleOf(map.rectangles()[from], connections[node]).inward;
  };

  startQuery(connections.size() + 2);
  relax(origin, 0.0, distance(begin, end), origin, 0, route.statistics);
  StopPoll poll(stop);
  for (std::uint32_t from = 0; popNode(from, route.statistics);) {
    poll();
    route.expanded.push_back(from == target ? last : rectangleOf(from));
    if (from == target) {
      route.found = true;
      route.weight = nodes_[target].g;
      for (std::uint32_t at = nodes_[target].parent; at != origin; at = nodes_[at].parent)
        route.steps.push_back(connections[at]);
      break;
    }
    const Eigen::Vector2d here = placeOf(from);
    const double g = nodes_[from].g;
    const std::uint32_t rectangle = rectangleOf(from);
    if (rectangle == last) relax(target, g + distance(here, end), 0.0, from, 0, route.statistics);
    auto number = static_cast<std::uint32_t>(connections.firstOf(rectangle));
    for (const Connection& step : connections.of(rectangle)) {
      const BorderMiddle middle = middleOf(map.rectangles()[rectangle], step);
      relax(number, g + distance(here, middle.outward) + 1.0, distance(middle.inward, end), from,
            number, route.statistics);
      ++number;
    }
  }
  return route;
}

}  // namespace grid_path_planner::planners
