// How poses are computed from markers, and when they are not believed.
#pragma once

#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::vision {

enum class PoseMethod { JOINT, MEAN };
const std::vector<std::pair<const char*, PoseMethod>>& choicesOf(PoseMethod);

struct MarkerPoseOptions {
  PoseMethod method = PoseMethod::JOINT;
  int max_wrong_bits = 2;
  double pixel_noise = 0.3;   // pixels
  double max_residual = 2.0;  // pixels
  double ambiguity_limit = 25.0;
  double mean_position_deviation = 0.126;  // m
  double mean_angle_deviation = 4.6;       // deg
};

template <class Visitor>
void visitOptions(MarkerPoseOptions& o, Visitor&& visit) {
  using base::OptionInfo;
  visit("method", o.method,
        OptionInfo{
            "joint: one pose from all corners; mean: a pose from each marker, and their mean", ""}
            .under("Poses from markers"));
  visit("max_wrong_bits", o.max_wrong_bits,
        OptionInfo{"Bits of a marker that may be read wrong; higher: more markers in turbid water, "
                   "and more that are none",
                   "", 0, 5});
  visit(
      "pixel_noise", o.pixel_noise,
      OptionInfo{"Least standard deviation of a corner's coordinate; the covariance is of this or "
                 "of what the residuals show, whichever is more",
                 "pixels", 0.01, 100.0});
  visit("max_residual", o.max_residual,
        OptionInfo{"Where the corners of three markers or more lie farther than this from where "
                   "the pose has them (root mean square), calibration or layout is off: no pose",
                   "pixels", 0.01, 1000.0});
  visit(
      "ambiguity_limit", o.ambiguity_limit,
      OptionInfo{"How much less the sum of squares, in variances, of one pose must be than that of "
                 "another that the same corners have, for the other to be ruled out; of one marker "
                 "there are two. Higher: fewer poses, and fewer that are flipped",
                 "", 1.0, 1000.0});
  visit("mean_position_deviation", o.mean_position_deviation,
        OptionInfo{"Standard deviation of each coordinate, of method mean", "m", 1e-4, 100.0});
  visit("mean_angle_deviation", o.mean_angle_deviation,
        OptionInfo{"Standard deviation of each angle, of method mean", "deg", 0.01, 180.0});
}

}  // namespace grid_path_planner::vision
