#include "flights/sight_audit.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::flights {

using Eigen::Isometry3d, Eigen::Vector3d;
using simulation::DepthCameraOptions;

namespace {

constexpr int kCoarser = 4;
constexpr double kRangeSlack = 0.05;  // m

DepthCameraOptions coarseAndExact(DepthCameraOptions options) {
  options.width = std::max(2, options.width / kCoarser);
  options.height = std::max(2, options.height / kCoarser);
  options.noise_base = options.noise_per_m2 = options.dropout = 0.0;
  return options;
}

}  // namespace

SightAudit::SightAudit(const simulation::World& world, const DepthCameraOptions& camera,
                       double radius, const Vector3d& start, double start_clear)
    : camera_(world, coarseAndExact(camera)),
      pinhole_(camera_.intrinsics()),
      start_(start),
      start_clear_(start_clear) {
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const Vector3d direction(x, y, z);
        sphere_.push_back(direction.isZero() ? direction
                                             : Vector3d(radius * direction.normalized()));
      }
  last_seen_.resize(sphere_.size(), 0);
}

void SightAudit::see(const Isometry3d& map_from_optical) {
  camera_.render(map_from_optical, 0, points_);
  View view{map_from_optical.inverse(), std::vector<float>(points_.size() / 3)};
  const auto farthest = static_cast<float>(camera_.options().range_max);
  for (std::size_t i = 0; i < view.ranges.size(); ++i) {
    const float range = Eigen::Vector3f(&points_[3 * i]).norm();
    view.ranges[i] = std::isnan(range) ? farthest : range;
  }
  views_.push_back(std::move(view));
}

bool SightAudit::seen(const Vector3d& centre) {
  bool all = true;
  for (std::size_t i = 0; i < sphere_.size() && all; ++i)
    all = seenPoint(centre + sphere_[i], last_seen_[i]);
  return all;
}

// The view that saw the point's neighbour is tried first, then the newest ones.
bool SightAudit::seenPoint(const Vector3d& point, std::size_t& newest) const {
  if ((point - start_).norm() <= start_clear_) return true;
  if (newest < views_.size() && seenIn(views_[newest], point)) return true;
  for (std::size_t i = views_.size(); i-- > 0;)
    if (seenIn(views_[i], point)) {
      newest = i;
      return true;
    }
  return false;
}

bool SightAudit::seenIn(const View& view, const Vector3d& point) const {
  const Vector3d at = view.optical_from_map * point;
  if (at.z() <= 1e-3) return false;
  const int width = camera_.options().width, height = camera_.options().height;
  const double column = pinhole_.cx + pinhole_.fx * at.x() / at.z();
  const double row = pinhole_.cy + pinhole_.fy * at.y() / at.z();
  if (column < -0.5 || row < -0.5 || column > width - 0.5 || row > height - 0.5) return false;
  const int left = std::clamp(static_cast<int>(std::floor(column)), 0, width - 2);
  const int top = std::clamp(static_cast<int>(std::floor(row)), 0, height - 2);
  const double needed = at.norm() - kRangeSlack;
  for (const int r : {top, top + 1})
    for (const int c : {left, left + 1})
      if (static_cast<double>(view.ranges[static_cast<std::size_t>(r * width + c)]) >= needed)
        return true;
  return false;
}

}  // namespace grid_path_planner::flights
