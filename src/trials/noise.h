// Random numbers of a trial that no simulated sensor draws: a sequence for each seed and purpose.
//
//   Noise noise(seed, Purpose::START);
//   const Eigen::Vector3d error = 0.05 * noise.normals();
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <random>

namespace grid_path_planner::trials {

enum class Purpose {
  CORNERS_CLEAR,
  CORNERS_TURBID,
  START,
  CAMERA,
  CURRENT,
  MARKERS,
  FLIPS,
  HEADING
};

class Noise {
 public:
  Noise(int seed, Purpose purpose)
      : random_(1000003u * static_cast<std::uint64_t>(seed) +
                static_cast<std::uint64_t>(purpose) * 0x9e3779b97f4a7c15u) {}

  double normal() { return normal_(random_); }
  Eigen::Vector3d normals() {
    const double x = normal(), y = normal();
    return {x, y, normal()};
  }
  // Even in [0, 1).
  double even() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  // Precondition: count > 0.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace grid_path_planner::trials
