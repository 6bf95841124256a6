// Dijkstra's algorithm over the cells of a grid (Dijkstra 1959).
//
// Guaranteed: the cost is the least there is, on every map and motion model, and of several goals
// the one that is answered is the cheapest to reach: which is what it is for where A* is not.
#pragma once

#include "grid_path_planner/search/bucket_search.h"
#include "grid_path_planner/search/planner.h"

namespace grid_path_planner {

class Dijkstra : public Planner {
 public:
  Dijkstra();

  std::size_t bytesFor(const GridGeometry& geometry) const override;

 protected:
  void doPrepare(const StopToken& stop) override;
  void doUpdate(const CellRect& changed, const StopToken& stop) override;
  PlanResult doPlan(const PlanRequest& request, const StopToken& stop) override;

 private:
  BucketSearch search_;
};

}  // namespace grid_path_planner
