// Anya: the shortest any-angle path on maps of one weight (Harabor, Grastien, Oz &
// Aksakalli, "Optimal any-angle pathfinding in practice", JAIR 56, 2016).
//
// It searches over intervals of the lines between rows instead of over cells, directly on the bit
// maps, so an update of the map costs no more than theirs. Unlike the published algorithm it starts
// and ends inside cells. The turning points of a path are corners of blocked cells.
//
// Where the map keeps distances it searches the centre lattice too (lattice_search.h): the
// turning points of a path are centres of cells.
//
// Guaranteed: no legal any-angle path (costmap/line_of_sight.h) between the two waypoints is shorter, up
// to rounding (1e-12 of the length). Refused: maps of several weights, 4-connected ones, unit
// diagonals and cut corners.
#pragma once

#include <memory>
#include <vector>

#include "grid_path_planner/planners/planner.h"

namespace grid_path_planner::planners {

class AnyaSearch;
class LatticePlanner;

class Anya : public Planner {
 public:
  static PlannerTraits declaredTraits();

  Anya();
  ~Anya() override;

  // The memory grows with the roots of the search; this is for the densest maps.
  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

 private:
  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const std::vector<grid::CellRect>& changed, const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

  const costmap::BitMap* rows_ = nullptr;
  std::unique_ptr<AnyaSearch> search_;
  std::unique_ptr<LatticePlanner> lattice_;  // where distances are kept
};

}  // namespace grid_path_planner::planners
