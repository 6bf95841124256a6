#include "simulation/sensors/usbl.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace grid_path_planner::simulation {

Usbl::Usbl(const UsblOptions& options)
    : options_(options),
      keel_(options.keel_x, options.keel_y, options.keel_z),
      clock_(options.rate),
      noise_(options.seed, SensorName::USBL) {}

std::vector<UsblFix> Usbl::measure(const VehicleState& state, std::int64_t time_ns) {
  if (clock_.take(time_ns))
    travelling_.push_back(
        fixOf((mapFromBase(state) * options_.mounting.pose()).translation(), time_ns));
  const auto arrived =
      std::stable_partition(travelling_.begin(), travelling_.end(),
                            [&](const UsblFix& fix) { return fix.arrives_ns <= time_ns; });
  const std::vector<UsblFix> fixes(travelling_.begin(), arrived);
  travelling_.erase(travelling_.begin(), arrived);
  return fixes;
}

UsblFix Usbl::fixOf(const Eigen::Vector3d& transponder, std::int64_t time_ns) {
  const Eigen::Vector3d line = transponder - keel_;
  const double range = line.norm();
  const Eigen::Vector3d direction =
      range > 0.0 ? Eigen::Vector3d(line / range) : Eigen::Vector3d(0.0, 0.0, -1.0);
  const Eigen::Vector3d across = direction.unitOrthogonal();
  const Eigen::Vector3d noise = noise_.normals();
  const Eigen::Vector3d measured_direction =
      (direction +
       options_.bearing_noise * (noise.y() * across + noise.z() * direction.cross(across)))
          .normalized();

  UsblFix fix;
  fix.time_ns = time_ns;
  fix.arrives_ns = time_ns + std::llround((options_.delay + range / options_.sound_speed) * 1e9);
  fix.position =
      keel_ + (range + options_.range_noise * noise.x()) * measured_direction + outlier();
  const Eigen::Matrix3d along = direction * direction.transpose();
  const double sideways = range * options_.bearing_noise;
  fix.covariance = options_.range_noise * options_.range_noise * along +
                   sideways * sideways * (Eigen::Matrix3d::Identity() - along);
  return fix;
}

// Mostly zero.
Eigen::Vector3d Usbl::outlier() {
  const bool is_one = noise_.even() < options_.outlier_share;
  const double distance =
      options_.outlier_min + noise_.even() * (options_.outlier_max - options_.outlier_min);
  const Eigen::Vector3d direction = noise_.normals().normalized();
  return is_one ? Eigen::Vector3d(distance * direction) : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

}  // namespace grid_path_planner::simulation
