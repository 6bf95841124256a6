#include "vision/marker_pose_options.h"

namespace grid_path_planner::vision {

const std::vector<std::pair<const char*, PoseMethod>>& choicesOf(PoseMethod) {
  static const std::vector<std::pair<const char*, PoseMethod>> choices = {
      {"joint", PoseMethod::JOINT}, {"mean", PoseMethod::MEAN}};
  return choices;
}

}  // namespace grid_path_planner::vision
