// Resolution, mounting, light, water and noise of the simulated image camera.
#pragma once

#include "grid_path_planner/base/options.h"
#include "simulation/sensors/mounting.h"

namespace grid_path_planner::simulation {

struct ImageCameraOptions {
  bool enabled = false;
  double rate = 5.0;  // Hz
  int width = 640;    // pixels
  int height = 480;
  double horizontal_fov = 1.2;  // rad
  double ambient = 0.35;
  double surface_noise = 0.06;
  double attenuation_red = 0.45;  // 1/m
  double attenuation_green = 0.14;
  double attenuation_blue = 0.10;
  double water_red = 12.0;  // 0 to 255
  double water_green = 62.0;
  double water_blue = 70.0;
  double noise = 2.0;  // of 255
  Mounting mounting;
  int seed = 1;
};

template <class Visitor>
void visitOptions(ImageCameraOptions& o, Visitor&& visit) {
  using base::OptionInfo;
  visit(
      "enabled", o.enabled,
      OptionInfo{"Whether there is a camera; it needs a world, and works only for subscribers", ""}
          .under("The image camera"));
  visit(
      "rate", o.rate,
      OptionInfo{"Images in a simulated second; one that is due while another is rendered is left "
                 "out",
                 "Hz", 0.01, 1000.0});
  visit("width", o.width, OptionInfo{"Width of the image", "pixels", 1, 8192});
  visit("height", o.height, OptionInfo{"Height of the image", "pixels", 1, 8192});
  visit("horizontal_fov", o.horizontal_fov,
        OptionInfo{"Angle between the leftmost and the rightmost rim of the image", "rad", 0.01,
                   3.0});
  visit(
      "ambient", o.ambient,
      OptionInfo{"Share of the light that is the same from everywhere; the rest is a headlight at "
                 "the camera, which surfaces reflect the less, the more they are turned away",
                 "", 0.0, 1.0});
  visit("surface_noise", o.surface_noise,
        OptionInfo{"Blotches on all surfaces, as a share of their colour", "", 0.0, 1.0});
  visit("attenuation_red", o.attenuation_red,
        OptionInfo{"What a metre of water takes of the light, exp(-a); all three 0: no water",
                   "1/m", 0.0, 100.0});
  visit("attenuation_green", o.attenuation_green,
        OptionInfo{"The same of green", "1/m", 0.0, 100.0});
  visit("attenuation_blue", o.attenuation_blue, OptionInfo{"The same of blue", "1/m", 0.0, 100.0});
  visit("water_red", o.water_red, OptionInfo{"Colour of endless water, of 255", "", 0.0, 255.0});
  visit("water_green", o.water_green,
        OptionInfo{"Colour of endless water, of 255", "", 0.0, 255.0});
  visit("water_blue", o.water_blue, OptionInfo{"Colour of endless water, of 255", "", 0.0, 255.0});
  visit("noise", o.noise,
        OptionInfo{"Standard deviation of each colour of each pixel, of 255", "", 0.0, 255.0});
  visitOptions(o.mounting, visit);
  visit("seed", o.seed, OptionInfo{"Another seed, other noise and blotches", "", 0, 1e9});
}

}  // namespace grid_path_planner::simulation
