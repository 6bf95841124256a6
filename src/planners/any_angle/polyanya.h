// Polyanya: the shortest of all paths, at any angle, over rectangles instead of cells (Cui, Harabor
// & Grastien, "Compromise-free pathfinding on a navigation mesh", IJCAI 2017).
//
// prepare() cuts the map into rectangles as wide as the obstacles let them (mergedRuns), which are
// a convex mesh; a plan searches over what corners see of their borders. Unlike the published one
// it leaves out the rectangles that no shortest path between the two ends can enter, follows what
// it sees until it parts before it puts it into the open list, and makes a node of a turn only if
// it leads anywhere.
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

 protected:
  std::string refusal(const costmap::CostGrid& map) const override;
  void doPrepare(const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

 private:
  void refuseFor(std::size_t bytes);

  std::vector<grid::CellRect> rectangles_;
  RectangleIndex index_;
  PolyanyaMesh mesh_;
  std::unique_ptr<PolyanyaSearch> search_;
};

}  // namespace grid_path_planner::planners
