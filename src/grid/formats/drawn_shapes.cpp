#include "grid/formats/drawn_shapes.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::grid {

using base::ReadLimits;
using Eigen::Vector2d;

namespace {

constexpr std::int8_t kDrawn = 100;
constexpr std::uint32_t kRowsBetweenQuestions = 16;

double crossProduct(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double distanceToSegment(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  const Vector2d along = to - from;
  const double length = along.squaredNorm();
  const double share =
      length > 0.0 ? std::clamp((point - from).dot(along) / length, 0.0, 1.0) : 0.0;
  return (point - from - share * along).norm();
}

bool between(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  return (point - from).dot(point - to) <= 0.0;
}

// Where a line from `from` to `to` is at the height y, which is cut to its ends.
double columnAt(double y, const Vector2d& from, const Vector2d& to) {
  const double share = std::clamp((y - from.y()) / (to.y() - from.y()), 0.0, 1.0);
  return from.x() + share * (to.x() - from.x());
}

}  // namespace

// Cells of the map, with all whose centres may lie in an obstacle; empty where it lies elsewhere.
class Canvas::Box {
 public:
  int first_column, end_column, first_row, end_row;

  int width() const { return std::max(0, end_column - first_column); }
  int height() const { return std::max(0, end_row - first_row); }
};

Canvas::Canvas(OccupancyGrid& map, double resolution, const std::string& file, ReadLimits& limits)
    : map_(map),
      resolution_(resolution),
      file_(file),
      limits_(limits),
      poll_(limits, file, kRowsBetweenQuestions) {}

Canvas::Box Canvas::boxAround(const std::vector<Vector2d>& points, double reach) const {
  Vector2d low = points.front(), high = points.front();
  for (const Vector2d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const auto cell = [this](double metres, int most) {
    return static_cast<int>(std::clamp(std::floor(metres / resolution_), 0.0, double(most)));
  };
  return {cell(low.x() - reach, map_.width()), 1 + cell(high.x() + reach, map_.width() - 1),
          cell(low.y() - reach, map_.height()), 1 + cell(high.y() + reach, map_.height() - 1)};
}

Vector2d Canvas::centreOf(int column, int row) const {
  return resolution_ * Vector2d(column + 0.5, row + 0.5);
}

// The first column of the row whose centre `holds` is false of, where all before it are true.
template <class Holds>
int Canvas::firstColumnNot(const Box& box, int row, const Holds& holds) const {
  int first = box.first_column, end = box.end_column;
  while (first < end) {
    const int middle = first + (end - first) / 2;
    if (holds(centreOf(middle, row)))
      first = middle + 1;
    else
      end = middle;
  }
  return first;
}

// Its crossings, a bit behind the last cell to its left in each row, and the centres that lie on it.
void Canvas::addEdge(const Vector2d& from, const Vector2d& to, const Box& box,
                     std::vector<bool>& toggles) {
  if (from.y() == to.y()) return addLevelEdge(from, to, box);
  const bool up = to.y() > from.y();
  const auto side = [&](const Vector2d& point) { return crossProduct(to - from, point - from); };
  const Box rows = boxAround({from, to}, resolution_);
  const auto stride = static_cast<std::size_t>(box.width()) + 1;
  for (int row = rows.first_row; row < rows.end_row; ++row) {
    poll_();
    const double y = centreOf(0, row).y();
    if (row < box.first_row || row >= box.end_row) continue;
    const int left = firstColumnNot(box, row, [&](const Vector2d& point) {
      return up ? side(point) > 0.0 : side(point) < 0.0;
    });
    int right = left;
    for (; right < box.end_column && side(centreOf(right, row)) == 0.0; ++right)
      if (between(centreOf(right, row), from, to)) map_[{right, row}] = kDrawn;
    if ((from.y() > y) == (to.y() > y)) continue;
    const auto at = static_cast<std::size_t>(row - box.first_row) * stride +
                    static_cast<std::size_t>((up ? left : right) - box.first_column);
    toggles[at] = !toggles[at];
  }
}

void Canvas::addLevelEdge(const Vector2d& from, const Vector2d& to, const Box& box) {
  const Box cells = boxAround({from, to}, resolution_);
  for (int row = std::max(cells.first_row, box.first_row);
       row < std::min(cells.end_row, box.end_row); ++row) {
    poll_();
    if (centreOf(0, row).y() != from.y()) continue;
    for (int column = std::max(cells.first_column, box.first_column);
         column < std::min(cells.end_column, box.end_column); ++column)
      if (between(centreOf(column, row), from, to)) map_[{column, row}] = kDrawn;
  }
}

// A cell is inside where an odd number of edges crosses its row behind it. Of a row the crossings
// to the right of the box are at its end.
void Canvas::drawPolygon(const std::vector<Vector2d>& corners) {
  const Box box = boxAround(corners, 0.0);
  if (box.width() == 0 || box.height() == 0) return;
  const auto stride = static_cast<std::size_t>(box.width()) + 1;
  limits_.check(file_, stride * static_cast<std::size_t>(box.height()) / 8);
  std::vector<bool> toggles(stride * static_cast<std::size_t>(box.height()));
  for (std::size_t i = 0, before = corners.size() - 1; i < corners.size(); before = i++)
    addEdge(corners[before], corners[i], box, toggles);
  for (int row = box.first_row; row < box.end_row; ++row) {
    poll_();
    const std::size_t begin = static_cast<std::size_t>(row - box.first_row) * stride;
    bool inside = false;
    for (int column = box.end_column; column-- > box.first_column;) {
      inside = inside != toggles[begin + static_cast<std::size_t>(column - box.first_column) + 1];
      if (inside) map_[{column, row}] = kDrawn;
    }
  }
}

void Canvas::drawCircle(const Vector2d& centre, double radius) {
  const Box box = boxAround({centre}, radius);
  const auto holds = [&](const Vector2d& point) { return (point - centre).norm() <= radius; };
  for (int row = box.first_row; row < box.end_row; ++row) {
    poll_();
    const int begin = firstColumnNot(
        box, row, [&](const Vector2d& point) { return point.x() < centre.x() && !holds(point); });
    const int end = firstColumnNot(
        box, row, [&](const Vector2d& point) { return point.x() < centre.x() || holds(point); });
    if (begin < end) std::fill(map_.row(row) + begin, map_.row(row) + end, kDrawn);
  }
}

// Of a row only the columns are looked at that the part of the line near it may reach.
void Canvas::drawSegment(const Vector2d& from, const Vector2d& to, double reach) {
  const Box box = boxAround({from, to}, reach);
  for (int row = box.first_row; row < box.end_row; ++row) {
    poll_();
    Box part = box;
    if (from.y() != to.y()) {
      const double y = centreOf(0, row).y(), margin = reach + resolution_;
      part = boxAround({{columnAt(y - margin, from, to), y}, {columnAt(y + margin, from, to), y}},
                       margin);
    }
    for (int column = std::max(part.first_column, box.first_column);
         column < std::min(part.end_column, box.end_column); ++column)
      if (distanceToSegment(centreOf(column, row), from, to) <= reach) map_[{column, row}] = kDrawn;
  }
}

void Canvas::drawWall(const std::vector<Vector2d>& points, double reach) {
  for (std::size_t i = 1; i < points.size(); ++i) drawSegment(points[i - 1], points[i], reach);
}

}  // namespace grid_path_planner::grid
