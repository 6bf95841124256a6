// A Doppler velocity log: four beams that see how fast the bottom passes by.
//
//   Dvl dvl(world, options);
//   const auto reading = dvl.measure(vehicle.state(), vehicle.timeNs());   // after every step
//   if (reading && reading->velocity) std::cout << reading->velocity->velocity.x() << " m/s\n";
//
// The beams are cast on the visible surfaces of the world, 45 degrees to the sides of ahead and astern
// and `beam_angle` off the axis down. Each that meets a surface within its range measures the component
// of the sensor's velocity along it, with noise of its own; three or four give the velocity by least
// squares, fewer give none. Guaranteed: the same world, options and calls give the same measurements,
// bit for bit. Not modelled: layers of water, side lobes, errors of the altitude; everything in the
// world counts as bottom.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "grid_path_planner/simulation/vehicle.h"
#include "grid_path_planner/simulation/world.h"
#include "simulation/ray_scene.h"
#include "simulation/sensors/dvl_options.h"
#include "simulation/sensors/noise_stream.h"
#include "simulation/sensors/sample_clock.h"

namespace grid_path_planner::simulation {

// Of the sensor's own place over ground, in its own axes.
struct DvlVelocity {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

struct DvlReading {
  std::int64_t time_ns = 0;
  std::optional<DvlVelocity> velocity;  // none without bottom lock
  // Of the sensor above the bottom, along its axis down: the mean of its beams (m). Without bottom
  // lock -infinity where a beam met something too near, else +infinity (REP 117).
  double altitude = 0.0;
};

class Dvl {
 public:
  static constexpr std::size_t kBeams = 4;
  static constexpr std::size_t kNeededBeams = 3;

  // Prepares the visible surfaces for rays; the world is not needed afterwards.
  Dvl(const World& world, const DvlOptions& options);

  const DvlOptions& options() const { return options_; }

  // The vehicle is at `state` after a step. None unless a measurement is due.
  std::optional<DvlReading> measure(const VehicleState& state, std::int64_t time_ns);

 private:
  std::array<float, kBeams> castBeams(const VehicleState& state) const;
  std::optional<DvlVelocity> velocityOf(const VehicleState& state,
                                        const std::array<float, kBeams>& ranges);
  double altitudeOf(const std::array<float, kBeams>& ranges, bool locked) const;
  bool valid(float range) const;

  DvlOptions options_;
  Eigen::Isometry3d base_from_dvl_;  // as it is, misalignment included
  std::array<Eigen::Vector3f, kBeams> beams_;
  SampleClock clock_;
  NoiseStream noise_;
  std::unique_ptr<const RayScene> scene_;
};

}  // namespace grid_path_planner::simulation
