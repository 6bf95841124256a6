// Polyanya: the shortest any-angle path over rectangles instead of cells (Cui, Harabor & Grastien,
// "Compromise-free pathfinding on a navigation mesh", IJCAI 2017).
//
// prepare() cuts the map into rectangles as wide as the obstacles let them (mergedRuns), which are
// a convex mesh; a search is over the intervals of their borders that are visible from corners.
// Unlike the published algorithm it leaves out the rectangles that no shortest path between the two
// ends can enter, projects an interval until it is split before it is pushed, and makes a node of a
// turn only if that has a successor.
//
// Where the map keeps distances it searches the centre lattice as Anya does (lattice_search.h), without
// rectangles: passages of one cell, which only a line leads through, are no part of a mesh.
//
// Guaranteed: no legal any-angle path (costmap/line_of_sight.h) between the two waypoints is shorter, up
// to rounding (1e-12 of the length). Refused: maps of several weights, 4-connected ones, unit
// diagonals, cut corners and maps of more than PolyanyaMesh::kMaxSide cells a side.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/planners/planner.h"
#include "planners/any_angle/polyanya_mesh.h"
#include "planners/rectangles/rectangle_index.h"

namespace grid_path_planner::planners {

class LatticePlanner;
class PolyanyaSearch;

class Polyanya : public Planner {
 public:
  static PlannerTraits declaredTraits();

  Polyanya();
  ~Polyanya() override;

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

  // Of the prepared map.
  const std::vector<grid::CellRect>& rectangles() const { return rectangles_; }
  const PolyanyaMesh& mesh() const { return mesh_; }

 private:
  std::string refusal(const costmap::CostGrid& map) const override;
  void doPrepare(const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

  void refuseFor(std::size_t bytes);

  std::vector<grid::CellRect> rectangles_;
  RectangleIndex index_;
  PolyanyaMesh mesh_;
  std::unique_ptr<PolyanyaSearch> search_;
  std::unique_ptr<LatticePlanner> lattice_;  // where distances are kept
};

}  // namespace grid_path_planner::planners
