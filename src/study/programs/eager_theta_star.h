// Theta* as first published: the line of sight of the segment from the parent's parent is checked
// when a cell is generated, and that segment is used where it is legal and costs no more than the
// step. It is not checked where even at the map's least weight it would not lower the g-value.
#pragma once

#include "planners/any_angle/theta_star.h"

namespace grid_path_planner::study {

class EagerThetaStar : public planners::ThetaStar {
 public:
  static constexpr const char* kName = "theta_star";

  EagerThetaStar() : planners::ThetaStar(kName, false) {}

 private:
  void expand(std::uint32_t from, base::Statistics& counts) override;
};

}  // namespace grid_path_planner::study
