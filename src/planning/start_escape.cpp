#include "planning/start_escape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "grid/segment.h"
#include "grid_path_planner/path/metrics.h"
#include "planning/end_segments.h"
#include "planning/message_text.h"

namespace grid_path_planner::planning {

using base::StopPoll, base::StopToken;
using costmap::CostGrid, costmap::KeptDistances;
using grid::Box, grid::Cell, grid::CellSpan, grid::clipped, grid::forEachRowInReach,
    grid::GridGeometry, grid::Occupancy, grid::Segment;
using path::distanceToClass;

namespace {

// In cells: a line that is that near to a cell touches it.
constexpr double kTouched = 1e-6;
constexpr double kJoined = 1e-9;
// Of a place where a line leaves cells, in cells: what a rim is along a line that leaves them at a small angle.
constexpr double kExitSlack = 1e-5;
// Cells of a line that are measured together: most lines that are none of these meet something near the start.
constexpr double kMeasuredTogether = 8.0;

Box squareOf(Cell cell, double rim) {
  const Eigen::Vector2d corner(cell.column, cell.row), one(1.0, 1.0), around(rim, rim);
  return {corner - around, corner + one + around};
}

}  // namespace

StartEscape::StartEscape(const CostGrid& costs, const KeptDistances& kept,
                         const Eigen::Vector2d& start, double longest, const StopToken& stop)
    : costs_(costs), start_(start), from_(costs.geometry().gridFromWorld(start)) {
  add(Occupancy::OCCUPIED, kept.occupied);
  add(Occupancy::UNKNOWN, kept.unknown);
  const double to_border = EndSegments(costs).toBorder(start);
  border_lowered_ = to_border < kept.outside;
  border_ = std::min(to_border, kept.outside);
  const auto isLeft = [](const Obstacles& obstacles) { return obstacles.left; };
  if (std::any_of(obstacles_.begin(), obstacles_.end(), isLeft))
    findExits(longest / costs.geometry().resolution(), stop);
}

void StartEscape::add(Occupancy occupancy, double kept) {
  if (kept < 0.0) return;
  const double resolution = costs_.geometry().resolution();
  const double distance =
      distanceToClass(costs_.classes(), occupancy, start_, start_, kept + resolution);
  const bool left = costs_.occupancy(*costs_.geometry().cellAt(start_)) == occupancy;
  const bool touches = left || distance <= kTouched * resolution;
  obstacles_.push_back(
      {occupancy, touches ? 0.0 : std::min(distance, kept), touches || distance < kept, left});
}

bool StartEscape::open(Cell cell) const {
  return std::none_of(obstacles_.begin(), obstacles_.end(), [&](const Obstacles& obstacles) {
    return costs_.occupancy(cell) == obstacles.occupancy;
  });
}

// From the start's row outwards, as far as an open cell may be nearer than those that were found.
void StartEscape::findExits(double longest, const StopToken& stop) {
  const GridGeometry& geometry = costs_.geometry();
  const Cell own = *geometry.cellAt(start_);
  StopPoll poll(stop, 64);
  depth_ = longest;
  const auto lookInRow = [&](int row) {
    if (row < 0 || row >= geometry.height()) return;
    poll();
    const CellSpan columns(from_.x() - depth_ - 1.0, from_.x() + depth_ + 1.0, geometry.width());
    for (int column = columns.first; column < columns.end; ++column) {
      if (!open({column, row})) continue;
      const Box square = squareOf({column, row}, 0.0);
      const Eigen::Vector2d point = from_.cwiseMax(square.low).cwiseMin(square.high);
      const double distance = (point - from_).norm();
      if (distance > depth_ + kTouched) continue;
      if (distance < depth_ - kTouched) exits_.clear();
      depth_ = std::min(depth_, distance);
      exits_.push_back(point);
    }
  };
  for (int away = 0; away <= std::min<double>(depth_ + 1.0, geometry.height()); ++away) {
    lookInRow(own.row - away);
    if (away > 0) lookInRow(own.row + away);
  }
}

bool StartEscape::leads(const Eigen::Vector2d& to) const {
  // Inside the map a line is nowhere nearer to the border than at its ends.
  if (!atLeast(EndSegments(costs_).toBorder(to), border_)) return false;
  return std::all_of(obstacles_.begin(), obstacles_.end(), [&](const Obstacles& obstacles) {
    return obstacles.least > 0.0 ? keeps(obstacles, to) : leaves(obstacles, to);
  });
}

bool StartEscape::keeps(const Obstacles& from, const Eigen::Vector2d& to) const {
  const Eigen::Vector2d line = to - start_;
  const double resolution = costs_.geometry().resolution();
  const int pieces = 1 + static_cast<int>(line.norm() / (kMeasuredTogether * resolution));
  for (int i = 0; i < pieces; ++i) {
    const Eigen::Vector2d a = start_ + line * i / pieces, b = start_ + line * (i + 1) / pieces;
    if (!atLeast(distanceToClass(costs_.classes(), from.occupancy, a, b, from.least), from.least))
      return false;
  }
  return true;
}

bool StartEscape::leaves(const Obstacles& obstacles, const Eigen::Vector2d& to) const {
  const GridGeometry& geometry = costs_.geometry();
  const Eigen::Vector2d line = geometry.gridFromWorld(to) - from_;
  const double length = line.norm();
  if (length <= 0.0) return false;
  const Eigen::Vector2d along = line / length;
  const double exit = exitFrom(obstacles, along, length);
  const Eigen::Vector2d at = from_ + exit * along;
  if (!obstacles.left && exit > kExitSlack) return false;
  if (obstacles.left && std::none_of(exits_.begin(), exits_.end(), [&](const auto& nearest) {
        return (at - nearest).norm() <= depth_ + kExitSlack;
      }))
    return false;
  const double rest = std::min(length, exit + kTouched);
  return distanceToClass(costs_.classes(), obstacles.occupancy,
                         geometry.worldFromGrid(from_ + rest * along), to, geometry.resolution(),
                         -kTouched) > 0.0;
}

// How far the line from the start goes through cells of the class before it leaves them first, in cells; no
// more of it is looked at than may do so.
double StartEscape::exitFrom(const Obstacles& obstacles, const Eigen::Vector2d& along,
                             double length) const {
  const GridGeometry& geometry = costs_.geometry();
  const double farthest = obstacles.left ? 2.0 * depth_ : 0.0;
  const Segment line{from_, from_ + std::min(length, farthest + 1.0) * along};
  std::vector<std::pair<double, double>> inside;
  const auto addOfRow = [&](int row, const CellSpan& columns) {
    for (int column = columns.first; column < columns.end; ++column) {
      if (costs_.occupancy({column, row}) != obstacles.occupancy) continue;
      if (const auto part = clipped(line, squareOf({column, row}, kTouched)))
        inside.emplace_back((part->from - from_).dot(along), (part->to - from_).dot(along));
    }
  };
  forEachRowInReach(line, kTouched, geometry.width(), geometry.height(), addOfRow);
  std::sort(inside.begin(), inside.end());
  double exit = 0.0;
  for (const auto& [begin, end] : inside) {
    if (begin > exit + kJoined) break;
    exit = std::max(exit, end);
  }
  return exit;
}

std::string StartEscape::text() const {
  std::string distances, out;
  const auto add = [](std::string& text, const std::string& more) {
    text += (text.empty() ? "" : " and ") + more;
  };
  for (const Obstacles& obstacles : obstacles_) {
    const bool occupied = obstacles.occupancy == Occupancy::OCCUPIED;
    if (obstacles.left)
      add(out, std::string("leaves the ") + (occupied ? "occupied" : "unknown") +
                   " cells by the nearest edge and touches none again");
    else if (obstacles.lowered)
      add(distances, metresText(obstacles.least) +
                         (occupied ? " to an occupied cell" : " to an unknown cell"));
  }
  if (border_lowered_) add(distances, metresText(border_) + " to the border of the map");
  if (!distances.empty()) add(out, "comes no nearer than " + distances);
  return out;
}

}  // namespace grid_path_planner::planning
