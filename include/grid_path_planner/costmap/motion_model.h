// Which steps a vehicle may take between cells, and how long they are.
#pragma once

#include <utility>
#include <vector>

namespace grid_path_planner::costmap {

enum class Connectivity { EIGHT, FOUR };
enum class DiagonalCost { SQRT2, UNIT };

const std::vector<std::pair<const char*, Connectivity>>& choicesOf(Connectivity);  // "8", "4"
const std::vector<std::pair<const char*, DiagonalCost>>& choicesOf(
    DiagonalCost);  // "sqrt2", "unit"

struct MotionModel {
  Connectivity connectivity = Connectivity::EIGHT;
  DiagonalCost diagonal_cost = DiagonalCost::SQRT2;
  // A diagonal step needs both orthogonal cells passable unless corners may be cut.
  bool cut_corners = false;

  friend bool operator==(const MotionModel& a, const MotionModel& b) {
    return a.connectivity == b.connectivity && a.diagonal_cost == b.diagonal_cost &&
           a.cut_corners == b.cut_corners;
  }
};

}  // namespace grid_path_planner::costmap
