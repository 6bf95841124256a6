// The straight lines between the poses at the ends of a path and its first and last cell centres,
// and lines from where a vehicle has come to: they begin or end off the centre lattice, so their
// distances are measured.
//
//   EndSegments ends(costs);                             // the costmap at full resolution
//   use(ends.leavesStart(pose, centre));
//
// A start may be nearer than the distances that are kept, from occupied cells, unknown cells and the map's
// border alike: then the line is never nearer than the start, and keeps them beyond one cell diagonal.
#pragma once

#include <Eigen/Core>

#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::planning {

// Whether a distance is one that is kept, but for rounding: as inflation allows for resolutions that are 32-bit
// floats, and for the rounding of positions. Metres.
bool atLeast(double distance, double least);

class EndSegments {
 public:
  // `costs` outlives this.
  explicit EndSegments(const costmap::CostGrid& costs)
      : costs_(costs), kept_(costs.keptDistances()) {}

  // Whether segments are judged by distances at all; else line_of_sight.h judges them.
  bool measured() const { return costs_.segmentRule() == costmap::SegmentRule::CENTRE_LATTICE; }

  // The distances of a point, each no more than the kept one. Points in metres.
  costmap::KeptDistances at(const Eigen::Vector2d& point) const;
  // How far a point in the map is from its border.
  double toBorder(const Eigen::Vector2d& point) const;
  // Whether no point of the line is nearer than the kept distances.
  bool keeps(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
    return keeps(from, to, kept_);
  }
  // The same where the line begins at a start, or at a point past it, where it was as near as `own`.
  bool leavesStart(const Eigen::Vector2d& start, const Eigen::Vector2d& to) const {
    return leavesStart(start, to, at(start));
  }
  bool leavesStart(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                   const costmap::KeptDistances& own) const;

 private:
  bool keeps(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
             const costmap::KeptDistances& least) const;
  bool keepsClass(grid::Occupancy wanted, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                  double least) const;

  const costmap::CostGrid& costs_;
  costmap::KeptDistances kept_;
};

}  // namespace grid_path_planner::planning
