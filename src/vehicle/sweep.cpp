#include "vehicle/sweep.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grid_path_planner::vehicle {

using base::StopPoll, base::StopToken;
using Eigen::Vector2d;
using grid::Cell, grid::CellRect, grid::GridGeometry, grid::RowSpan;

namespace {

// As inflation allows for resolutions that are 32-bit floats.
constexpr double kShrunk = 1.0 - 1e-7;
// In cells: how far an arc of a turn on the spot leaves its chord, and what the hulls of an edge's two places hold
// too much while the vehicle drives and turns at once.
constexpr double kArc = 0.01, kHull = 0.02;
// Of a circumscribed radius: how far one step drives.
constexpr double kStride = 1.0;

// The convex hull, anticlockwise (Andrew's monotone chain, 1979).
std::vector<Vector2d> hullOf(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vector2d> hull;
  const auto add = [&hull](const Vector2d& point, std::size_t least) {
    const auto turnsLeft = [&] {
      const Vector2d a = hull.back() - hull[hull.size() - 2], b = point - hull.back();
      return a.x() * b.y() - a.y() * b.x() > 0.0;
    };
    while (hull.size() > least && !turnsLeft()) hull.pop_back();
    hull.push_back(point);
  };
  for (const Vector2d& point : points) add(point, 1);
  const std::size_t lower = hull.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  return hull;
}

// The rectangle of cells around points, in the map and the ring of cells about it: what reaches farther out is met in
// the ring, since the vehicle's origin is in the map.
CellRect around(const std::vector<Vector2d>& points, double margin, const GridGeometry& geometry) {
  Vector2d low = points.front(), high = points.front();
  for (const Vector2d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const auto index = [](double at, int size) {
    return static_cast<int>(std::floor(std::clamp(at, -1.0, size + 0.5)));
  };
  const int left = index(low.x() - margin, geometry.width());
  const int bottom = index(low.y() - margin, geometry.height());
  return {left, bottom, index(high.x() + margin, geometry.width()) - left + 1,
          index(high.y() + margin, geometry.height()) - bottom + 1};
}

}  // namespace

// The places of all points before and after a step.
struct FootprintSweep::Step {
  Points from;
  Points to;
  double arc = 0.0;  // cells, by which arcs may leave their chords
};

FootprintSweep::FootprintSweep(const Footprint& footprint, const GridGeometry& geometry,
                               FootprintObstacles obstacles)
    : geometry_(geometry), obstacles_(std::move(obstacles)) {
  const std::vector<Vector2d>& corners = footprint.corners();
  const double scale = kShrunk / geometry.resolution();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d a = corners[i] * scale, b = corners[(i + 1) % corners.size()] * scale;
    points_.push_back(a);
    const double share = -a.dot(b - a) / (b - a).squaredNorm();
    if (share > 0.0 && share < 1.0) points_.push_back(a + share * (b - a));
  }
  reach_ = footprint.circumscribedRadius() * scale;
}

// An arc of the angle t leaves its chord by less than r t^2 / 8. The hull of an edge of length l that turns about a
// point of itself while it is shifted holds l t / 4 too much at most.
int FootprintSweep::stepsOf(const Motion& motion) const {
  double longest = std::sqrt(8.0 * kArc / reach_);
  if (!motion.onTheSpot()) longest = std::min(longest, 2.0 * kHull / reach_);
  const double driven = (motion.to - motion.from).norm() / geometry_.resolution();
  const double stride = std::max(1.0, kStride * reach_);
  constexpr double kMost = 1e9;
  return static_cast<int>(std::min(
      kMost, std::ceil(std::max({1.0, std::abs(motion.turn) / longest, driven / stride}))));
}

FootprintSweep::Points FootprintSweep::placed(const Vector2d& position, double yaw) const {
  const Vector2d at = geometry_.gridFromWorld(position);
  const double turned = yaw - geometry_.origin().yaw;
  const double cosine = std::cos(turned), sine = std::sin(turned);
  Points points;
  points.reserve(points_.size());
  for (const Vector2d& point : points_)
    points.emplace_back(at.x() + cosine * point.x() - sine * point.y(),
                        at.y() + sine * point.x() + cosine * point.y());
  return points;
}

std::optional<Cell> FootprintSweep::firstOf(const RowSpan& span) const {
  const bool row_inside = span.row >= 0 && span.row < geometry_.height();
  const int first = row_inside ? std::clamp(span.first, 0, geometry_.width()) : span.end;
  const int end = row_inside ? std::clamp(span.end, first, geometry_.width()) : span.end;
  if (obstacles_.outside && first > span.first) return Cell{span.first, span.row};
  if (row_inside && first < end) {
    const int column = obstacles_.first({span.row, first, end});
    if (column < end) return Cell{column, span.row};
  }
  if (obstacles_.outside && end < span.end) return Cell{end, span.row};
  return std::nullopt;
}

std::optional<Cell> FootprintSweep::meets(const Points& polygon) const {
  for (const RowSpan& span : touchedCells(polygon, around(polygon, 0.0, geometry_)))
    if (const auto cell = firstOf(span)) return cell;
  return std::nullopt;
}

std::optional<Cell> FootprintSweep::meets(const Step& step) const {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::size_t next = (i + 1) % points_.size();
    Points places = {step.from[i], step.from[next], step.to[i], step.to[next]};
    if (step.arc > 0.0) {
      Points grown;
      for (const Vector2d& place : places)
        for (const double x : {-step.arc, step.arc})
          for (const double y : {-step.arc, step.arc}) grown.push_back(place + Vector2d(x, y));
      places = std::move(grown);
    }
    if (const auto cell = meets(hullOf(std::move(places)))) return cell;
  }
  return std::nullopt;
}

// Whether nothing at all is near: mostly so, and quickly seen.
bool FootprintSweep::clear(const Points& points, double margin) const {
  const CellRect rect = around(points, margin, geometry_);
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    if (firstOf({row, rect.column, rect.column + rect.width})) return false;
  return true;
}

std::optional<Cell> FootprintSweep::standing(const Vector2d& position, double yaw) const {
  return meets(placed(position, yaw));
}

// Calls found(contact) at the first step of each stretch that meets a cell until it returns true.
template <class Found>
void FootprintSweep::visit(const Motion& motion, const StopToken& stop, Found&& found) const {
  const int steps = stepsOf(motion);
  const double share = 1.0 / steps;
  const double turn = motion.turn * share;
  const auto positionAt = [&](int step) -> Vector2d {
    return step == steps ? motion.to : motion.from + share * step * (motion.to - motion.from);
  };
  StopPoll poll(stop, 64);
  Step step;
  step.arc = reach_ * turn * turn / 8.0;
  step.to = placed(motion.from, motion.yaw);
  const auto tell = [&](int i, Cell cell) {
    return found(FootprintContact{positionAt(i), motion.yaw + turn * i, cell, motion.pose,
                                  motion.onTheSpot()});
  };
  if (const auto cell = meets(step.to))
    if (tell(0, *cell)) return;
  if (motion.onTheSpot() && motion.turn == 0.0) return;
  for (int i = 0; i < steps; ++i) {
    poll();
    std::swap(step.from, step.to);
    step.to = placed(positionAt(i + 1), motion.yaw + turn * (i + 1));
    Points both = step.from;
    both.insert(both.end(), step.to.begin(), step.to.end());
    if (clear(both, step.arc)) continue;
    const auto cell = meets(step);
    if (cell && tell(i + 1, *cell)) return;
  }
}

std::optional<FootprintContact> FootprintSweep::first(const Motion& motion,
                                                      const StopToken& stop) const {
  std::optional<FootprintContact> first;
  visit(motion, stop, [&](const FootprintContact& contact) {
    first = contact;
    return true;
  });
  return first;
}

std::vector<FootprintContact> FootprintSweep::all(const Motion& motion,
                                                  const StopToken& stop) const {
  std::vector<FootprintContact> all;
  visit(motion, stop, [&](const FootprintContact& contact) {
    all.push_back(contact);
    return motion.onTheSpot();
  });
  return all;
}

}  // namespace grid_path_planner::vehicle
