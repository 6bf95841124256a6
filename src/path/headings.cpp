#include "grid_path_planner/path/headings.h"

namespace grid_path_planner {

const std::vector<std::pair<const char*, HeadingMode>>& choicesOf(HeadingMode) {
  static const std::vector<std::pair<const char*, HeadingMode>> choices = {
      {"none", HeadingMode::NONE},
      {"forward", HeadingMode::FORWARD},
      {"interpolate", HeadingMode::INTERPOLATE},
      {"forward_then_interpolate", HeadingMode::FORWARD_THEN_INTERPOLATE},
      {"backward", HeadingMode::BACKWARD},
      {"leftward", HeadingMode::LEFTWARD},
      {"rightward", HeadingMode::RIGHTWARD}};
  return choices;
}

const std::vector<std::pair<const char*, PathZ>>& choicesOf(PathZ) {
  static const std::vector<std::pair<const char*, PathZ>> choices = {
      {"interpolate", PathZ::INTERPOLATE},
      {"start", PathZ::START},
      {"goal", PathZ::GOAL},
      {"fixed", PathZ::FIXED}};
  return choices;
}

}  // namespace grid_path_planner
