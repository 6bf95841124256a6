#include "planners/rectangles/rectangle_map_planner.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "grid_path_planner/planners/decomposition.h"
#include "planners/core/any_angle_traits.h"
#include "planners/rectangles/funnel.h"

namespace grid_path_planner::planners {

using base::Status, base::StopToken;
using costmap::CostGrid, costmap::lineCost, costmap::passableCellAt, costmap::SegmentPoint,
    costmap::waypointOf;
using grid::Cell, grid::CellRect;

namespace {

// Maps have about as many rectangles as their rows have runs of free cells.
std::size_t bytesForRuns(const grid::GridGeometry& geometry, std::size_t runs) {
  return std::max(largestFirstBytes(geometry, runs), RectangleGraph::bytesFor(runs));
}

// Throws Stopped, and DecompositionTooLarge before it takes more than `memory`.
RectangleGraph decomposed(const CostGrid& map, std::size_t memory, const StopToken& stop) {
  DecompositionLimits limits;
  limits.bytes = memory;
  std::vector<CellRect> rectangles = largestFirst(map.bitMaps(stop), limits, stop);
  rectangles.shrink_to_fit();
  if (RectangleGraph::bytesFor(rectangles.size()) > memory) throw DecompositionTooLarge();
  return RectangleGraph(map.geometry(), std::move(rectangles), Touching::BORDERS, stop);
}

Cell middleOf(const CellRect& rect) {
  return {rect.column + rect.width / 2, rect.row + rect.height / 2};
}

// The middle of every border, outward and inward, between the two ends.
std::vector<SegmentPoint> throughTheMiddles(const CostGrid& map, const RectangleGraph& rectangles,
                                            const RectangleRoute& route, SegmentPoint start,
                                            SegmentPoint goal) {
  std::vector<SegmentPoint> points = {start};
  const auto add = [&points](SegmentPoint point) {
    if (!(point == points.back())) points.push_back(point);
  };
  // Between the waypoints of the cells on either side, or that of the cell around it.
  const auto addMiddle = [&](const Eigen::Vector2d& at) {
    const auto below = [](double x) { return static_cast<int>(std::ceil(x)) - 1; };
    const auto above = [](double x) { return static_cast<int>(std::floor(x)); };
    const SegmentPoint lower = waypointOf(map, {below(at.x()), below(at.y())});
    const SegmentPoint upper = waypointOf(map, {above(at.x()), above(at.y())});
    add({(lower.x + upper.x) / 2, (lower.y + upper.y) / 2});
  };
  std::uint32_t rectangle = route.first;
  for (const Connection& step : route.steps) {
    const BorderMiddle middle = middleOf(rectangles.rectangles()[rectangle], step);
    addMiddle(middle.outward);
    addMiddle(middle.inward);
    rectangle = step.to;
  }
  add(goal);
  return points;
}

}  // namespace

PlannerTraits RectangleMapPlanner::declaredTraits() {
  PlannerTraits traits = anyAngleTraits("rectangle_map");
  traits.weights = false;
  traits.repairs = true;
  return traits;
}

RectangleMapPlanner::RectangleMapPlanner(const RectangleMapOptions& options)
    : Planner(declaredTraits()), options_(options) {}

// Of a map without obstacles, the least of all maps; doPrepare() counts the runs of the map.
std::size_t RectangleMapPlanner::bytesFor(const grid::GridGeometry& geometry) const {
  return bytesForRuns(geometry, static_cast<std::size_t>(geometry.height()));
}

void RectangleMapPlanner::doPrepare(const StopToken& stop) {
  rectangles_ = RectangleGraph();
  const std::size_t bytes = bytesForRuns(map().geometry(), countRuns(map().bitMaps(stop).rows));
  const auto megabytes = [](std::size_t number) { return std::to_string(number / 1000000 + 1); };
  const std::string too_much = " MB to cut this map into rectangles, more than the " +
                               std::to_string(memoryLimit() / 1000000) +
                               " MB that memory_limit leaves it";
  if (bytes > memoryLimit()) return refuse("needs up to " + megabytes(bytes) + too_much);
  try {
    rectangles_ = decomposed(map(), memoryLimit(), stop);
  } catch (const DecompositionTooLarge&) {
    refuse("needs more than " + megabytes(memoryLimit()) + too_much);
  }
}

void RectangleMapPlanner::doUpdate(const std::vector<CellRect>& changed, const StopToken& stop) {
  for (const CellRect& rect : changed) rectangles_.edit(map().bitMaps(stop).rows, rect, stop);
}

void RectangleMapPlanner::addPath(const RectangleRoute& route, const SearchRequest& request,
                                  SearchResult& result) const {
  const Cell start = request.start, goal = request.goals.front();
  const SegmentPoint first = waypointOf(map(), start), last = waypointOf(map(), goal);
  const bool lattice = map().segmentRule() == costmap::SegmentRule::CENTRE_LATTICE;
  result.points =
      options_.rectangle_funnel
          ? shortestThrough(rectangles(), route, first, last, lattice ? &map() : nullptr)
          : throughTheMiddles(map(), rectangles(), route, first, last);
  for (const SegmentPoint point : result.points)
    result.cells.push_back(passableCellAt(map(), point));
  result.cells.front() = start;
  result.cells.back() = goal;
  for (std::size_t i = 1; i < result.points.size(); ++i)
    result.segment_cost += lineCost(map(), result.points[i - 1], result.points[i]);
}

SearchResult RectangleMapPlanner::doSearch(const SearchRequest& request, const StopToken& stop) {
  const RectangleRoute route = search_.find(rectangles(), options_.rectangle_weight, request.start,
                                            request.goals.front(), stop);
  SearchResult result;
  result.statistics = route.statistics;
  result.statistics.search_bytes += rectangles().bytes();
  if (request.record_expanded)
    for (const std::uint32_t rectangle : route.expanded)
      result.expanded.push_back(
          map().geometry().index(middleOf(rectangles().rectangles()[rectangle])));
  result.status = route.found ? Status::FOUND : Status::UNREACHABLE;
  if (route.found) addPath(route, request, result);
  return result;
}

}  // namespace grid_path_planner::planners
