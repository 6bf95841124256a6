#include "avoidance/search/look_ahead_tree.h"

#include <algorithm>

namespace grid_path_planner::avoidance {

using Eigen::Vector3d;

int LookAheadTree::takeLeastCost(double spacing) {
  while (!open_.empty()) {
    const int best = open_.top().second;
    open_.pop();
    const Vector3d& position = nodes_[best].position;
    const auto same = [&](const Vector3d& other) { return (other - position).norm() < spacing; };
    if (std::any_of(expanded_.begin(), expanded_.end(), same)) continue;
    closed_.push_back(best);
    expanded_.push_back(position);
    return best;
  }
  return -1;
}

void LookAheadTree::add(const TreeNode& node) {
  open_.emplace(node.total, static_cast<int>(nodes_.size()));
  nodes_.push_back(node);
}

void LookAheadTree::grow(int parent, const OpenSpace& space, const PilotOptions& options,
                         const Vector3d& goal, const std::vector<Vector3d>& closed) {
  const TreeNode at = nodes_[parent];
  const Vector3d root = nodes_.front().position;
  const Angles root_goal = anglesOf(goal - root), before = nodes_.front().angles;
  const auto& found = candidates_.find(
      space, options, {at.position, anglesOf(goal - at.position), at.angles, closed, expanded_});
  for (const Candidate& candidate : found) {
    const double cost = options.accumulate ? at.cost + candidate.cost
                                           : directionCost(options, anglesOf(candidate.end - root),
                                                           root_goal, before);
    const double total = cost + estimate(options, candidate.end, goal);
    add({candidate.end, parent, candidate.angles, cost, total});
  }
}

double LookAheadTree::estimate(const PilotOptions& options, const Vector3d& place,
                               const Vector3d& goal) const {
  return std::max(options.heuristic_weight * (place - goal).norm(), learned_.at(place));
}

// Nothing where no node is open: then there is no path yet, whatever it costs.
void LookAheadTree::learn(const PilotOptions& options, double time) {
  const std::size_t count = closed_.size();
  const int next = takeLeastCost(sameNode(options));
  if (next < 0) return;
  for (std::size_t i = 0; i < count; ++i) {
    const TreeNode& node = nodes_[closed_[i]];
    learned_.learn(node.position, nodes_[next].total - node.cost, time);
  }
  closed_.pop_back();
  expanded_.pop_back();
}

std::vector<Vector3d> LookAheadTree::search(const OpenSpace& space, const PilotOptions& options,
                                            const Vector3d& start, const Vector3d& goal,
                                            const Angles& before,
                                            const std::vector<Vector3d>& closed, double time) {
  nodes_.clear();
  closed_.clear();
  expanded_.clear();
  open_ = {};
  add({start, -1, before, 0.0, 0.0});
  int last = 0;
  bool reached = false, finished = false;
  for (int count = 0; count < options.nodes; ++count) {
    const int next = takeLeastCost(sameNode(options));
    if (next < 0) break;
    last = next;
    reached = (nodes_[next].position - goal).norm() <= options.step;
    finished = reached || (nodes_[next].position - start).norm() > options.look_ahead;
    if (finished) break;
    grow(next, space, options, goal, closed);
  }
  if (!finished && options.accumulate && options.search == Search::TREE) learn(options, time);
  std::vector<Vector3d> path;
  for (int i = last; i >= 0; i = nodes_[i].parent) path.push_back(nodes_[i].position);
  std::reverse(path.begin(), path.end());
  if (reached && space.clear(path.back(), goal, options.d_safe)) path.push_back(goal);
  return path;
}

}  // namespace grid_path_planner::avoidance
