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

#include "grid_path_planner/planners/planner.h"
#include "planners/jump_point/hashed_nodes.h"
#include "planners/jump_point/jump_point_bits.h"

namespace grid_path_planner::planners {

class JumpPoint : public Planner {
 public:
  static PlannerTraits declaredTraits();

  JumpPoint();

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

 protected:
  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const grid::CellRect& changed, const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

 private:
  // None where the costs outgrow the keys.
  template <class Scale>
  std::optional<SearchResult> searchFrom(HashedNodes<typename Scale::Key>& nodes,
                                         const SearchRequest& request, const base::StopToken& stop);

  JumpPointBits maps_;
  HashedNodes<std::uint32_t> nodes_;
  HashedNodes<std::uint64_t> large_nodes_;
};

}  // namespace grid_path_planner::planners
