// What AnyaSearch and PolyanyaSearch have in common: A* over interval nodes (I, r), where the root
// r is visible from every point of the interval I.
//
// A search derives from it: it calls startQuery(), pushes the interval nodes of the start with
// push(), and expands what popNode() gives in expandAll().
//
// Roots are the start and the corners at which a taut path turns. relax() prunes arrivals at a
// corner: one with a greater g-value than the corner's root has is dropped; one with a smaller
// g-value makes a new root, and the nodes of the old root are dropped when they are popped; of
// those with the same g-value, an arrival is expanded only if the interval beyond it is wider than
// those of the earlier arrivals that turn in the same sense.
//
// `Point` has x and y, operator- and cross(a, b), which is above 0 where b lies anticlockwise of a.
// `Node` has `root`, the number of its root.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/status.h"
#include "grid_path_planner/base/stop_token.h"
#include "planners/core/node_heap.h"

namespace grid_path_planner::planners {

inline double lengthOf(double x, double y) {
  return std::sqrt(x * x + y * y);
}

template <class Point>
double distance(Point a, Point b) {
  return lengthOf(double(a.x) - b.x, double(a.y) - b.y);
}

template <class Point, class Node>
class IntervalSearch {
 public:
  struct Answer {
    base::Status status = base::Status::UNREACHABLE;
    std::vector<Point> points;  // where FOUND: start, turning points, goal
    double length = 0.0;        // in the unit of the points
  };

 protected:
  enum Sense { ANTICLOCKWISE, CLOCKWISE };

  struct Root {
    Point at;
    double g;
    std::int32_t parent;     // -1 for the start
    std::int32_t widest[2];  // by Sense: the parent of the widest arrival with this g-value so far
    bool superseded;         // a root with a smaller g-value stands at the same corner
  };

  static constexpr double kTie = 1e-12;  // relative: sums of the same lengths in another order

  void startQuery(Point start, Point goal, base::Statistics& counts) {
    goal_ = goal;
    counts_ = &counts;
    incumbent_ = std::numeric_limits<double>::infinity();
    incumbent_root_ = -1;
    open_.clear();
    roots_.clear();
    roots_.push_back({start, 0.0, -1, {-1, -1}, false});
  }

  void push(double f, const Node& node) {
    open_.push(f, node);
    ++counts_->generated;
  }

  // The node with the least f-value whose root is not superseded. False where no node can lead to a
  // shorter path than the incumbent.
  bool popNode(Node& node) {
    while (!open_.empty() && open_.least() < incumbent_) {
      counts_->peak_open = std::max(counts_->peak_open, open_.size());
      node = open_.pop();
      if (!roots_[node.root].superseded) return true;
    }
    return false;
  }

  // Expands what next(node) gives until it is false. `interval`: expansions between two polls.
  template <class Next, class Expand>
  Answer expandAll(const base::StopToken& stop, std::uint32_t interval, const Next& next,
                   const Expand& expand) {
    base::StopPoll poll(stop, interval);
    for (Node node; next(node);) {
      const base::StopReason reason = poll.ask();
      if (reason != base::StopReason::NONE) return {base::Stopped(reason).status(), {}, 0.0};
      ++counts_->expanded;
      expand(node);
    }
    return incumbent_root_ < 0 ? Answer() : incumbentPath();
  }

  // The goal is visible from the root.
  void updateIncumbent(std::int32_t root) {
    const double length = roots_[root].g + distance(roots_[root].at, goal_);
    if (length >= incumbent_) return;
    incumbent_ = length;
    incumbent_root_ = root;
  }

  // The g-value of `at` on the path that turns last at `parent`.
  double gThrough(std::int32_t parent, Point at) const {
    return roots_[parent].g + distance(roots_[parent].at, at);
  }

  // The root at `corner` for the arrival from `parent` with the g-value `g`, -1 where the arrival
  // is pruned. `known`: the number of the corner's root, -1 where it has none.
  std::int32_t relax(std::int32_t& known, std::int32_t parent, Point corner, double g,
                     Sense sense) {
    if (known >= 0) {
      Root& root = roots_[known];
      if (g > root.g * (1.0 + kTie)) return -1;
      if (g >= root.g * (1.0 - kTie)) {
        std::int32_t& widest = root.widest[sense];
        if (widest >= 0) {
          const auto side = cross(corner - roots_[widest].at, corner - roots_[parent].at);
          if (sense == ANTICLOCKWISE ? side >= 0 : side <= 0) return -1;
        }
        widest = parent;
        return known;
      }
      root.superseded = true;
      ++counts_->reopened;
    }
    known = static_cast<std::int32_t>(roots_.size());
    Root root{corner, g, parent, {-1, -1}, false};
    root.widest[sense] = parent;
    roots_.push_back(root);
    return known;
  }

  // Of the roots and the open list at its longest.
  std::size_t bytes() const { return roots_.size() * sizeof(Root) + open_.bytes(); }

  Point goal_{};
  double incumbent_ =
      std::numeric_limits<double>::infinity();  // length of the shortest path so far
  std::vector<Root> roots_;
  NodeHeap<Node> open_;
  base::Statistics* counts_ = nullptr;

 private:
  Answer incumbentPath() const {
    Answer answer{base::Status::FOUND, {goal_}, incumbent_};
    for (std::int32_t at = incumbent_root_; at >= 0; at = roots_[at].parent)
      answer.points.push_back(roots_[at].at);
    std::reverse(answer.points.begin(), answer.points.end());
    return answer;
  }

  std::int32_t incumbent_root_ = -1;
};

}  // namespace grid_path_planner::planners
