#include "path/zigzags.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace grid_path_planner::path {

using base::StopPoll, base::StopToken;
using costmap::CostGrid, costmap::lineCostWithin, costmap::SegmentPoint;
using Eigen::Vector2d;

namespace {

constexpr double kDeviation = 1.0;  // of points from the line, in cells
constexpr double kHidden = 1.0;     // cost that a cell of the line's length may be worth more
constexpr double kToAndFro = 0.5;   // rad that a run turned and turned back at least
// Points of a run: time grows with the path's points times this.
constexpr std::size_t kLongest = 256;

double angleBetween(const Vector2d& a, const Vector2d& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

class StraightRuns {
 public:
  StraightRuns(const CostGrid& map, const std::vector<SegmentPoint>& points,
               const std::vector<std::size_t>& kept, const StopToken& stop)
      : map_(map), poll_(stop, 256), costs_(1, 0.0), turned_(1, 0.0), net_(1, 0.0) {
    for (const std::size_t i : kept) points_.push_back(points[i]);
    for (std::size_t i = 1; i < points_.size(); ++i) {
      costs_.push_back(costs_.back() + costmap::lineCost(map, points_[i - 1], points_[i]));
      const bool inner = i + 1 < points_.size();
      const double angle = inner ? angleBetween(between(i - 1, i), between(i, i + 1)) : 0.0;
      turned_.push_back(turned_.back() + std::abs(angle));
      net_.push_back(net_.back() + angle);
      poll_();
    }
  }

  // Numbers of points.
  std::vector<std::size_t> ends() {
    std::vector<std::size_t> ends = {0};
    while (ends.back() + 1 < points_.size()) ends.push_back(endOfRun(ends.back()));
    return ends;
  }

 private:
  std::size_t endOfRun(std::size_t first) {
    for (std::size_t end = straightUntil(first); end > first + 2; end -= (end - first + 1) / 2)
      if (isZigzag(first, end) && affordable(first, end) && nearLine(first, end)) return end;
    return first + 1;
  }

  // The last point to which those in between are near the line, by steps that double, then bisection.
  std::size_t straightUntil(std::size_t first) {
    const std::size_t limit = std::min(points_.size(), first + kLongest + 1);
    std::size_t good = first + 1, step = 2;
    for (; first + step < limit && nearLine(first, first + step); step *= 2) good = first + step;
    std::size_t bad = std::min(first + step, limit);
    while (bad - good > 1) {
      const std::size_t middle = good + (bad - good) / 2;
      (nearLine(first, middle) ? good : bad) = middle;
    }
    return good;
  }

  bool nearLine(std::size_t first, std::size_t last) {
    const Vector2d line = between(first, last), along = line.normalized();
    for (std::size_t i = first + 1; i < last; ++i) {
      poll_();
      const Vector2d to = between(first, i);
      const double foot = std::clamp(along.dot(to), 0.0, line.norm());
      if ((to - foot * along).norm() > kDeviation) return false;
    }
    return true;
  }

  bool isZigzag(std::size_t first, std::size_t last) const {
    const double turned = turned_[last - 1] - turned_[first];
    return turned - std::abs(net_[last - 1] - net_[first]) > kToAndFro;
  }

  bool affordable(std::size_t first, std::size_t last) {
    poll_();
    const double limit = costs_[last] - costs_[first] + kHidden * between(first, last).norm();
    return lineCostWithin(map_, nullptr, points_[first], points_[last], limit).has_value();
  }

  // In cells.
  Vector2d between(std::size_t from, std::size_t to) const {
    return Vector2d(points_[to].x - points_[from].x, points_[to].y - points_[from].y) /
           SegmentPoint::kUnitsPerCell;
  }

  const CostGrid& map_;
  std::vector<SegmentPoint> points_;
  StopPoll poll_;
  std::vector<double> costs_;         // of the polyline up to each point
  std::vector<double> turned_, net_;  // rad, up to each point and at it, without and with sign
};

}  // namespace

SmoothPath withoutZigzags(const CostGrid& map, const std::vector<SegmentPoint>& points,
                          SmoothPath path, const StopToken& stop) {
  if (map.uniform() || std::isinf(path.cost)) return path;
  StraightRuns runs(map, points, path.kept, stop);
  SmoothPath calm;
  for (const std::size_t end : runs.ends()) calm.kept.push_back(path.kept[end]);
  for (std::size_t i = 1; i < calm.kept.size(); ++i)
    calm.cost += costmap::lineCost(map, points[calm.kept[i - 1]], points[calm.kept[i]]);
  return calm;
}

}  // namespace grid_path_planner::path
