// Resolution, range, noise and mounting of the simulated depth camera.
#pragma once

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::simulation {

struct DepthCameraOptions {
  double horizontal_fov = 1.3;  // rad
  int width = 320;              // pixels
  int height = 240;
  double rate = 10.0;           // Hz
  double range_min = 0.2;       // m
  double range_max = 10.0;      // m
  double noise_base = 0.002;    // m
  double noise_per_m2 = 0.001;  // 1/m
  double dropout = 0.005;       // probability
  double x = 0.0;               // m, in base_link
  double y = 0.0;
  double z = 0.0;
  double roll = 0.0;  // rad
  double pitch = 0.0;
  double yaw = 0.0;
  int seed = 1;
};

template <class Visitor>
void visitOptions(DepthCameraOptions& o, Visitor&& visit) {
  visit("horizontal_fov", o.horizontal_fov,
        base::OptionInfo{"Angle between the leftmost and the rightmost rim of the picture", "rad",
                         0.01, 3.0}
            .under("The depth camera; there is one only with a world, and it works only for "
                   "subscribers"));
  visit("width", o.width, base::OptionInfo{"Width of the picture", "pixels", 1, 8192});
  visit("height", o.height,
        base::OptionInfo{"Height of the picture; width times height is at most 4194304", "pixels",
                         1, 8192});
  visit("rate", o.rate,
        base::OptionInfo{
            "Pictures in a simulated second, which takes longer where pictures take too long", "Hz",
            0.01, 1000.0});
  visit("range_min", o.range_min,
        base::OptionInfo{"Nearer surfaces are not measured", "m", 0.0, 1e4});
  visit("range_max", o.range_max,
        base::OptionInfo{"Farther surfaces are not measured", "m", 0.01, 1e4});
  visit("noise_base", o.noise_base,
        base::OptionInfo{"Standard deviation of a range of 0 m", "m", 0.0, 100.0});
  visit("noise_per_m2", o.noise_per_m2,
        base::OptionInfo{"How the standard deviation grows with the square of the range", "1/m",
                         0.0, 1.0});
  visit("dropout", o.dropout,
        base::OptionInfo{"Probability that a pixel measures nothing", "", 0.0, 1.0});
  visit("x", o.x, base::OptionInfo{"Where the camera is, ahead of base_link", "m", -100.0, 100.0});
  visit("y", o.y, base::OptionInfo{"Where the camera is, left of base_link", "m", -100.0, 100.0});
  visit("z", o.z, base::OptionInfo{"Where the camera is, above base_link", "m", -100.0, 100.0});
  visit("roll", o.roll,
        base::OptionInfo{"Turn of the camera about its axis ahead", "rad", -6.3, 6.3});
  visit("pitch", o.pitch,
        base::OptionInfo{"Turn of the camera up or down; positive looks down", "rad", -6.3, 6.3});
  visit(
      "yaw", o.yaw,
      base::OptionInfo{"Turn of the camera left or right; positive looks left", "rad", -6.3, 6.3});
  visit("seed", o.seed,
        base::OptionInfo{"Another seed, other noise and dropouts", "", 0, 2147483647});
}

// Throws InputError naming the option for a value outside its limits, for a range_min that is not below
// range_max and for a picture of more than 2^22 pixels.
void checkDepthCameraOptions(const DepthCameraOptions& options);

}  // namespace grid_path_planner::simulation
