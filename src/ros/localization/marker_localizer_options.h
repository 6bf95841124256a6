// The parameters of the node `marker_localizer`.
#pragma once

#include <string>

#include "grid_path_planner/base/read_limits.h"
#include "vision/marker_pose_options.h"
#include "vision/panel_learning_options.h"

namespace grid_path_planner::nodes {

struct MarkerLocalizerOptions {
  std::string layout;  // YAML file
  bool panel_known = false;
  double panel_x = 0.0;  // m
  double panel_y = 0.0;
  double panel_z = 0.0;
  double panel_roll = 0.0;  // rad
  double panel_pitch = 0.0;
  double panel_yaw = 0.0;
  vision::PanelLearningOptions learning;
  vision::MarkerPoseOptions markers;
  double prediction_deviation = 0.5;  // m
  double prediction_angle = 10.0;     // deg
  double prediction_wait = 0.1;       // s
  double max_age = 5.0;               // s
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  base::ReadOptions reading;
};

template <class Visitor>
void visitOptions(MarkerLocalizerOptions& o, Visitor&& visit) {
  using base::OptionInfo;
  visit(
      "layout", o.layout,
      OptionInfo{"YAML file below the folder to load from that names the panel's markers; needed; "
                 "read at the start",
                 ""}
          .under("The panel"));
  visit("panel_known", o.panel_known,
        OptionInfo{"Whether the panel is where panel_x to panel_yaw have it; false: there are no "
                   "poses until ~learn_panel has learnt where it is",
                   ""});
  visit("panel_x", o.panel_x, OptionInfo{"Where the panel is, in map_frame", "m", -1e6, 1e6});
  visit("panel_y", o.panel_y, OptionInfo{"Where the panel is, in map_frame", "m", -1e6, 1e6});
  visit("panel_z", o.panel_z, OptionInfo{"Where the panel is, upwards", "m", -1e6, 1e6});
  visit("panel_roll", o.panel_roll, OptionInfo{"Turn about its x axis", "rad", -6.3, 6.3});
  visit("panel_pitch", o.panel_pitch,
        OptionInfo{"Turn about its y axis, before the roll", "rad", -6.3, 6.3});
  visit("panel_yaw", o.panel_yaw,
        OptionInfo{"Turn about its z axis, before both", "rad", -6.3, 6.3});
  visitOptions(o.learning, visit);
  visitOptions(o.markers, visit);
  visit(
      "prediction_deviation", o.prediction_deviation,
      OptionInfo{"Standard deviation of each coordinate of the pose in tf, which chooses where the "
                 "corners admit two poses; larger: where it fits both, nothing is said",
                 "m", 0.001, 1000.0}
          .under("The prediction"));
  visit("prediction_angle", o.prediction_angle,
        OptionInfo{"Standard deviation of each angle of it", "deg", 0.01, 180.0});
  visit("prediction_wait", o.prediction_wait,
        OptionInfo{"How long tf of an image's stamp is waited for, by the wall clock", "s", 0.0,
                   10.0});
  visit("max_age", o.max_age, OptionInfo{"Older images are refused", "s", 0.01, 1000.0});
  visit("map_frame", o.map_frame, OptionInfo{"Frame of the map", ""}.under("Frames"));
  visit("odom_frame", o.odom_frame,
        OptionInfo{"Frame of the odometry: a camera that tf joins to the vehicle by it, or by "
                   "map_frame, is refused",
                   ""});
  visit("base_frame", o.base_frame, OptionInfo{"Frame of the vehicle", ""});
  visitOptions(o.reading, visit);
}

// Throws InputError for what lies outside its limits, frames without a name or the same, and no layout.
void checkMarkerLocalizerOptions(const MarkerLocalizerOptions& options);

}  // namespace grid_path_planner::nodes
