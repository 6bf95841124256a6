// The free directions of a node, that of least cost first, each a step long and no two near to each other.
#pragma once

#include <Eigen/Core>
#include <algorithm>
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

constexpr double kPlanRoom = 0.05;  // m more than d_safe that planned paths keep

// m, within which two nodes are the same; less than a step, whatever `spacing` is.
inline double sameNode(const PilotOptions& options) {
  return std::min(options.spacing, 0.5 * options.step);
}

struct CandidateQuery {
  Eigen::Vector3d from;
  Angles goal, before;  // of the goal from there; of the direction chosen before
  const std::vector<Eigen::Vector3d>& closed;    // places that are closed as points are
  const std::vector<Eigen::Vector3d>& expanded;  // nodes that the search need not come to again
};

// w_g (goal to candidate) + w_s (chosen before to candidate), both weighted angles.
double directionCost(const PilotOptions& options, const Angles& candidate, const Angles& goal,
                     const Angles& before);

class Candidates {
 public:
  explicit Candidates(const PilotOptions& options);

  // At most options.children, at least options.spacing from each other and from expanded nodes; in the
  // order of their costs, those that cost the same in that of bins.
  const std::vector<Candidate>& find(const OpenSpace& space, const PilotOptions& options,
                                     const CandidateQuery& query);

  const Directions& directions() const { return directions_; }

 private:
  bool isFree(const OpenSpace& space, const PilotOptions& options, const CandidateQuery& query,
              int bin) const;
  void collectBeside(const OpenSpace& space, const PilotOptions& options,
                     const Eigen::Vector3d& from);
  void collectExpanded(const PilotOptions& options, const CandidateQuery& query);
  bool isApart(const PilotOptions& options, const Eigen::Vector3d& end) const;

  Directions directions_;
  Histogram histogram_;
  std::vector<std::pair<double, int>> order_;  // cost, bin; a heap
  std::vector<Candidate> found_;
  std::vector<Eigen::Vector3d> beside_;    // from the node, the points that `widening` is about
  std::vector<Eigen::Vector3d> expanded_;  // near the node
};

}  // namespace grid_path_planner::avoidance
