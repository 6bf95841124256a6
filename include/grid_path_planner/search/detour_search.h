// From a start to where a tree of ways to the goal can be believed again: A* whose estimate are the
// tree's labels, and which ends at the first cell whose way still holds.
//
//   DetourSearch detour;
//   if (detour.run(labels, start, sound_below, false, result, poll)) {
//     detour.learn(labels);
//     use(detour.cost());
//   }
//
// After changes on a map a label is a lower bound of what a way from its cell costs (goal_tree.h
// sees to that), and exactly that cost where every step of the cell's way is supported: it is
// sound. So the search expands the cells around the changes, whose ways do not hold, and nothing
// beyond; where the start's own way is sound, nothing at all. It expands no cell that A* with a
// weaker estimate would not expand.
//
// learn() writes down what was found: the way of the start, and of every expanded cell that its way
// costs at least what the cost found leaves for it (Adaptive A*: Koenig & Likhachev, AAMAS 2005;
// ending at the tree: Hernandez, Sun, Koenig & Meseguer, AAMAS 2011). So the same detour is not
// searched for twice.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/search/goal_labels.h"
#include "grid_path_planner/search/jump_nodes.h"
#include "grid_path_planner/search/planner.h"

namespace grid_path_planner {

class DetourSearch {
 public:
  // Whether a way was found. `start` has a label, and labels below `sound_below` are of sound ways.
  // Adds to the result's statistics, and to its cells that were expanded where `record` asks for
  // them. Throws Stopped.
  bool run(const GoalLabels& labels, GoalLabels::Index start, SearchKey sound_below, bool record,
           PlanResult& result, StopPoll& poll);

  // Of what run() found, and the cell from which the tree's way is followed.
  SearchKey cost() const { return cost_; }
  // Precondition: run() found a way and nothing changed since.
  void learn(GoalLabels& labels) const;

  // Whether run() came past cells without a label.
  bool sawTheEnd() const { return saw_the_end_; }
  // Whether it left out ways that cost more than keys hold.
  bool tooDear() const { return too_dear_; }
  // Of run(), at its most.
  std::size_t bytes() const { return nodes_.bytes(); }

 private:
  using Index = GoalLabels::Index;
  using Nodes = JumpNodes<SearchKey>;
  // Bits of a node's `arrived`: it has a g; it was expanded; whether its way is sound, once known.
  static constexpr std::uint8_t kReached = 1, kExpanded = 2, kSound = 4, kUnsound = 8;

  std::uint32_t nodeOf(const GoalLabels& labels, Index index) {
    return nodes_.find(labels.cell(index));
  }
  Index indexOf(const GoalLabels& labels, std::uint32_t number) const {
    return labels.geometry().index(nodes_.cell(number)).value();
  }
  bool sound(const GoalLabels& labels, Index index, SearchKey sound_below);
  void expand(const GoalLabels& labels, std::uint32_t number, SearchKey sound_below,
              Statistics& counts);

  Nodes nodes_;
  std::vector<std::uint32_t> way_;  // nodes, of sound()
  SearchKey cost_ = kInfiniteKey;
  std::uint32_t last_ = 0;  // node from which the tree's way is followed
  SearchKey reached_ = 0;   // the largest promise of what was taken out so far
  bool saw_the_end_ = false;
  bool too_dear_ = false;
};

}  // namespace grid_path_planner
