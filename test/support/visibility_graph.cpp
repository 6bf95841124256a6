#include "support/visibility_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "grid_path_planner/costmap/line_of_sight.h"

namespace grid_path_planner::test {

using costmap::CostGrid;
using costmap::lineOfSight;
using costmap::SegmentPoint;
using costmap::waypointOf;
using grid::Cell;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kUnit = SegmentPoint::kUnitsPerCell;

// Corners of exactly one blocked cell: a taut path turns nowhere else.
void addCorners(const CostGrid& map, std::vector<SegmentPoint>& points) {
  for (int row = 0; row <= map.geometry().height(); ++row)
    for (int column = 0; column <= map.geometry().width(); ++column) {
      int blocked = 0;
      for (const Cell cell : {Cell{column, row}, Cell{column - 1, row}, Cell{column, row - 1},
                              Cell{column - 1, row - 1}})
        blocked += map.passable(cell) ? 0 : 1;
      if (blocked == 1) points.push_back({column * kUnit, row * kUnit});
    }
}

double distance(SegmentPoint a, SegmentPoint b) {
  return std::hypot(double(a.x - b.x), double(a.y - b.y)) / double(kUnit);
}

// Dijkstra from points[0] to points[1]. distance and open: of two points by number.
template <class Distance, class Open>
std::optional<double> shortestBetween(std::size_t count, const Distance& distance,
                                      const Open& open) {
  std::vector<double> lengths(count, kInfinity);
  std::vector<bool> done(count, false);
  lengths[0] = 0.0;
  for (;;) {
    std::size_t from = count;
    for (std::size_t i = 0; i < count; ++i)
      if (!done[i] && lengths[i] < kInfinity && (from == count || lengths[i] < lengths[from]))
        from = i;
    if (from == count) return std::nullopt;
    if (from == 1) return lengths[1];
    done[from] = true;
    for (std::size_t to = 0; to < count; ++to) {
      if (done[to]) continue;
      const double length = lengths[from] + distance(from, to);
      if (length < lengths[to] && open(from, to)) lengths[to] = length;
    }
  }
}

// The waypoints' coordinates along one axis, in cells.
std::vector<double> coordinates(int count, int kernel, int original) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) {
    const double middle = 0.5 * (i * kernel + std::min((i + 1) * kernel, original)) / kernel;
    all.push_back(std::round(middle * double(kUnit)) / double(kUnit));
  }
  return all;
}

struct Lattice {
  explicit Lattice(const CostGrid& of)
      : map(of),
        columns(coordinates(of.geometry().width(), of.kernel(), of.original().width())),
        rows(coordinates(of.geometry().height(), of.kernel(), of.original().height())) {}

  const CostGrid& map;
  std::vector<double> columns;
  std::vector<double> rows;
};

constexpr double kRounding = 1e-7;

// The numbers of the points on either side of a coordinate; the same twice on a line of points.
std::pair<int, int> neighbours(const std::vector<double>& lines, double at) {
  const auto past = std::upper_bound(lines.begin(), lines.end(), at + kRounding);
  const auto first = std::lower_bound(lines.begin(), lines.end(), at - kRounding);
  return {static_cast<int>(past - lines.begin()) - 1,
          first == lines.end() ? -1 : static_cast<int>(first - lines.begin())};
}

bool holds(const Lattice& lattice, const Eigen::Vector2d& point) {
  const auto [left, right] = neighbours(lattice.columns, point.x());
  const auto [lower, upper] = neighbours(lattice.rows, point.y());
  if (right < 0 || upper < 0) return false;
  const CostGrid& map = lattice.map;
  return map.passable({left, lower}) && map.passable({left, upper}) &&
         map.passable({right, lower}) && map.passable({right, upper});
}

void cutAt(const std::vector<double>& lines, double from, double to, std::vector<double>& cuts) {
  for (const double line : lines)
    if ((line - from) * (line - to) < 0.0) cuts.push_back((line - from) / (to - from));
}

bool holds(const Lattice& lattice, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  if (!holds(lattice, from) || !holds(lattice, to)) return false;
  std::vector<double> cuts = {0.0, 1.0};
  cutAt(lattice.columns, from.x(), to.x(), cuts);
  cutAt(lattice.rows, from.y(), to.y(), cuts);
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (cuts[i] - cuts[i - 1] < 1e-9) continue;
    const double middle = 0.5 * (cuts[i - 1] + cuts[i]);
    if (!holds(lattice, from + middle * (to - from))) return false;
  }
  return true;
}

// Where a path may turn: not in the midst of four squares.
bool turningPoint(const CostGrid& map, Cell cell) {
  for (int row = -1; row <= 1; ++row)
    for (int column = -1; column <= 1; ++column)
      if (!map.passable({cell.column + column, cell.row + row})) return true;
  return false;
}

}  // namespace

std::optional<double> shortestAnyAngle(const CostGrid& map, Cell start, Cell goal) {
  if (start == goal) return 0.0;
  std::vector<SegmentPoint> points = {waypointOf(map, start), waypointOf(map, goal)};
  addCorners(map, points);
  return shortestBetween(
      points.size(), [&](auto a, auto b) { return distance(points[a], points[b]); },
      [&](auto a, auto b) { return lineOfSight(map, points[a], points[b]); });
}

bool inLattice(const CostGrid& map, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return holds(Lattice(map), from, to);
}

std::optional<double> shortestInLattice(const CostGrid& map, Cell start, Cell goal) {
  if (start == goal) return 0.0;
  const Lattice lattice(map);
  std::vector<Eigen::Vector2d> points;
  const auto add = [&](Cell cell) {
    points.emplace_back(lattice.columns[cell.column], lattice.rows[cell.row]);
  };
  add(start);
  add(goal);
  for (int row = 0; row < map.geometry().height(); ++row)
    for (int column = 0; column < map.geometry().width(); ++column)
      if (map.passable({column, row}) && turningPoint(map, {column, row})) add({column, row});
  return shortestBetween(
      points.size(), [&](auto a, auto b) { return (points[a] - points[b]).norm(); },
      [&](auto a, auto b) { return holds(lattice, points[a], points[b]); });
}

}  // namespace grid_path_planner::test
