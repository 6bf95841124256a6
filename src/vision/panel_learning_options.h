// From how many images, and how still, a panel's place is learnt.
#pragma once

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::vision {

struct PanelLearningOptions {
  int images = 10;
  double distance = 0.05;  // m
  double angle = 2.0;      // deg
};

template <class Visitor>
void visitOptions(PanelLearningOptions& o, Visitor&& visit) {
  using base::OptionInfo;
  visit(
      "learn_images", o.images,
      OptionInfo{"How many images the panel's pose is learnt from, of which none is more than 2 s "
                 "after the one before",
                 "", 1, 1000}
          .under("Learning where the panel is, by ~learn_panel"));
  visit("learn_distance", o.distance,
        OptionInfo{"How far the vehicle, and the panel as it is seen, may be in one of them from "
                   "where it was in the first; farther: nothing is learnt",
                   "m", 0.0, 100.0});
  visit("learn_angle", o.angle, OptionInfo{"The same for turns", "deg", 0.0, 180.0});
}

}  // namespace grid_path_planner::vision
