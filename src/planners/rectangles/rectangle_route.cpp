#include "grid_path_planner/planners/rectangle_route.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace grid_path_planner::planners {

using base::Statistics;
using base::StopPoll;
using base::StopToken;
using grid::Cell;
using grid::CellRect;

namespace {

Eigen::Vector2d centreOf(const CellRect& rect) {
  return {rect.column + 0.5 * rect.width, rect.row + 0.5 * rect.height};
}

double distance(Cell a, Cell b) {
  return std::hypot(a.column - b.column, a.row - b.row);
}

struct Later {
  template <class Entry>
  bool operator()(const Entry& a, const Entry& b) const {
    return a.f != b.f ? a.f > b.f : a.node > b.node;
  }
};

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

std::pair<Cell, Cell> middleOf(const CellRect& from, const Connection& step) {
  const int middle = step.first + (step.length - 1) / 2;
  switch (step.side) {
    case Side::EAST:
      return {{from.column + from.width - 1, middle}, {from.column + from.width, middle}};
    case Side::WEST:
      return {{from.column, middle}, {from.column - 1, middle}};
    case Side::NORTH:
      return {{middle, from.row + from.height - 1}, {middle, from.row + from.height}};
    case Side::SOUTH:
      return {{middle, from.row}, {middle, from.row - 1}};
    case Side::CORNER:
      break;
  }
  assert(false);
  return {};
}

std::size_t RectangleSearch::bytes() const {
  return nodes_.capacity() * sizeof(Node) + heap_.capacity() * sizeof(Entry);
}

void RectangleSearch::begin(std::size_t nodes) {
  heap_.clear();
  if (nodes_.size() < nodes) nodes_.resize(nodes);
  if (++query_ != 0) return;
  std::fill(nodes_.begin(), nodes_.end(), Node());
  query_ = 1;
}

void RectangleSearch::reach(std::uint32_t node, double g, double h, std::uint32_t parent,
                            std::uint32_t step, Statistics& counts) {
  Node& known = nodes_[node];
  if (known.query == query_ && (known.closed || known.g <= g)) return;
  known = {g, parent, step, query_, false};
  heap_.push_back({g + h, node});
  std::push_heap(heap_.begin(), heap_.end(), Later());
  ++counts.generated;
  counts.peak_open = std::max(counts.peak_open, heap_.size());
}

bool RectangleSearch::take(std::uint32_t& node, Statistics& counts) {
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), Later());
    node = heap_.back().node;
    heap_.pop_back();
    if (nodes_[node].closed) continue;
    nodes_[node].closed = true;
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
  // No published weight but the distance has a lower bound that is worth asking for.
  const Eigen::Vector2d end = centreOf(map.rectangles()[last]);
  const auto bound = [&](std::uint32_t rectangle) {
    return weight == RectangleWeight::DISTANCE
               ? (centreOf(map.rectangles()[rectangle]) - end).norm()
               : 0.0;
  };

  begin(map.rectangles().size());
  reach(route.first, 0.0, bound(route.first), route.first, 0, route.statistics);
  StopPoll poll(stop);
  for (std::uint32_t from = 0; take(from, route.statistics);) {
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
      reach(step.to, nodes_[from].g + stepWeight(map, weight, from, step), bound(step.to), from,
            number++, route.statistics);
  }
  return route;
}

// A node is a connection that was crossed: the vehicle stands on its inward cell. The last two
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
  const auto cellOf = [&](std::uint32_t node) {
    if (node == origin) return start;
    const std::uint32_t from = rectangleOf(nodes_[node].parent);
    return middleOf(map.rectangles()[from], connections[node]).second;
  };

  begin(connections.size() + 2);
  reach(origin, 0.0, distance(start, goal), origin, 0, route.statistics);
  StopPoll poll(stop);
  for (std::uint32_t from = 0; take(from, route.statistics);) {
    poll();
    route.expanded.push_back(from == target ? last : rectangleOf(from));
    if (from == target) {
      route.found = true;
      route.weight = nodes_[target].g;
      for (std::uint32_t at = nodes_[target].parent; at != origin; at = nodes_[at].parent)
        route.steps.push_back(connections[at]);
      break;
    }
    const Cell here = cellOf(from);
    const double g = nodes_[from].g;
    const std::uint32_t rectangle = rectangleOf(from);
    if (rectangle == last) reach(target, g + distance(here, goal), 0.0, from, 0, route.statistics);
    auto number = static_cast<std::uint32_t>(connections.firstOf(rectangle));
    for (const Connection& step : connections.of(rectangle)) {
      const auto [outward, inward] = middleOf(map.rectangles()[rectangle], step);
      reach(number, g + distance(here, outward) + 1.0, distance(inward, goal), from, number,
            route.statistics);
      ++number;
    }
  }
  return route;
}

}  // namespace grid_path_planner::planners
