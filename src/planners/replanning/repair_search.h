// From a start to where a tree of ways to the goal can be believed again: A* whose estimate are the
// tree's labels, and which ends at the first cell whose way still holds.
//
//   RepairSearch detour;
//   detour.prepare(map);
//   if (detour.run(labels, start, sound_below, false, result, poll)) use(detour.path(labels));
//
// After changes on a map a label is a lower bound of what a way from its cell costs (goal_tree.h
// sees to that), and exactly that cost where every step of the cell's way is supported: it is
// sound. So the search expands the cells around the changes, whose ways do not hold, and nothing
// beyond; where the start's own way is sound, nothing at all. It expands no cell that A* with a
// weaker estimate would not expand.
//
// What is found is not written into the labels: it would have to be taken back where the obstacle
// goes away. Idea: Tree Adaptive A* (Hernandez, Sun, Koenig & Meseguer, AAMAS 2011), which adapts.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/planners/bucket_queue.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/replanning/backward_nodes.h"
#include "planners/replanning/tile_nodes.h"

namespace grid_path_planner::planners {

class RepairSearch {
 public:
  void prepare(const costmap::CostGrid& map);

  // Whether a way was found. `start` has a label, and labels below `sound_below` are of sound ways.
  // Adds to the result's statistics, and to its cells that were expanded where `record` asks for
  // them. Throws Stopped.
  bool run(const BackwardNodes& labels, BackwardNodes::Index start, SearchKey sound_below,
           bool record, SearchResult& result, base::StopPoll& poll);

  // Of what run() found: its cost, how many cells it expanded for it, and the cells from the start
  // to the goal.
  SearchKey cost() const { return cost_; }
  std::uint64_t expanded() const { return expanded_; }
  std::vector<grid::Cell> path(const BackwardNodes& labels);
  // Whether a lower label of the cell may matter to what run() found.
  bool affects(const BackwardNodes& labels, BackwardNodes::Index index) const;

  // Whether run() came past cells without a label.
  bool leftTheTree() const { return left_the_tree_; }
  // Whether it left out ways that cost more than keys hold.
  bool overflowed() const { return overflowed_; }
  std::size_t bytes() const { return nodes_.bytes(); }

 private:
  using Index = BackwardNodes::Index;
  using Node = TileNodes::Node;
  static constexpr SearchKey kNoCost = BackwardNodes::kLargest;
  // Notes of a node: whether its way is sound, once known.
  static constexpr std::uint32_t kSound = 1, kUnsound = 2;

  bool consistentPath(const BackwardNodes& labels, Index index, grid::Cell cell, Node& first);
  void expand(const BackwardNodes& labels, Index index, grid::Cell cell, Node& node,
              base::Statistics& counts);

  TileNodes nodes_;
  BucketQueue open_;
  std::vector<Node*> checked_;  // by sound()
  Index start_ = 0;
  Index last_ = 0;  // where the tree's way begins
  SearchKey consistent_below_ = 0;
  SearchKey cost_ = kNoCost;
  std::uint64_t expanded_ = 0;
  unsigned bucket_shift_ = 0;
  bool left_the_tree_ = false;
  bool overflowed_ = false;
};

}  // namespace grid_path_planner::planners
