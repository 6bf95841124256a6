// clearanceOf() of metrics.h.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "grid_path_planner/path/metrics.h"
#include "path/segment.h"
#include "path/straight_runs.h"

namespace grid_path_planner::path {

using grid::GridGeometry, grid::Occupancy, grid::OccupancyGrid, grid::OccupancyThresholds;

namespace {

constexpr double kNoObstacle = std::numeric_limits<double>::infinity();
constexpr double kFirstReach = 32.0;  // cells
constexpr double kSlack = 1e-6;       // cells, above all rounding

class OccupiedCells {
 public:
  OccupiedCells(const OccupancyGrid& map, const OccupancyThresholds& thresholds)
      : map_(map), thresholds_(thresholds) {
    const int least = std::clamp(thresholds.occupied_min, 0, 127);
    carry_ = kOnes * static_cast<std::uint64_t>(128 - std::max(least, 1));
    any_ = least == 0;
  }

  // In cells, `limit` where none is nearer.
  double distanceTo(const Segment& segment, double limit) const {
    double least = limit;
    const auto lowerInRow = [&](int row, const CellSpan& columns) {
      for (int column = nextIn(row, columns.first, columns.end); column < columns.end;
           column = nextIn(row, column + 1, columns.end)) {
        const Eigen::Vector2d corner(column, row);
        const Box square{corner, corner + Eigen::Vector2d(1.0, 1.0)};
        least = std::min(least, distanceBetween(segment, square));
      }
    };
    forEachRowInReach(segment, limit + kSlack, map_.width(), map_.height(), lowerInRow);
    return least;
  }

  // The same of a point: row after row to both sides of it, as far as one can be nearer.
  double distanceTo(const Eigen::Vector2d& point, double limit) const {
    const auto start =
        static_cast<int>(std::floor(std::min(std::max(point.y(), 0.0), map_.height() - 1.0)));
    double least = limit;
    const auto isNearer = [&](int row) {
      return row >= 0 && row < map_.height() && row - point.y() < least &&
             point.y() - (row + 1) < least;
    };
    for (int below = start, above = start + 1; isNearer(below) || isNearer(above);
         --below, ++above) {
      if (isNearer(below)) lowerInRow(point, below, least);
      if (isNearer(above)) lowerInRow(point, above, least);
    }
    return least;
  }

 private:
  static constexpr std::uint64_t kOnes = 0x0101010101010101;
  static constexpr std::uint64_t kSigns = kOnes << 7;

  void lowerInRow(const Eigen::Vector2d& point, int row, double& least) const {
    const CellSpan columns(point.x() - least - kSlack, point.x() + least + kSlack, map_.width());
    for (int column = nextIn(row, columns.first, columns.end);
         column < columns.end && column <= point.x() + least;
         column = nextIn(row, column + 1, columns.end)) {
      if (point.x() - (column + 1) >= least) continue;
      const Eigen::Vector2d corner(column, row);
      const Box square{corner, corner + Eigen::Vector2d(1.0, 1.0)};
      least = std::min(least, distanceBetween({point, point}, square));
    }
  }

  // The first occupied column from `column` on; `end` where none is.
  int nextIn(int row, int column, int end) const {
    const std::int8_t* values = map_.row(row);
    while (column < end) {
      if (column + 8 <= end && !mayHoldAny(values + column)) {
        column += 8;
      } else if (thresholds_.classify(values[column]) == Occupancy::OCCUPIED) {
        return column;
      } else {
        ++column;
      }
    }
    return end;
  }

  // Whether one of eight cells is occupied, all looked at as one number: adding 128 - threshold to a
  // byte that is not negative sets its sign from the threshold on.
  bool mayHoldAny(const std::int8_t* cells) const {
    std::uint64_t word;
    std::memcpy(&word, cells, sizeof word);
    return any_ || (((word & ~kSigns) + carry_) & ~word & kSigns) != 0;
  }

  const OccupancyGrid& map_;
  const OccupancyThresholds& thresholds_;
  std::uint64_t carry_;
  bool any_;  // even negative numbers count as occupied
};

// The least distance of a polyline to the occupied cells. Distances change along it no faster than it
// is long, so a piece between two points whose distances are known is never nearer than half of what
// they have together more than its length (Piyavskii, 1972): only what may be nearer than the least
// one so far is looked at, in halves.
class ClearanceSearch {
 public:
  ClearanceSearch(const OccupiedCells& occupied, std::vector<Eigen::Vector2d> points)
      : occupied_(occupied), points_(std::move(points)), along_(points_.size(), 0.0) {
    for (std::size_t i = 1; i < points_.size(); ++i)
      along_[i] = along_[i - 1] + (points_[i] - points_[i - 1]).norm();
  }

  // In cells; infinity where no cell is occupied.
  double least() {
    const double first = least_ = occupied_.distanceTo(points_.front(), kNoObstacle);
    const std::size_t last = points_.size() - 1;
    if (last > 0 && least_ < kNoObstacle)
      lowerBetween(0, last, first, distanceTo(last, along_[last]));
    return least_;
  }

 private:
  // Of a point, as far as a piece of this length beside it asks for it: or some less.
  double distanceTo(std::size_t i, double length) {
    const double reach = least_ + std::min(length, std::max(least_, kFirstReach)) + kSlack;
    const double distance = occupied_.distanceTo(points_[i], reach);
    least_ = std::min(least_, distance);
    return distance;
  }

  void lowerBetween(std::size_t i, std::size_t j, double at_i, double at_j) {
    const double length = along_[j] - along_[i];
    if (0.5 * (at_i + at_j - length) >= least_ + kSlack) return;
    if (j == i + 1) {
      least_ = occupied_.distanceTo(Segment{points_[i], points_[j]}, least_);
      return;
    }
    const std::size_t middle = i + (j - i) / 2;
    const double at_middle = distanceTo(middle, 0.5 * length);
    if (at_i < at_j) {
      lowerBetween(i, middle, at_i, at_middle);
      lowerBetween(middle, j, at_middle, at_j);
    } else {
      lowerBetween(middle, j, at_middle, at_j);
      lowerBetween(i, middle, at_i, at_middle);
    }
  }

  const OccupiedCells& occupied_;
  const std::vector<Eigen::Vector2d> points_;
  std::vector<double> along_;  // the polyline, to each point
  double least_ = kNoObstacle;
};

}  // namespace

double clearanceOf(const Path& path, const OccupancyGrid& map,
                   const OccupancyThresholds& thresholds) {
  const GridGeometry& geometry = map.geometry();
  if (path.empty() || geometry.size() == 0) return kNoObstacle;
  std::vector<Eigen::Vector2d> points;
  points.reserve(path.poses.size());
  for (const Pose& pose : path.poses)
    points.push_back(geometry.gridFromWorld(pose.position.head<2>()));
  const OccupiedCells occupied(map, thresholds);
  return ClearanceSearch(occupied, withoutCollinearPoints(points, kFirstReach)).least() *
         geometry.resolution();
}

}  // namespace grid_path_planner::path
