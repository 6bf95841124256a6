// Theta* as first published: when a cell is generated, the segment from its parent's parent is checked
// at once, and used where it has line of sight and costs no more than the step. The check is skipped
// where even at the minimum weight the segment could not improve the known g-value.
#pragma once

#include "grid_path_planner/planners/theta_star.h"

namespace grid_path_planner::study {

class EagerThetaStar : public planners::ThetaStar {
 public:
  EagerThetaStar() : planners::ThetaStar("theta_star") {}

 protected:
  void expand(std::uint32_t from, base::Statistics& counts) override;
};

}  // namespace grid_path_planner::study
