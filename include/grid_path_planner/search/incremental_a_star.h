// Replanning for a vehicle on its way: the same goal, a start that moves along, a map that changes
// a little between two plans.
//
//   IncrementalAStar planner;
//   planner.prepare(map, stop);
//   planner.plan({start, {goal}}, stop);           // a whole search, backwards from the goal
//   planner.update(changed_map, rectangle, stop);
//   planner.plan({moved_start, {goal}}, stop);     // a repair of it
//
// The search's tree is kept and repaired (goal_tree.h: D* Lite). A repair that takes more than a
// share of what a fresh search takes is put off, and the plan is answered by A* from the start: so
// a plan for the same goal never takes much more than A* takes, and the next one goes on with the
// repair. Whether it is put off is decided by counts of cells, never by a clock.
//
// Guaranteed: the least cost, exactly, on every map and motion model. Not guaranteed: which of
// equally cheap paths, as that depends on the plans before. A single plan for a new goal takes
// longer than a_star's: without replanning this is not the planner to choose.
#pragma once

#include "grid_path_planner/search/bucket_search.h"
#include "grid_path_planner/search/goal_tree.h"
#include "grid_path_planner/search/planner.h"

namespace grid_path_planner {

class IncrementalAStar : public Planner {
 public:
  IncrementalAStar();

  std::size_t bytesFor(const GridGeometry& geometry) const override;

  // How often plan() was answered how, since this planner was made.
  struct Strategies {
    std::uint64_t begun = 0;     // a tree for a new goal
    std::uint64_t repaired = 0;  // the tree kept or repaired
    std::uint64_t fresh = 0;     // A* from the start, the repair being put off
  };
  const Strategies& strategies() const { return strategies_; }

 protected:
  void doPrepare(const StopToken& stop) override;
  void doUpdate(const CellRect& changed, const StopToken& stop) override;
  PlanResult doPlan(const PlanRequest& request, const StopToken& stop) override;

 private:
  std::uint64_t repairLimit(Cell start) const;
  GoalTree::Outcome planByTree(const PlanRequest& request, PlanResult& result,
                               const StopToken& stop);
  PlanResult planAfresh(const PlanRequest& request, const PlanResult& so_far,
                        const StopToken& stop);

  GoalTree tree_;
  BucketSearch fresh_;
  Strategies strategies_;
  std::uint64_t first_expanded_ = 0;  // by the search that began the tree
  SearchKey first_cost_ = 1;          // of what it found
};

}  // namespace grid_path_planner
