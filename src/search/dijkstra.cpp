#include "grid_path_planner/search/dijkstra.h"

#include <algorithm>

namespace grid_path_planner {
namespace {

Traits dijkstraTraits() {
  Traits traits;
  traits.name = "dijkstra";
  traits.optimal = true;
  traits.several_goals = true;
  traits.repairs = true;
  return traits;
}

}  // namespace

Dijkstra::Dijkstra() : Planner(dijkstraTraits()) {}

std::size_t Dijkstra::bytesFor(const GridGeometry& geometry) const {
  return BucketSearch::bytesFor(geometry);
}

void Dijkstra::doPrepare(const StopToken& stop) {
  search_.prepare(map(), stop);
}

void Dijkstra::doUpdate(const CellRect& changed, const StopToken& stop) {
  search_.update(map(), changed, stop);
}

PlanResult Dijkstra::doPlan(const PlanRequest& request, const StopToken& stop) {
  std::vector<std::uint32_t> goals;
  for (const Cell goal : request.goals) goals.push_back(map().geometry().index(goal).value());
  std::sort(goals.begin(), goals.end());
  const auto isGoal = [&goals](std::uint32_t index) {
    return std::binary_search(goals.begin(), goals.end(), index);
  };
  return search_.run(map(), request.start, isGoal, noEstimate, request.record_expanded, stop);
}

}  // namespace grid_path_planner
