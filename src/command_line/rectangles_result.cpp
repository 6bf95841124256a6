#include "command_line/rectangles_result.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/planners/free_cells.h"
#include "planners/rectangles/rectangle_route.h"

namespace grid_path_planner::command_line {

using base::InputError;
using costmap::BitMaps;
using grid::CellRect, grid::GridGeometry, grid::OccupancyGrid, grid::RowOrder, grid::rowOrderOf;
using planners::Connection, planners::countRuns, planners::DecompositionLimits,
    planners::DecompositionTooLarge, planners::freeCellsOf, planners::largestFirst,
    planners::largestFirstBytes, planners::mapSizes, planners::mergedRuns, planners::middleOf,
    planners::BorderMiddle, planners::RectangleGraph, planners::RectangleWeight, planners::Side,
    planners::stepWeight;

namespace {

// The map with its last row first.
OccupancyGrid withRowsReversed(const OccupancyGrid& map) {
  OccupancyGrid turned(map.geometry());
  for (int row = 0; row < map.height(); ++row)
    std::copy_n(map.row(row), map.width(), turned.row(map.height() - 1 - row));
  return turned;
}

std::size_t bytesAllowed(const RectanglesRequest& request) {
  return static_cast<std::size_t>(request.memory_limit) * 1000000;
}

// `bytes`: what is needed at least.
[[noreturn]] void refuse(const RectanglesRequest& request, std::size_t bytes) {
  throw InputError(request.map, "needs " + std::to_string(bytes / 1000000 + 1) +
                                    " MB or more to be cut into rectangles, more than "
                                    "--memory-limit " +
                                    std::to_string(request.memory_limit));
}

// Throws InputError before memory is allocated.
std::vector<CellRect> cutWithinMemory(const RectanglesRequest& request,
                                      const GridGeometry& geometry, const BitMaps& free) {
  const std::size_t expected = largestFirstBytes(geometry, countRuns(free.rows));
  if (expected > bytesAllowed(request)) refuse(request, expected);
  DecompositionLimits limits = request.limits;
  limits.bytes = bytesAllowed(request);
  try {
    return request.merged_runs ? mergedRuns(free.rows, {}) : largestFirst(free, limits, {});
  } catch (const DecompositionTooLarge&) {
    refuse(request, limits.bytes);
  }
}

// From centre to centre through both sides of the border's middle, in cells. A planner
// measures the same from where it crossed into `from`.
double lengthThrough(const RectangleGraph& map, std::uint32_t from, const Connection& step) {
  const Eigen::Vector2d a = centreOf(map.rectangles()[from]),
                        b = centreOf(map.rectangles()[step.to]);
  if (step.side == Side::CORNER) return (a - b).norm();
  const BorderMiddle middle = middleOf(map.rectangles()[from], step);
  return (middle.outward - a).norm() + 1.0 + (middle.inward - b).norm();
}

}  // namespace

RectanglesResult cutIntoRectangles(const RectanglesRequest& request, const OccupancyGrid& map) {
  const bool reversed = rowOrderOf(request.map) == RowOrder::LAST_ROW_FIRST;
  const BitMaps free =
      freeCellsOf(reversed ? withRowsReversed(map) : map, {}, request.unknown_is_free, {});
  RectanglesResult result;
  const auto begin = std::chrono::steady_clock::now();
  result.in_file = cutWithinMemory(request, map.geometry(), free);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
  result.time_ms = time.count();
  const std::size_t needed = RectangleGraph::bytesFor(result.in_file.size());
  if (needed > bytesAllowed(request)) refuse(request, needed);
  std::vector<CellRect> rectangles = result.in_file;
  if (reversed)
    for (CellRect& rect : rectangles) rect.row = map.height() - rect.row - rect.height;
  result.map = RectangleGraph(map.geometry(), std::move(rectangles), request.touching);
  result.sizes = mapSizes(result.map);
  return result;
}

Eigen::Vector2d centreOf(const CellRect& rect) {
  return {rect.column + 0.5 * rect.width, rect.row + 0.5 * rect.height};
}

double weightOf(const RectangleGraph& map, RectangleWeight weight, std::uint32_t from,
                const Connection& step) {
  return weight == RectangleWeight::LENGTH ? lengthThrough(map, from, step)
                                           : stepWeight(map, weight, from, step);
}

}  // namespace grid_path_planner::command_line
