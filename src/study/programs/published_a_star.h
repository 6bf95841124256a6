// The original study's A*, as listed, so that it can be repeated. It guarantees no least cost.
//
// The open list is a set of (f, (row, column)) with f = g + h truncated to an integer, so cells of
// the same f are taken by the smaller row, then by the smaller column, and h counts in cells of the
// map searched, whatever they weigh. A closed cell is never opened again. The search ends when the
// goal is generated, before anything else is asked of it. Neighbours come in the order of
// PublishedGrid.
//
// Where the original's text and its listing differ, or the text says two things, there are programs
// for both:
//
//   a_star_published           as listed: occupied cells are skipped
//   a_star_published_crossing  as the text's paths lead: occupied cells cost what they weigh
//   a_star_published_values    the same, and a step costs the value of the cell that it enters: the
//                              reading of "the values of the map are switched" of its experiment
//                              with weights; the others cost the larger of a step's two cells
//
// With the published tie-break h is cross() alone, and 1000 in occupied cells.
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "grid_path_planner/planners/a_star_options.h"
#include "study/programs/published_grid.h"

namespace grid_path_planner::study {

class PublishedAStar : public planners::Planner {
 public:
  struct Variation {
    bool skips_occupied = true;
    bool costs_entered = false;    // a step costs the cell that it enters, not the larger of two
    bool published_cross = false;  // the published tie-break
  };

  // `options`: heuristic, heuristic_scale and epsilon. Throws InputError for options that cannot be
  // used and for heuristics that are tables.
  PublishedAStar(const char* name, const planners::AStarOptions& options,
                 const Variation& variation);

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

 private:
  using Index = PublishedGrid::Index;
  using OpenList = std::set<std::pair<std::int64_t, Index>>;

  std::string refusal(const costmap::CostGrid& map) const override {
    return PublishedGrid::refusal(map);
  }
  void doPrepare(const base::StopToken& stop) override;
  planners::SearchResult doSearch(const planners::SearchRequest& request,
                                  const base::StopToken& stop) override;

  void startQuery(Index start, Index goal);
  bool expand(Index from, base::Statistics& counts);
  double estimate(Index cell) const;
  double distance(Index cell) const;
  double cross(Index cell) const;
  std::int64_t stepCost(Index from, Index to) const;

  planners::AStarOptions options_;
  Variation variation_;
  double scale_ = 1.0;
  PublishedGrid grid_;
  OpenList open_;
  std::vector<std::int64_t> g_;  // kUnknown where not generated
  std::vector<Index> parents_;
  std::vector<std::uint8_t> closed_;
  Index start_ = 0;
  Index goal_ = 0;
};

}  // namespace grid_path_planner::study
