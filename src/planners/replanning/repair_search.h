// Repair search: A* forward from the start until it reaches a part of the backward search tree that
// is still consistent. Its heuristic is the tree's g-values.
//
//   RepairSearch repair;
//   repair.prepare(map);
//   if (repair.run(nodes, start, consistent_below, false, result, poll, most))
//     use(repair.path(nodes));
//
// After changes of the map a g-value of the tree is a lower bound of the cost-to-go of its cell
// (backward_search_tree.h ensures that), and equal to it where every cell of the cell's path is
// consistent. So the search expands cells around the changes, whose paths are inconsistent, and
// nothing beyond; where the start's own path is consistent, nothing at all. It expands no cell that
// A* with a weaker heuristic would not expand.
//
// The path found is not written into the tree: that would have to be undone when the obstacle
// disappears. Idea: Tree Adaptive A* (Hernandez, Sun, Koenig & Meseguer, AAMAS 2011), which does
// write it.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/core/bucket_queue.h"
#include "planners/replanning/backward_nodes.h"
#include "planners/replanning/tile_nodes.h"

namespace grid_path_planner::planners {

// Thrown where a repair would have to expand more cells than it may.
struct TooManyCells {};

class RepairSearch {
 public:
  void prepare(const costmap::CostGrid& map);

  // Whether a path was found. Paths of cells with g-values below `consistent_below` are consistent.
  // Adds to the result's statistics and, with `record`, to its expanded cells. Throws Stopped, and
  // TooManyCells where it would have to expand more than `most`.
  // Precondition: `start` has a g-value.
  bool run(const BackwardNodes& tree, BackwardNodes::Index start, SearchKey consistent_below,
           bool record, SearchResult& result, base::StopPoll& poll, std::uint64_t most);

  // Of the last run(): the cost of the path, the number of expanded cells, and the path's cells from
  // the start to the goal.
  SearchKey cost() const { return cost_; }
  std::uint64_t expanded() const { return expanded_; }
  std::vector<grid::Cell> path(const BackwardNodes& tree);
  // Whether a lower g-value of the cell may make a cheaper path possible than run() found.
  bool affects(const BackwardNodes& tree, BackwardNodes::Index index) const;

  // Whether run() reached cells without a g-value.
  bool leftTheTree() const { return left_the_tree_; }
  // Whether run() left out paths that cost more than keys can hold.
  bool overflowed() const { return overflowed_; }
  std::size_t bytes() const { return nodes_.bytes(); }

 private:
  using Index = BackwardNodes::Index;
  using Node = TileNodes::Node;
  static constexpr SearchKey kNoCost = BackwardNodes::kLargest;
  // Notes of a node: whether the tree's path from its cell is consistent, once known.
  static constexpr std::uint32_t kConsistent = 1, kInconsistent = 2;

  bool consistentPath(const BackwardNodes& tree, Index index, grid::Cell cell, Node& first);
  void expand(const BackwardNodes& tree, Index index, grid::Cell cell, Node& node,
              base::Statistics& counts);

  TileNodes nodes_;
  BucketQueue open_;
  std::vector<Node*> checked_;  // by consistentPath()
  Index start_ = 0;
  Index last_ = 0;  // where the path continues along the tree
  SearchKey consistent_below_ = 0;
  SearchKey cost_ = kNoCost;
  std::uint64_t expanded_ = 0;
  unsigned bucket_shift_ = 0;
  bool left_the_tree_ = false;
  bool overflowed_ = false;
};

}  // namespace grid_path_planner::planners
