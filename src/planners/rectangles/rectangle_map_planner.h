// Planning on rectangles instead of cells: the R-map (Ahn & Jeon 2010, Park 2013).
//
// prepare() cuts the map into rectangles (largestFirst); a plan is a search over them by
// SearchOptions::rectangle_weight, whose path runs through the middles of the shared borders and is
// then pulled taut (rectangle_funnel). update() redoes the rectangles that a change touches, and no
// others, however many updates came before: their number stays near that of a map cut anew
// (benchmark/rectangle_repair.cpp).
//
// Guaranteed: a legal path, and one where there is one: rectangles are connected where a vehicle
// can drive. With `length` the sequence of rectangles is the one whose path through the middles is
// the shortest, with funnel the path is the shortest through that sequence.
// Not guaranteed: the shortest path there is; with the published weights not even a short one;
// after updates the path that a fresh planner finds.
#pragma once

#include "grid_path_planner/planners/planner.h"
#include "grid_path_planner/planners/rectangle_graph.h"
#include "grid_path_planner/planners/rectangle_route.h"
#include "grid_path_planner/planners/search_options.h"

namespace grid_path_planner::planners {

class RectangleMapPlanner : public Planner {
 public:
  static PlannerTraits declaredTraits();

  explicit RectangleMapPlanner(const SearchOptions& options = {});

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

  // Of the prepared map.
  const RectangleGraph& rectangles() const { return rectangles_; }

 protected:
  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const grid::CellRect& changed, const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

 private:
  void keep(const RectangleRoute& route, const SearchRequest& request, SearchResult& result) const;

  SearchOptions options_;
  RectangleGraph rectangles_;
  RectangleSearch search_;
};

}  // namespace grid_path_planner::planners
