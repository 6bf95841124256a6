// Jump point search: A* over the few cells where a shortest path may have to turn (Harabor &
// Grastien, "Online Graph Pruning for Pathfinding on Grid Maps", AAAI 2011; the scan of whole words
// from "Improving Jump Point Search", ICAPS 2014; corners are not cut).
//
// For maps on which all passable cells weigh the same, with steps in eight directions, diagonals
// sqrt 2 long, corners not cut: there the cost is the least there is, without tolerance. Other maps
// are refused with the reason. The result has all cells of the path, not only the jump points.
//
// A search takes time and memory for the jump points that it generates, never in proportion to the
// map; update() repairs what the change affects. Costs are compared by 32-bit integers, and a
// search whose costs overflow them (from 47,321 cell lengths on) is repeated with 64-bit ones.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grid_path_planner/planners/planner.h"
#include "planners/core/radix_heap.h"
#include "planners/jump_point/hashed_nodes.h"
#include "planners/jump_point/jump_point_bits.h"

namespace grid_path_planner::planners {

class JumpPoint : public Planner {
 public:
  static PlannerTraits declaredTraits();

  JumpPoint();

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

 private:
  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const std::vector<grid::CellRect>& changed, const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

  template <class Key>
  struct Memory {
    HashedNodes<Key> nodes;
    RadixHeap<Key> open;

    std::size_t bytes() const {
      return nodes.bytes() + open.peakSize() * sizeof(typename RadixHeap<Key>::Entry);
    }
  };
  // None where a cost overflows the keys.
  template <class Scale>
  std::optional<SearchResult> searchWith(Memory<typename Scale::Key>& memory,
                                         const SearchRequest& request, const base::StopToken& stop);

  JumpPointBits jump_points_;
  Memory<std::uint32_t> small_;
  Memory<std::uint64_t> large_;
};

}  // namespace grid_path_planner::planners
