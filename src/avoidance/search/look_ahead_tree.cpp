#include "avoidance/search/look_ahead_tree.h"

#include <algorithm>

namespace grid_path_planner::avoidance {

using Eigen::Vector3d;

int LookAheadTree::leastCostOpen() const {
  int best = -1;
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i)
    if (!nodes_[i].closed && (best < 0 || nodes_[i].total < nodes_[best].total)) best = i;
  return best;
}

void LookAheadTree::grow(int parent, const OpenSpace& space, const PilotOptions& options,
                         const Vector3d& goal, const std::vector<Vector3d>& closed) {
  const TreeNode at = nodes_[parent];
  const Vector3d root = nodes_.front().position;
  const Angles root_goal = anglesOf(goal - root), before = nodes_.front().angles;
  const auto& found = candidates_.find(space, options, at.position, anglesOf(goal - at.position),
                                       at.angles, closed);
  for (const Candidate& candidate : found) {
    const double cost = options.accumulate ? at.cost + candidate.cost
                                           : directionCost(options, anglesOf(candidate.end - root),
                                                           root_goal, before);
    const double total = cost + options.heuristic_weight * (candidate.end - goal).norm();
    nodes_.push_back({candidate.end, parent, candidate.angles, cost, total, false});
  }
}

std::vector<Vector3d> LookAheadTree::search(const OpenSpace& space, const PilotOptions& options,
                                            const Vector3d& start, const Vector3d& goal,
                                            const Angles& before,
                                            const std::vector<Vector3d>& closed) {
  nodes_.clear();
  nodes_.push_back({start, -1, before, 0.0, 0.0, false});
  int last = 0;
  bool reached = false;
  for (int count = 0; count < options.nodes; ++count) {
    const int next = leastCostOpen();
    if (next < 0) break;
    last = next;
    nodes_[next].closed = true;
    reached = (nodes_[next].position - goal).norm() <= options.step;
    if (reached || (nodes_[next].position - start).norm() > options.look_ahead) break;
    grow(next, space, options, goal, closed);
  }
  std::vector<Vector3d> path;
  for (int i = last; i >= 0; i = nodes_[i].parent) path.push_back(nodes_[i].position);
  std::reverse(path.begin(), path.end());
  if (reached && space.clear(path.back(), goal, options.d_safe)) path.push_back(goal);
  return path;
}

}  // namespace grid_path_planner::avoidance
