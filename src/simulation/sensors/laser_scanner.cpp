#include "simulation/sensors/laser_scanner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/range_noise.h"
#include "simulation/ray_scene.h"

namespace grid_path_planner::simulation {
namespace {

constexpr std::size_t kRaysAtOnce = RayScene::kPacket;
constexpr double kAllAround = 6.28;  // rad, from which on the last ray is not the first one

}  // namespace

double angleMin(const LaserOptions& options) {
  return options.field_of_view >= kAllAround ? -M_PI : -0.5 * options.field_of_view;
}

double angleIncrement(const LaserOptions& options) {
  return options.field_of_view >= kAllAround ? 2.0 * M_PI / options.rays
                                             : options.field_of_view / (options.rays - 1);
}

LaserScanner::LaserScanner(const World& world, const LaserOptions& options)
    : options_(options), clock_(options.rate) {
  for (int i = 0; i < options.rays; ++i) {
    const double angle = angleMin(options) + i * angleIncrement(options);
    rays_.emplace_back(Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0).cast<float>());
  }
  scene_ = std::make_unique<const RayScene>(world.visible());
}

LaserScanner::~LaserScanner() = default;

std::optional<LaserReading> LaserScanner::measure(const VehicleState& state, std::int64_t time_ns,
                                                  const BodiesAt& bodies) {
  if (!clock_.take(time_ns)) return std::nullopt;
  const auto number = static_cast<std::uint64_t>(time_ns);
  return LaserReading{time_ns, scan(mapFromBase(state) * options_.mounting.pose(), number, bodies)};
}

std::vector<float> LaserScanner::scan(const Eigen::Isometry3d& map_from_sensor,
                                      std::uint64_t number, const BodiesAt& bodies) const {
  const Eigen::Matrix3f turn = map_from_sensor.linear().cast<float>();
  const Eigen::Vector3f origin = map_from_sensor.translation().cast<float>();
  const RangeNoise noise(static_cast<std::uint64_t>(options_.seed), number);
  const auto nearest = static_cast<float>(options_.range_min);
  const auto farthest = static_cast<float>(options_.range_max);
  const auto deviation = static_cast<float>(options_.noise);
  const float nothing =
      options_.no_return == NoReturn::INF ? std::numeric_limits<float>::infinity() : farthest;
  const auto measured = [&](float range, std::size_t ray) {
    if (range < nearest) return 0.0f;
    if (!(range <= farthest) || noise.share(ray) < options_.dropout) return nothing;
    const float noisy = range + deviation * noise.deviation(ray);
    return noisy > farthest ? nothing : std::max(noisy, nearest);
  };
  std::vector<float> ranges(rays_.size());
  for (std::size_t first = 0; first < rays_.size(); first += kRaysAtOnce) {
    const std::size_t count = std::min(kRaysAtOnce, rays_.size() - first);
    scene_->ranges(origin, turn, &rays_[first], count, farthest, &ranges[first]);
    for (std::size_t i = first; i < first + count; ++i) {
      if (!bodies.empty())
        ranges[i] = std::min(
            ranges[i], static_cast<float>(bodies.range(
                           origin.cast<double>(), (turn * rays_[i]).cast<double>().normalized())));
      ranges[i] = measured(ranges[i], i);
    }
  }
  return ranges;
}

}  // namespace grid_path_planner::simulation
