// Anya: the shortest of all paths, at any angle, on maps of one weight (Harabor, Grastien, Oz &
// Aksakalli, "Optimal any-angle pathfinding in practice", JAIR 56, 2016).
//
// It searches over intervals of the lines between rows instead of over cells, straight on the bit
// maps, so a change of the map costs nothing beyond theirs. Unlike the published one it begins and
// ends inside cells. The turning points of a result are corners of blocked cells.
//
// Guaranteed: no legal any-angle path (costmap/line_of_sight.h) between the two waypoints is shorter, up
// to rounding (1e-12 of the length). Refused: maps of several weights, 4-connected ones, unit
// diagonals and cut corners.
#pragma once

#include <memory>

#include "grid_path_planner/planners/planner.h"

namespace grid_path_planner::planners {

class AnyaSearch;

class Anya : public Planner {
 public:
  static PlannerTraits declaredTraits();

  Anya();
  ~Anya() override;

  // The search grows with the corners that it turns at; this is what the densest maps need.
  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

 protected:
  void doPrepare(const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

 private:
  const costmap::BitMap* rows_ = nullptr;
  std::unique_ptr<AnyaSearch> search_;
};

}  // namespace grid_path_planner::planners
