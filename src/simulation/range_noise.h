// Noise of a simulated range sensor: a function of seed, frame and pixel instead of a sequence, so
// that an image does not depend on numbers drawn before it.
#pragma once

#include <cstdint>

namespace grid_path_planner::simulation {

// Sebastiano Vigna's splitmix64: as good as independent for neighbouring inputs.
inline std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

class RangeNoise {
 public:
  RangeNoise(std::uint64_t seed, std::uint64_t frame) : key_(mixed(mixed(seed) ^ frame)) {}

  // Mean 0, standard deviation 1, within 3.47: the sum of four even numbers, which is nearly normal
  // and costs a tenth of a normal one.
  float deviation(std::uint64_t pixel) const {
    const std::uint64_t bits = mixed(key_ + 2 * pixel);
    const auto sum = static_cast<std::int32_t>((bits & 0xffffu) + ((bits >> 16) & 0xffffu) +
                                               ((bits >> 32) & 0xffffu) + (bits >> 48));
    return (static_cast<float>(sum) - 2.0f * 65535.0f) * (1.7320508f / 65536.0f);
  }

  // Even in [0, 1).
  double share(std::uint64_t pixel) const {
    return static_cast<double>(mixed(key_ + 2 * pixel + 1) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t key_;
};

}  // namespace grid_path_planner::simulation
