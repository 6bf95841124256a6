// What water makes of a colour that is seen through it: it takes of the light and adds of its own.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace grid_path_planner::simulation {

struct Water {
  Eigen::Array3f attenuation = {0.45f, 0.14f, 0.10f};  // 1/m, of red, green, blue
  Eigen::Array3f colour = {12.0f, 62.0f, 70.0f};       // 0 to 255, of endless water

  // i* = i e^(-z a) + (1 - e^(-z a)) b of the DexROV sea trial (IROS 2018), z metres along the ray. A channel
  // without attenuation stays as it is, at infinity too.
  Eigen::Array3f seenThrough(const Eigen::Array3f& i, float range) const {
    Eigen::Array3f seen;
    for (int channel = 0; channel < 3; ++channel) {
      const float a = attenuation[channel];
      const float share = a > 0.0f ? std::exp(-range * a) : 1.0f;
      seen[channel] = i[channel] * share + (1.0f - share) * colour[channel];
    }
    return seen;
  }
};

}  // namespace grid_path_planner::simulation
