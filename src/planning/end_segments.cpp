#include "planning/end_segments.h"

#include <algorithm>
#include <cmath>

#include "grid_path_planner/path/metrics.h"

namespace grid_path_planner::planning {

using costmap::KeptDistances;
using grid::Occupancy;
using path::distanceToClass;

namespace {

constexpr double kRelativeSlack = 1e-7;
constexpr double kSlack = 1e-9;  // m
// In cells: a line that is no deeper in a cell than this does not enter it.
constexpr double kRim = 1e-6;

}  // namespace

bool atLeast(double distance, double least) {
  return distance >= least * (1.0 - kRelativeSlack) - kSlack;
}

double EndSegments::toBorder(const Eigen::Vector2d& point) const {
  const grid::GridGeometry& geometry = costs_.geometry();
  const Eigen::Vector2d at = geometry.gridFromWorld(point);
  return geometry.resolution() *
         std::min({at.x(), at.y(), geometry.width() - at.x(), geometry.height() - at.y()});
}

KeptDistances EndSegments::at(const Eigen::Vector2d& point) const {
  KeptDistances own = kept_;
  const auto lower = [](double& kept, double distance) {
    if (!atLeast(distance, kept)) kept = distance;
  };
  const auto measure = [&](Occupancy wanted, double& kept) {
    if (kept > 0.0) lower(kept, distanceToClass(costs_.classes(), wanted, point, point, kept));
  };
  measure(Occupancy::OCCUPIED, own.occupied);
  measure(Occupancy::UNKNOWN, own.unknown);
  lower(own.outside, std::max(0.0, toBorder(point)));
  return own;
}

bool EndSegments::keepsClass(Occupancy wanted, const Eigen::Vector2d& from,
                             const Eigen::Vector2d& to, double least) const {
  if (least < 0.0) return true;
  if (least > 0.0)
    return atLeast(distanceToClass(costs_.classes(), wanted, from, to, least), least);
  return distanceToClass(costs_.classes(), wanted, from, to, costs_.geometry().resolution(), kRim) >
         0.0;
}

bool EndSegments::keeps(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                        const KeptDistances& least) const {
  // Inside the map a line is nowhere nearer to the border than at its ends.
  return atLeast(std::min(toBorder(from), toBorder(to)), least.outside) &&
         keepsClass(Occupancy::OCCUPIED, from, to, least.occupied) &&
         keepsClass(Occupancy::UNKNOWN, from, to, least.unknown);
}

bool EndSegments::leavesStart(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                              const KeptDistances& own) const {
  if (own == kept_) return keeps(from, to);
  const Eigen::Vector2d line = to - from;
  const double diagonal = M_SQRT2 * costs_.geometry().resolution();
  const double share = line.norm() > diagonal ? diagonal / line.norm() : 1.0;
  return keeps(from, to, own) && keeps(from + share * line, to);
}

}  // namespace grid_path_planner::planning
