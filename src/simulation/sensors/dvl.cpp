#include "simulation/sensors/dvl.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grid_path_planner::simulation {
namespace {

// Directions in the sensor's frame: left ahead, left astern, right astern, right ahead.
std::array<Eigen::Vector3f, Dvl::kBeams> janusBeams(double beam_angle) {
  std::array<Eigen::Vector3f, Dvl::kBeams> beams;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const double azimuth = 0.25 * M_PI + 0.5 * M_PI * static_cast<double>(i);
    beams[i] = Eigen::Vector3d(std::sin(beam_angle) * std::cos(azimuth),
                               std::sin(beam_angle) * std::sin(azimuth), -std::cos(beam_angle))
                   .cast<float>();
  }
  return beams;
}

}  // namespace

Dvl::Dvl(const World& world, const DvlOptions& options)
    : options_(options),
      base_from_dvl_(options.mounting.pose()),
      beams_(janusBeams(options.beam_angle)),
      clock_(options.rate),
      noise_(options.seed, SensorName::DVL),
      scene_(std::make_unique<const RayScene>(world.visible())) {
  base_from_dvl_.rotate(Eigen::AngleAxisd(options.misalignment, Eigen::Vector3d::UnitZ()));
}

std::optional<DvlReading> Dvl::measure(const VehicleState& state, std::int64_t time_ns) {
  if (!clock_.take(time_ns)) return std::nullopt;
  const std::array<float, kBeams> ranges = castBeams(state);
  DvlReading reading;
  reading.time_ns = time_ns;
  reading.velocity = velocityOf(state, ranges);
  reading.altitude = altitudeOf(ranges, reading.velocity.has_value());
  return reading;
}

std::array<float, Dvl::kBeams> Dvl::castBeams(const VehicleState& state) const {
  static_assert(kBeams <= RayScene::kPacket);
  const Eigen::Isometry3d map_from_dvl = mapFromBase(state) * base_from_dvl_;
  std::array<float, kBeams> ranges;
  scene_->ranges(map_from_dvl.translation().cast<float>(), map_from_dvl.linear().cast<float>(),
                 beams_.data(), kBeams, static_cast<float>(options_.range_max), ranges.data());
  return ranges;
}

bool Dvl::valid(float range) const {
  return range >= options_.range_min && range <= options_.range_max;
}

std::optional<DvlVelocity> Dvl::velocityOf(const VehicleState& state,
                                           const std::array<float, kBeams>& ranges) {
  const BodyTwist twist = bodyTwist(state);
  const Eigen::Vector3d truth = base_from_dvl_.linear().transpose() *
                                (twist.linear + twist.angular.cross(base_from_dvl_.translation()));
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (std::size_t i = 0; i < kBeams; ++i) {
    const double noise = options_.beam_noise * noise_.normal();
    if (!valid(ranges[i])) continue;
    const Eigen::Vector3d beam = beams_[i].cast<double>();
    information += beam * beam.transpose();
    measured += beam * (beam.dot(truth) * (1.0 + options_.scale_error) + noise);
    ++count;
  }
  if (count < kNeededBeams) return std::nullopt;
  const Eigen::Matrix3d inverse = information.inverse();
  return DvlVelocity{inverse * measured, options_.beam_noise * options_.beam_noise * inverse};
}

double Dvl::altitudeOf(const std::array<float, kBeams>& ranges, bool locked) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!locked)
    return std::any_of(ranges.begin(), ranges.end(),
                       [this](float range) { return range < options_.range_min; })
               ? -kInfinity
               : kInfinity;
  double sum = 0.0;
  std::size_t count = 0;
  for (const float range : ranges)
    if (valid(range)) sum += range, ++count;
  return std::cos(options_.beam_angle) * sum / static_cast<double>(count);
}

}  // namespace grid_path_planner::simulation
