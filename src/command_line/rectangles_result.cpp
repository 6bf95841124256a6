#include "command_line/rectangles_result.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/planners/free_cells.h"
#include "grid_path_planner/planners/rectangle_route.h"

namespace grid_path_planner::command_line {

using base::InputError;
using costmap::BitMaps;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;
using grid::RowOrder;
using grid::rowOrderOf;
using planners::Connection;
using planners::countRuns;
using planners::DecompositionLimits;
using planners::DecompositionTooLarge;
using planners::freeCellsOf;
using planners::largestFirst;
using planners::largestFirstBytes;
using planners::mapSizes;
using planners::mergedRuns;
using planners::middleOf;
using planners::RectangleGraph;
using planners::RectangleWeight;
using planners::Side;
using planners::stepWeight;

namespace {

// The map with its last row first.
OccupancyGrid turnedOver(const OccupancyGrid& map) {
  OccupancyGrid turned(map.geometry());
  for (int row = 0; row < map.height(); ++row)
    std::copy_n(map.row(row), map.width(), turned.row(map.height() - 1 - row));
  return turned;
}

std::size_t bytesAllowed(const RectangleQuestion& question) {
  return static_cast<std::size_t>(question.memory_limit) * 1000000;
}

// `bytes` are needed, or more.
[[noreturn]] void refuse(const RectangleQuestion& question, std::size_t bytes) {
  throw InputError(question.map, "needs " + std::to_string(bytes / 1000000 + 1) +
                                     " MB or more to be cut into rectangles, more than "
                                     "--memory-limit " +
                                     std::to_string(question.memory_limit));
}

// Throws InputError before memory is taken.
std::vector<CellRect> cutWithinMemory(const RectangleQuestion& question,
                                      const GridGeometry& geometry, const BitMaps& free) {
  const std::size_t expected = largestFirstBytes(geometry, countRuns(free.rows));
  if (expected > bytesAllowed(question)) refuse(question, expected);
  DecompositionLimits limits = question.limits;
  limits.bytes = bytesAllowed(question);
  try {
    return question.merged_runs ? mergedRuns(free.rows, {}) : largestFirst(free, limits, {});
  } catch (const DecompositionTooLarge&) {
    refuse(question, limits.bytes);
  }
}

// From centre to centre through the cells on both sides of the border's middle, in cells. A planner
// measures the same from where it crossed into `from`.
double lengthThrough(const RectangleGraph& map, std::uint32_t from, const Connection& step) {
  const Eigen::Vector2d a = centreOf(map.rectangles()[from]),
                        b = centreOf(map.rectangles()[step.to]);
  if (step.side == Side::CORNER) return (a - b).norm();
  const auto [outward, inward] = middleOf(map.rectangles()[from], step);
  const auto centre = [](Cell cell) { return Eigen::Vector2d(cell.column + 0.5, cell.row + 0.5); };
  return (centre(outward) - a).norm() + 1.0 + (centre(inward) - b).norm();
}

}  // namespace

RectangleAnswer answerOf(const RectangleQuestion& question, const OccupancyGrid& map) {
  const bool over = rowOrderOf(question.map) == RowOrder::LAST_ROW_FIRST;
  const BitMaps free = freeCellsOf(over ? turnedOver(map) : map, {}, question.unknown_is_free, {});
  RectangleAnswer answer;
  const auto begin = std::chrono::steady_clock::now();
  answer.in_file = cutWithinMemory(question, map.geometry(), free);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
  answer.time_ms = time.count();
  const std::size_t needed = RectangleGraph::bytesFor(answer.in_file.size());
  if (needed > bytesAllowed(question)) refuse(question, needed);
  std::vector<CellRect> rectangles = answer.in_file;
  if (over)
    for (CellRect& rect : rectangles) rect.row = map.height() - rect.row - rect.height;
  answer.map = RectangleGraph(map.geometry(), std::move(rectangles), question.touching);
  answer.sizes = mapSizes(answer.map);
  return answer;
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
