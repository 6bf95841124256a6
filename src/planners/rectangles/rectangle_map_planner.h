// Planning on rectangles instead of cells: the R-map (Ahn & Jeon 2010, Park 2013).
//
// prepare() cuts the map into rectangles (largestFirst); search() finds a sequence of them by
// RectangleMapOptions::rectangle_weight. The path leads through the middles of the shared borders, or is
// the shortest through these borders (rectangle_funnel). update() cuts anew the rectangles around a
// change and no others, however many updates came before: their number stays near that of a fresh
// decomposition (benchmark/rectangle_repair.cpp).
//
// Guaranteed: a legal path, wherever there is one: rectangles are connected where a vehicle can
// drive. With `length` the sequence of rectangles is the one whose path through the middles is the
// shortest, with funnel the path is the shortest through that sequence.
// Not guaranteed: the shortest of all paths; with the published weights not even a short one; after
// updates the path that a fresh planner finds.
#pragma once

#include <vector>

#include "grid_path_planner/planners/planner.h"
#include "grid_path_planner/planners/rectangle_graph.h"
#include "grid_path_planner/planners/rectangle_map_options.h"
#include "planners/rectangles/rectangle_route.h"

namespace grid_path_planner::planners {

class RectangleMapPlanner : public Planner {
 public:
  static PlannerTraits declaredTraits();

  explicit RectangleMapPlanner(const RectangleMapOptions& options = {});

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

  // Of the prepared map.
  const RectangleGraph& rectangles() const { return rectangles_; }

 private:
  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const std::vector<grid::CellRect>& changed, const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

  void addPath(const RectangleRoute& route, const SearchRequest& request,
               SearchResult& result) const;

  RectangleMapOptions options_;
  RectangleGraph rectangles_;
  RectangleSearch search_;
};

}  // namespace grid_path_planner::planners
