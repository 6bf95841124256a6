#include "ros/layers/scan_messages.h"

#include <algorithm>
#include <cmath>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/waypoint_file.h"

namespace grid_path_planner::nodes {

using base::InputError;
using layers::Beam;
using layers::ScanInMap;

namespace {

constexpr std::size_t kMostBeams = 20000;
constexpr float kFarthest = 1e4F;  // m

float farthestOf(const sensor_msgs::LaserScan& scan) {
  return std::min(scan.range_max, kFarthest);
}

bool isHit(float measured, const sensor_msgs::LaserScan& scan) {
  return measured > 0.0F && measured >= scan.range_min && measured < farthestOf(scan);
}

}  // namespace

void checkScan(const sensor_msgs::LaserScan& scan) {
  if (!std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment))
    throw InputError("its angles are not finite");
  if (!(scan.range_min >= 0.0F && scan.range_min < farthestOf(scan) &&
        (scan.range_max <= kFarthest || std::isinf(scan.range_max))))
    throw InputError("range_min and range_max must rise from 0 to 1e4 m, got " +
                     std::to_string(scan.range_min) + " and " + std::to_string(scan.range_max));
  if (scan.ranges.empty()) throw InputError("it has no ranges");
  if (scan.ranges.size() > kMostBeams)
    throw InputError("it has " + std::to_string(scan.ranges.size()) +
                     " ranges, more than 20000 are not taken");
  if (scan.intensities.size() > kMostBeams)  // they are not used, and wait for tf all the same
    throw InputError("it has " + std::to_string(scan.intensities.size()) +
                     " intensities, more than 20000 are not taken");
}

void checkScanPose(const Eigen::Isometry3d& map_from_scan) {
  const Eigen::Vector3d position = map_from_scan.translation();
  if (!map_from_scan.matrix().allFinite() ||
      position.cwiseAbs().maxCoeff() > path::kLargestCoordinate)
    throw InputError("tf has its sensor out of this world");
}

ScanInMap scanInMap(const sensor_msgs::LaserScan& message, const Eigen::Isometry3d& map_from_scan,
                    bool inf_clears) {
  ScanInMap scan;
  scan.time = message.header.stamp.toSec();
  scan.origin = map_from_scan.translation().head<2>();
  for (std::size_t i = 0; i < message.ranges.size(); ++i) {
    const float measured = message.ranges[i];
    const bool hit = isHit(measured, message);
    const bool free = inf_clears && std::isinf(measured) && measured > 0.0F;
    if (!hit && !free) continue;
    const double range = hit ? measured : farthestOf(message);
    const double angle = message.angle_min + static_cast<double>(i) * message.angle_increment;
    const Eigen::Vector3d end =
        map_from_scan * Eigen::Vector3d(range * std::cos(angle), range * std::sin(angle), 0.0);
    scan.beams.push_back({end.head<2>(), range, hit});
  }
  return scan;
}

}  // namespace grid_path_planner::nodes
