#include "avoidance/steering/flown_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grid_path_planner::avoidance {

using Eigen::Vector3d;

namespace {

constexpr double kPassed = 0.25;    // m, within which a corner counts as passed
constexpr double kBeside = 1.0;     // m, within which one beside the vehicle does
constexpr double kClearStep = 0.1;  // m
constexpr double kBeyond = 3.0;     // m of the route beyond the end

}  // namespace

void FlownPath::set(std::vector<Vector3d> points, std::optional<Vector3d> beyond) {
  points_ = std::move(points);
  beyond_ = std::move(beyond);
  ++revision_;
}

void FlownPath::clear() {
  if (!points_.empty()) ++revision_;
  points_.clear();
}

void FlownPath::advance(const Vector3d& vehicle) {
  if (points_.empty()) return;
  points_.front() = vehicle;
  while (points_.size() > 2) {
    const Vector3d off = vehicle - points_[1];
    const bool beside = (points_[2] - points_[1]).dot(off) > 0.0 && off.norm() < kBeside;
    if (off.norm() > kPassed && !beside) return;
    points_.erase(points_.begin() + 1);
  }
}

Vector3d FlownPath::ahead(double metres) const {
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const Vector3d edge = points_[i + 1] - points_[i];
    const double length = edge.norm();
    if (metres <= length && length > 0.0) return points_[i] + edge * (metres / length);
    metres -= length;
  }
  if (!beyond_) return points_.back();
  const Vector3d edge = *beyond_ - points_.back();
  const double length = std::max(1e-9, edge.norm());
  return points_.back() + edge * (std::min({metres, kBeyond, length}) / length);
}

FlownPath::Clear FlownPath::clear(const KeptRoom& room, double longest) const {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < points_.size(); ++i)
    length += (points_[i + 1] - points_[i]).norm();
  if (beyond_) length += std::min(kBeyond, (*beyond_ - points_.back()).norm());
  const double end = std::min(length, longest);
  const int samples = std::max(1, static_cast<int>(std::ceil(end / kClearStep)));
  const auto metres_at = [&](int i) { return end * i / samples; };
  const auto closed = firstClosed(room, samples, [&](int i) { return ahead(metres_at(i)); });
  if (!closed) return {end, std::nullopt};
  return {*closed > 0 ? metres_at(*closed - 1) : 0.0, ahead(metres_at(*closed))};
}

}  // namespace grid_path_planner::avoidance
