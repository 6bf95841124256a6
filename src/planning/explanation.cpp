#include "planning/explanation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/planners/reachable_cells.h"
#include "grid_path_planner/planning/nearest_cell.h"
#include "planning/message_text.h"
#include "planning/widest_path.h"

namespace grid_path_planner::planning {

using base::Status, base::StopPoll, base::StopToken;
using costmap::CostGrid, costmap::CostmapOptions;
using grid::Cell, grid::CellRect, grid::GridGeometry, grid::Occupancy;
using planners::reachableFrom;

namespace {

constexpr double kFarSide =
    4.0;  // of the vehicle's radius: as far as the other side of a gap may be
constexpr double kEverywhere = std::numeric_limits<double>::infinity();

Eigen::Vector2d placeOf(const path::Pose& pose) {
  return pose.position.head<2>();
}

// No more than it is: a vehicle of the radius that is told must pass.
double roundedDown(double radius) {
  return std::floor(radius * 1000.0 + 1e-6) / 1000.0;
}

// Across the gap at a cell: from the nearest obstacle to the nearest one on the other side, which is no more than
// 60 degrees from opposite: the posts of a door need not face one another as seen from a cell's centre.
class Across {
 public:
  Across(const CostGrid& costs, const CostmapOptions& options, const StopToken& stop)
      : costs_(costs), options_(options), stop_(stop) {}

  Gap at(Cell cell, double largest_radius) const {
    const GridGeometry& geometry = costs_.geometry();
    const Eigen::Vector2d middle(cell.column + 0.5, cell.row + 0.5);
    const auto side = nearestEdge(middle, 1.0, [](const Eigen::Vector2d&) { return true; });
    if (!side) return {geometry.centre(cell), 0.0, largest_radius};
    const Eigen::Vector2d away = (middle - *side).normalized();
    const auto beyond = nearestEdge(middle, kFarSide, [&](const Eigen::Vector2d& point) {
      return (point - middle).normalized().dot(away) > 0.5;
    });
    const Eigen::Vector2d other = beyond.value_or(middle + kFarSide * reach() * away);
    return {geometry.worldFromGrid(0.5 * (*side + other)),
            (other - *side).norm() * geometry.resolution(), largest_radius};
  }

 private:
  bool closed(Cell cell) const {
    if (!costs_.geometry().contains(cell)) return true;
    const Occupancy occupancy = costs_.occupancy(cell);
    return occupancy == Occupancy::OCCUPIED ||
           (occupancy == Occupancy::UNKNOWN && !options_.unknown_is_passable);
  }

  double reach() const { return options_.radius / costs_.geometry().resolution(); }

  // Of the closed cells within `radii` of the vehicle's around, the nearest of those nearest points
  // of cells that are `wanted`, in cells.
  template <class Wanted>
  std::optional<Eigen::Vector2d> nearestEdge(const Eigen::Vector2d& middle, double radii,
                                             Wanted wanted) const {
    const CellRect map = costs_.geometry().rect().grown(1);
    const int cells = static_cast<int>(
        std::min<double>(std::ceil(radii * reach()) + 1.0, std::max(map.width, map.height)));
    const Cell own{static_cast<int>(middle.x()), static_cast<int>(middle.y())};
    const CellRect around = CellRect{own.column, own.row, 1, 1}.grown(cells).intersection(map);
    std::optional<Eigen::Vector2d> nearest;
    StopPoll poll(stop_);
    for (int row = around.row; row < around.row + around.height; ++row)
      for (int column = around.column; column < around.column + around.width; ++column) {
        poll();
        if (!closed({column, row})) continue;
        const Eigen::Vector2d low(column, row);
        const Eigen::Vector2d point = middle.cwiseMax(low).cwiseMin(low + Eigen::Vector2d::Ones());
        if (!wanted(point)) continue;
        if (!nearest || (point - middle).norm() < (*nearest - middle).norm()) nearest = point;
      }
    return nearest;
  }

  const CostGrid& costs_;
  const CostmapOptions& options_;
  const StopToken& stop_;
};

// The parts of one explanation.
class Explainer {
 public:
  Explainer(const CostGrid& costs, const PlannerOptions& options, const PoseRequest& request,
            const StopToken& stop)
      : costs_(costs), options_(options), request_(request), stop_(stop) {}

  Explanation explain(Cell start, Cell goal, Status status) const {
    Explanation explanation;
    if (status == Status::UNREACHABLE) explainGap(start, goal, explanation);
    explainNearest(start, status, explanation);
    return explanation;
  }

 private:
  void explainGap(Cell start, Cell goal, Explanation& explanation) const {
    const CostmapOptions& costmap = options_.costmap;
    const auto widest = widestPath(costs_, costmap, start, goal, stop_);
    if (!widest) {
      explainClosed(start, goal, explanation);
    } else if (widest->clearance >= costmap.radius) {
      if (costmap.kernel > 1)
        explanation.text = "the kernel closes every path: kernel 1 or retry_finer finds a path";
    } else {
      const Gap gap = Across(costs_, costmap, stop_).at(widest->narrowest, widest->clearance);
      explanation.gap = gap;
      explanation.text = "the gap at " + positionText(gap.position) + " is " +
                         metresText(gap.width) + " wide" + whyTooNarrow(gap) + "; " +
                         metresText(roundedDown(gap.largest_radius)) + " would pass";
    }
  }

  // A vehicle passes on the centres of cells, none of which may lie in the middle of the gap.
  std::string whyTooNarrow(const Gap& gap) const {
    const double radius = options_.costmap.radius;
    if (gap.width < 2.0 * radius - 1e-6)
      return "; radius " + metresText(radius) + " needs " + metresText(2.0 * radius);
    return ", but has no centre of a cell that is " + metresText(radius) + " from either side";
  }

  // Whatever the vehicle's size.
  void explainClosed(Cell start, Cell goal, Explanation& explanation) const {
    CostmapOptions through = options_.costmap;
    through.radius = 0.0;
    through.radius_to_unknown = 0.0;
    through.unknown_is_passable = true;
    explanation.only_unknown =
        !options_.costmap.unknown_is_passable && widestPath(costs_, through, start, goal, stop_);
    explanation.text = explanation.only_unknown
                           ? "only unknown cells lead there, and unknown_is_passable is false"
                           : "obstacles lie all around, for a vehicle of any size";
  }

  void explainNearest(Cell start, Status status, Explanation& explanation) const {
    const GridGeometry& geometry = costs_.geometry();
    const std::vector<std::uint8_t> reached = reachableFrom(costs_, start, stop_);
    const auto nearest = nearestCell(geometry, placeOf(request_.goal), kEverywhere, [&](Cell cell) {
      return reached[geometry.index(cell).value()] != 0;
    });
    if (!nearest) return;
    explanation.nearest = geometry.centre(nearest->cell);
    explanation.text += std::string(explanation.text.empty() ? "" : "; ") +
                        (status == Status::GOAL_OCCUPIED ? "the nearest possible goal is "
                                                         : "the nearest place in reach is ") +
                        positionText(*explanation.nearest) + ", " + metresText(nearest->distance) +
                        " from the goal";
  }

  const CostGrid& costs_;
  const PlannerOptions& options_;
  const PoseRequest& request_;
  const StopToken& stop_;
};

}  // namespace

Explanation explainFailure(PathPlanner& planner, const PoseRequest& request, Status status,
                           const StopToken& stop) {
  if (status != Status::UNREACHABLE && status != Status::GOAL_OCCUPIED) return {};
  if (!planner.hasMap() || planner.map()->geometry().size() > kMostExplained) return {};
  const auto costs = planner.fullResolutionCosts(stop);
  const GridGeometry& geometry = costs->geometry();
  const auto near = nearestCell(geometry, placeOf(request.start), 2.0 * geometry.resolution(),
                                [&](Cell cell) { return costs->passable(cell); });
  const auto goal = geometry.cellAt(placeOf(request.goal));
  if (!near || !goal) return {};
  const Cell start = near->cell;
  // What hinders a footprint, and no disc of its inscribed radius, the plan's message says.
  if (!planner.options().footprint.empty() &&
      reachableFrom(*costs, start, stop)[geometry.index(*goal).value()] != 0)
    return {};
  return Explainer(*costs, planner.searchedOptions(), request, stop).explain(start, *goal, status);
}

}  // namespace grid_path_planner::planning
