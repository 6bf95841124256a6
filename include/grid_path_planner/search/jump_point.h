// Jump point search: A* over the few cells where a shortest path may have to turn (Harabor &
// Grastien, "Online Graph Pruning for Pathfinding on Grid Maps", AAAI 2011; the scan of whole words
// from "Improving Jump Point Search", ICAPS 2014; corners are not cut).
//
// For maps on which all passable cells weigh the same, with steps in eight directions, diagonals
// sqrt 2 long, corners not cut: there the cost is the least there is, without tolerance. Other maps
// are refused with the reason. The cells of the result are all steps, those between the turns too.
//
// plan() takes time and memory for the turns that it looks at, never in proportion to the map;
// update() repairs what the change touches. Costs are compared by 32-bit integers, and a search
// whose costs outgrow them (from 47,321 cell lengths on) is made again with 64-bit ones.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grid_path_planner/search/jump_maps.h"
#include "grid_path_planner/search/jump_nodes.h"
#include "grid_path_planner/search/planner.h"

namespace grid_path_planner {

class JumpPoint : public Planner {
 public:
  JumpPoint();

  std::size_t bytesFor(const GridGeometry& geometry) const override;

 protected:
  void doPrepare(const StopToken& stop) override;
  void doUpdate(const CellRect& changed, const StopToken& stop) override;
  PlanResult doPlan(const PlanRequest& request, const StopToken& stop) override;

 private:
  // None where the costs outgrow the keys.
  template <class Scale>
  std::optional<PlanResult> search(JumpNodes<typename Scale::Key>& nodes,
                                   const PlanRequest& request, const StopToken& stop);

  JumpMaps maps_;
  JumpNodes<std::uint32_t> nodes_;
  JumpNodes<std::uint64_t> large_nodes_;
};

}  // namespace grid_path_planner
