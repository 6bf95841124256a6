// Which steps a vehicle may take between cells, how long they are, and what it keeps away from.
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

// The distances in metres that paths keep from the squares of cells and from the map's outside; 0:
// these are not entered, below 0: nothing is asked.
struct KeptDistances {
  double occupied = 0.0;
  double unknown = -1.0;
  double outside = 0.0;

  bool any() const { return occupied > 0.0 || unknown > 0.0 || outside > 0.0; }
  friend bool operator==(const KeptDistances& a, const KeptDistances& b) {
    return a.occupied == b.occupied && a.unknown == b.unknown && a.outside == b.outside;
  }
  friend bool operator!=(const KeptDistances& a, const KeptDistances& b) { return !(a == b); }
};

// Which straight lines are legal (line_of_sight.h).
enum class SegmentRule { CELLS, CUT_CORNERS, CENTRE_LATTICE };

}  // namespace grid_path_planner::costmap
