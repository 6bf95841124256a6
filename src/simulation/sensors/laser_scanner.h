// A 2-D laser scanner in a simulated world: a fan of rays in the plane of the sensor.
//
//   LaserScanner laser(world, options);
//   vehicle.step();
//   if (const auto scan = laser.measure(vehicle.state(), vehicle.timeNs()))
//     std::cout << scan->ranges[0] << " m at the angle of " << angleMin(options) << " rad\n";
//
// Guaranteed: the same world, options, state and time give the same ranges, bit for bit; other times give noise that is
// independent of it. All rays of a scan are of one instant. Not modelled: the time that a turn of the scanner takes, glass, the vehicle itself.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "grid_path_planner/simulation/moving_bodies.h"
#include "grid_path_planner/simulation/vehicle.h"
#include "grid_path_planner/simulation/world.h"
#include "simulation/sensors/laser_options.h"
#include "simulation/sensors/sample_clock.h"

namespace grid_path_planner::simulation {

class RayScene;

struct LaserReading {
  std::int64_t time_ns;
  // m, one a ray, anticlockwise from angleMin(). A surface nearer than range_min is 0; nothing within range_max is what
  // no_return says.
  std::vector<float> ranges;
};

// rad, of the first ray and from one to the next; ahead is 0.
double angleMin(const LaserOptions& options);
double angleIncrement(const LaserOptions& options);

class LaserScanner {
 public:
  // Precondition: the options were checked. The world is not needed afterwards.
  LaserScanner(const World& world, const LaserOptions& options);
  ~LaserScanner();

  const LaserOptions& options() const { return options_; }

  // The scan that is due at this time, which never decreases.
  std::optional<LaserReading> measure(const VehicleState& state, std::int64_t time_ns,
                                      const BodiesAt& bodies = {});

 private:
  std::vector<float> scan(const Eigen::Isometry3d& map_from_sensor, std::uint64_t number,
                          const BodiesAt& bodies) const;

  LaserOptions options_;
  SampleClock clock_;
  std::vector<Eigen::Vector3f> rays_;  // of length 1, in the sensor's frame
  std::unique_ptr<const RayScene> scene_;
};

}  // namespace grid_path_planner::simulation
