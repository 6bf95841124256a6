// Theta* as first published: where a cell is reached, the segment from its parent's parent is
// looked along at once, and taken where it is legal and no dearer than the step; not where even at
// the cheapest weight it could not better what is known.
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
