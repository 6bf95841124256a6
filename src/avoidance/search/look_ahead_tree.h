// The look-ahead tree of 3DVFH*: A* over steps in free directions.
//
// Of the node at hand at most `children` free directions, one step away and mutually at least `spacing`
// apart, enter the open list; the next node is the one with the least F = C + H, H the weighted distance to
// the goal, or what earlier searches have learned where that is more. A node nearer than `spacing` to one that
// was at hand before counts as that one, as A* closes a state once: else the same places are expanded over and
// over, and a dead end uses up all nodes. C is the sum of the costs of the directions along the branch, or
// (accumulate: false) the cost of the node's direction as it is seen from the root. The search ends at the goal,
// at a node beyond the look-ahead, which is not expanded, or after `nodes` nodes; the path leads to the last
// node at hand. A search whose nodes are used up learns (search: tree, accumulate: true): from a node that was
// at hand a path to the goal costs at least the least F of those still open, less its own C.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "avoidance/search/candidates.h"
#include "avoidance/search/learned_costs.h"

namespace grid_path_planner::avoidance {

struct TreeNode {
  Eigen::Vector3d position;
  int parent;     // index; -1: the root
  Angles angles;  // of the step that led here; of the root: chosen before
  double cost;    // C
  double total;   // F
};

class LookAheadTree {
 public:
  explicit LookAheadTree(const PilotOptions& options) : candidates_(options) {}

  // The path from `start` on, which it contains; only that where no direction is free. At `time`, s, it
  // learns.
  std::vector<Eigen::Vector3d> search(const OpenSpace& space, const PilotOptions& options,
                                      const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                                      const Angles& before,
                                      const std::vector<Eigen::Vector3d>& closed,
                                      double time = 0.0);

  // Of the last search, the root first.
  const std::vector<TreeNode>& nodes() const { return nodes_; }
  // The places that were at hand, in their order.
  const std::vector<Eigen::Vector3d>& expanded() const { return expanded_; }
  Candidates& candidates() { return candidates_; }
  // About the goal of the searches so far; to be forgotten before there is another one.
  LearnedCosts& learned() { return learned_; }
  // H.
  double estimate(const PilotOptions& options, const Eigen::Vector3d& place,
                  const Eigen::Vector3d& goal) const;

 private:
  void grow(int parent, const OpenSpace& space, const PilotOptions& options,
            const Eigen::Vector3d& goal, const std::vector<Eigen::Vector3d>& closed);
  void add(const TreeNode& node);
  // Closes the open node with the least F, of equal ones the first, that is at least `spacing` from every
  // closed one; -1: none is left.
  int takeLeastCost(double spacing);

  void learn(const PilotOptions& options, double time);

  Candidates candidates_;
  LearnedCosts learned_;
  std::vector<TreeNode> nodes_;
  std::vector<int> closed_;                // the nodes that were at hand
  std::vector<Eigen::Vector3d> expanded_;  // where those are
  using Open = std::pair<double, int>;     // F, index
  std::priority_queue<Open, std::vector<Open>, std::greater<Open>> open_;
};

}  // namespace grid_path_planner::avoidance
