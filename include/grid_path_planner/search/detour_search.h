// From a start to where a tree of ways to the goal can be believed again: A* whose estimate are the
// tree's labels, and which ends at the first cell whose way still holds.
//
//   DetourSearch detour;
//   detour.prepare(map);
//   if (detour.run(labels, start, sound_below, false, result, poll)) use(detour.way(labels));
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
#include "grid_path_planner/search/bucket_queue.h"
#include "grid_path_planner/search/goal_labels.h"
#include "grid_path_planner/search/planner.h"
#include "grid_path_planner/search/tile_nodes.h"

namespace grid_path_planner {

class DetourSearch {
 public:
  void prepare(const CostGrid& map);

  // Whether a way was found. `start` has a label, and labels below `sound_below` are of sound ways.
  // Adds to the result's statistics, and to its cells that were expanded where `record` asks for
  // them. Throws Stopped.
  bool run(const GoalLabels& labels, GoalLabels::Index start, SearchKey sound_below, bool record,
           PlanResult& result, StopPoll& poll);

  // Of what run() found: its cost, how many cells it expanded for it, and the cells from the start
  // to the goal.
  SearchKey cost() const { return cost_; }
  std::uint64_t expanded() const { return expanded_; }
  std::vector<Cell> way(const GoalLabels& labels);
  // Whether a lower label of the cell may matter to what run() found.
  bool concerns(const GoalLabels& labels, GoalLabels::Index index) const;

  // Whether run() came past cells without a label.
  bool sawTheEnd() const { return saw_the_end_; }
  // Whether it left out ways that cost more than keys hold.
  bool tooDear() const { return too_dear_; }
  std::size_t bytes() const { return nodes_.bytes(); }

 private:
  using Index = GoalLabels::Index;
  using Node = TileNodes::Node;
  static constexpr SearchKey kNoCost = GoalLabels::kLargest;
  // Notes of a node: whether its way is sound, once known.
  static constexpr std::uint32_t kSound = 1, kUnsound = 2;

  bool sound(const GoalLabels& labels, Index index, Cell cell, Node& first);
  void expand(const GoalLabels& labels, Index index, Cell cell, Node& node, Statistics& counts);

  TileNodes nodes_;
  BucketQueue open_;
  std::vector<Node*> asked_;  // by sound()
  Index start_ = 0;
  Index last_ = 0;  // where the tree's way begins
  SearchKey sound_below_ = 0;
  SearchKey cost_ = kNoCost;
  std::uint64_t expanded_ = 0;
  unsigned bucket_shift_ = 0;
  bool saw_the_end_ = false;
  bool too_dear_ = false;
};

}  // namespace grid_path_planner
