// The original study's Dijkstra, so that it can be repeated: the next cell is found by a scan of all
// cells, every cell that can be reached is settled, and nothing ends the search at the goal. Of cells
// at the same distance the first in the order of PublishedGrid is settled; the publication does not
// say which.
//
// Guaranteed: the cost is the least there is. Time grows with the square of the number of cells.
//
// The original filled a matrix of a number for each pair of cells, matrixBytes(). Here the matrix is
// implicit: the entries of a row that are not zero are the at most eight neighbours, visited in the
// order of the row. That saves memory, and at most the half of the time, since the scan stays.
#pragma once

#include <cstdint>
#include <vector>

#include "study/programs/published_grid.h"

namespace grid_path_planner::study {

class PublishedDijkstra : public planners::Planner {
 public:
  static constexpr const char* kName = "dijkstra_published";

  PublishedDijkstra();

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

  // Of the original's matrix of 4-byte numbers, as a number since it may be many.
  static double matrixBytes(std::size_t cells) {
    return 4.0 * static_cast<double>(cells) * static_cast<double>(cells);
  }

 private:
  using Index = PublishedGrid::Index;

  std::string refusal(const costmap::CostGrid& map) const override {
    return PublishedGrid::refusal(map);
  }
  void doPrepare(const base::StopToken&) override { grid_.build(map()); }
  planners::SearchResult doSearch(const planners::SearchRequest& request,
                                  const base::StopToken& stop) override;

  void startQuery(Index start);
  Index nearestOpen() const;
  void settle(Index from, base::Statistics& counts);

  PublishedGrid grid_;
  std::vector<std::int64_t> distances_;
  std::vector<Index> parents_;
  std::vector<std::uint8_t> settled_;
};

}  // namespace grid_path_planner::study
