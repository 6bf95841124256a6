#include "planners/rectangles/rectangle_map_planner.h"

#include <algorithm>
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

// The outward and inward cells of every border, between the two ends.
std::vector<Cell> throughTheMiddles(const RectangleGraph& map, const RectangleRoute& route,
                                    Cell start, Cell goal) {
  std::vector<Cell> cells = {start};
  const auto add = [&cells](Cell cell) {
    if (cell != cells.back()) cells.push_back(cell);
  };
  std::uint32_t rectangle = route.first;
  for (const Connection& step : route.steps) {
    const auto [outward, inward] = middleOf(map.rectangles()[rectangle], step);
    add(outward);
    add(inward);
    rectangle = step.to;
  }
  add(goal);
  return cells;
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
  if (options_.rectangle_funnel) {
    const bool lattice = map().segmentRule() == costmap::SegmentRule::CENTRE_LATTICE;
    result.points = shortestThrough(rectangles(), route, waypointOf(map(), start),
                                    waypointOf(map(), goal), lattice ? &map() : nullptr);
    for (const SegmentPoint point : result.points)
      result.cells.push_back(passableCellAt(map(), point));
    result.cells.front() = start;
    result.cells.back() = goal;
  } else {
    result.cells = throughTheMiddles(rectangles(), route, start, goal);
    for (const Cell cell : result.cells) result.points.push_back(waypointOf(map(), cell));
  }
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
