// The free directions of a node, that of least cost first, each a step long and no two near to each other.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "avoidance/memory/open_space.h"
#include "avoidance/search/directions.h"
#include "avoidance/search/histogram.h"
#include "grid_path_planner/avoidance/pilot_options.h"

namespace grid_path_planner::avoidance {

struct Candidate {
  Eigen::Vector3d end;
  Angles angles;
  double cost;
};

// w_g (goal to candidate) + w_s (chosen before to candidate), both weighted angles.
double directionCost(const PilotOptions& options, const Angles& candidate, const Angles& goal,
                     const Angles& before);

class Candidates {
 public:
  explicit Candidates(const PilotOptions& options);

  // At most options.children; in the order of their costs, those that cost the same in that of bins.
  // Places in `closed` are closed as points are.
  const std::vector<Candidate>& find(const OpenSpace& space, const PilotOptions& options,
                                     const Eigen::Vector3d& from, const Angles& goal,
                                     const Angles& before,
                                     const std::vector<Eigen::Vector3d>& closed);

  const Directions& directions() const { return directions_; }

 private:
  bool isFree(const OpenSpace& space, const PilotOptions& options, const Eigen::Vector3d& from,
              int bin, const std::vector<Eigen::Vector3d>& closed) const;
  void collectBeside(const OpenSpace& space, const PilotOptions& options,
                     const Eigen::Vector3d& from);
  bool isApart(const Eigen::Vector3d& end, double spacing) const;

  Directions directions_;
  Histogram histogram_;
  std::vector<std::pair<double, int>> order_;  // cost, bin; a heap
  std::vector<Candidate> found_;
  std::vector<Eigen::Vector3d> beside_;  // from the node, the points that `widening` is about
};

}  // namespace grid_path_planner::avoidance
