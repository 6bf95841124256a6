#include "planning/widest_path.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

#include "costmap/inflation.h"

namespace grid_path_planner::planning {

using base::StopPoll, base::StopToken;
using costmap::Connectivity, costmap::CostGrid, costmap::CostmapOptions, costmap::HalfCellsSquared,
    costmap::KeptDistances, costmap::kNoObstacle, costmap::obstacleDistances, costmap::Outside;
using grid::Cell, grid::CellRect, grid::GridGeometry, grid::Occupancy;

namespace {

constexpr HalfCellsSquared kBlocked = -1;
constexpr HalfCellsSquared kFar = std::numeric_limits<HalfCellsSquared>::max();
// As inflation allows for resolutions that are 32-bit floats.
constexpr double kResolutionSlack = 1e-7;

// How large a vehicle may be in every cell: its radius in half cells, squared.
class Room {
 public:
  Room(const CostGrid& costs, const CostmapOptions& options, const StopToken& stop)
      : costs_(costs),
        options_(options),
        kept_(costmap::keptDistances(options)),
        values_(costs.geometry().size(), kFar) {
    const CellRect all = costs.geometry().rect();
    const int reach = reachOf(std::max(options.radius, kept_.unknown));
    if (!options.occupied_is_passable)
      takeDistances(obstacleDistances(costs.classes(), Occupancy::OCCUPIED, all, reach, stop), true,
                    options.radius);
    if (!options.unknown_is_passable || kept_.unknown > 0.0)
      takeDistances(obstacleDistances(costs.classes(), Occupancy::UNKNOWN, all, reach, stop),
                    options.radius_to_unknown < 0.0, kept_.unknown);
    if (options.outside != Outside::FREE && kept_.outside > 0.0) takeBorder();
    closeClasses();
  }

  HalfCellsSquared operator[](std::size_t i) const { return values_[i]; }

 private:
  double halfCells(double metres) const { return 2.0 * metres / costs_.geometry().resolution(); }
  int reachOf(double metres) const {
    return static_cast<int>(std::min(std::ceil(halfCells(metres) / 2.0) + 1.0, 1e6));
  }

  // What one distance allows: it itself where it follows the radius, else all or nothing; all where
  // it is no less than what is kept there.
  void take(std::size_t i, HalfCellsSquared distance, bool follows_radius, double kept) {
    const double enough = halfCells(kept) * (1.0 - kResolutionSlack);
    if (distance == kNoObstacle || static_cast<double>(distance) >= enough * enough) return;
    values_[i] = std::min(values_[i], follows_radius ? distance : kBlocked);
  }

  void takeDistances(const std::vector<HalfCellsSquared>& distances, bool follows_radius,
                     double kept) {
    for (std::size_t i = 0; i < distances.size(); ++i) take(i, distances[i], follows_radius, kept);
  }

  void takeBorder() {
    const bool follows = options_.outside == Outside::OCCUPIED || options_.radius_to_unknown < 0.0;
    const GridGeometry& geometry = costs_.geometry();
    std::size_t i = 0;
    for (int row = 0; row < geometry.height(); ++row)
      for (int column = 0; column < geometry.width(); ++column, ++i) {
        const HalfCellsSquared cells =
            std::min({column, row, geometry.width() - 1 - column, geometry.height() - 1 - row});
        take(i, (2 * cells + 1) * (2 * cells + 1), follows, kept_.outside);
      }
  }

  void closeClasses() {
    const Occupancy* classes = costs_.classes().values().data();
    for (std::size_t i = 0; i < values_.size(); ++i)
      if ((classes[i] == Occupancy::OCCUPIED && !options_.occupied_is_passable) ||
          (classes[i] == Occupancy::UNKNOWN && !options_.unknown_is_passable))
        values_[i] = kBlocked;
  }

  const CostGrid& costs_;
  const CostmapOptions& options_;
  const KeptDistances kept_;
  std::vector<HalfCellsSquared> values_;
};

// Without cut corners, whoever takes a diagonal step could take the two straight ones too.
std::vector<Cell> stepsOf(const costmap::MotionModel& motion) {
  std::vector<Cell> steps = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  if (motion.cut_corners && motion.connectivity == Connectivity::EIGHT)
    steps.insert(steps.end(), {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}});
  return steps;
}

class WidestSearch {
 public:
  WidestSearch(const GridGeometry& geometry, const Room& room, std::vector<Cell> steps)
      : geometry_(geometry),
        room_(room),
        steps_(std::move(steps)),
        from_(geometry.size(), kUnseen) {}

  bool run(Cell start, Cell goal, const StopToken& stop) {
    StopPoll poll(stop, 1024);
    push(start, kFar, geometry_.index(start).value());
    while (!open_.empty()) {
      poll();
      const auto [width, index] = open_.top();
      open_.pop();
      const Cell cell = cellOf(index);
      if (cell == goal) return true;
      for (const Cell& step : steps_)
        push({cell.column + step.column, cell.row + step.row}, width, index);
    }
    return false;
  }

  // From the start to the goal.
  std::vector<Cell> cellsTo(Cell goal) const {
    std::vector<Cell> cells;
    std::size_t index = geometry_.index(goal).value();
    for (; from_[index] != index; index = from_[index]) cells.push_back(cellOf(index));
    cells.push_back(cellOf(index));
    std::reverse(cells.begin(), cells.end());
    return cells;
  }

 private:
  static constexpr auto kUnseen = static_cast<std::uint32_t>(-1);

  Cell cellOf(std::size_t index) const {
    const auto width = static_cast<std::size_t>(geometry_.width());
    return {static_cast<int>(index % width), static_cast<int>(index / width)};
  }

  // The first path to a cell is the widest: cells are expanded in the order of their widths.
  void push(Cell cell, HalfCellsSquared width, std::size_t from) {
    if (!geometry_.contains(cell)) return;
    const std::size_t index = geometry_.index(cell).value();
    if (from_[index] != kUnseen || room_[index] == kBlocked) return;
    from_[index] = static_cast<std::uint32_t>(from);
    open_.emplace(std::min(width, room_[index]), index);
  }

  const GridGeometry& geometry_;
  const Room& room_;
  const std::vector<Cell> steps_;
  std::vector<std::uint32_t> from_;
  std::priority_queue<std::pair<HalfCellsSquared, std::size_t>> open_;
};

}  // namespace

std::optional<WidestPath> widestPath(const CostGrid& costs, const CostmapOptions& options,
                                     Cell start, Cell goal, const StopToken& stop) {
  const GridGeometry& geometry = costs.geometry();
  const Room room(costs, options, stop);
  WidestSearch search(geometry, room, stepsOf(options.motion));
  if (!search.run(start, goal, stop)) return std::nullopt;
  WidestPath widest;
  widest.cells = search.cellsTo(goal);
  const auto narrowest =
      std::min_element(widest.cells.begin(), widest.cells.end(), [&](Cell a, Cell b) {
        return room[geometry.index(a).value()] < room[geometry.index(b).value()];
      });
  widest.narrowest = *narrowest;
  const auto least = static_cast<double>(room[geometry.index(*narrowest).value()]);
  widest.clearance = std::min(options.radius, 0.5 * std::sqrt(least) * geometry.resolution());
  return widest;
}

}  // namespace grid_path_planner::planning
