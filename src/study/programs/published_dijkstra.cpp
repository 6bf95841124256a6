#include "study/programs/published_dijkstra.h"

#include <limits>

namespace grid_path_planner::study {

using base::Statistics, base::Status, base::Stopped, base::StopPoll, base::StopReason,
    base::StopToken;
using grid::GridGeometry;
using planners::PlannerTraits, planners::SearchRequest, planners::SearchResult;

namespace {

constexpr std::int64_t kFarthest = std::numeric_limits<std::int64_t>::max();

PlannerTraits traitsOfDijkstra() {
  PlannerTraits traits;
  traits.name = PublishedDijkstra::kName;
  traits.optimal = true;
  return traits;
}

}  // namespace

PublishedDijkstra::PublishedDijkstra() : Planner(traitsOfDijkstra()) {}

std::size_t PublishedDijkstra::bytesFor(const GridGeometry& geometry) const {
  return PublishedGrid::bytesFor(geometry) +
         geometry.size() * (sizeof(std::int64_t) + sizeof(Index) + sizeof(std::uint8_t));
}

void PublishedDijkstra::startQuery(Index start) {
  distances_.assign(grid_.size(), kFarthest);
  parents_.assign(grid_.size(), PublishedGrid::kNone);
  settled_.assign(grid_.size(), 0);
  distances_[start] = 0;
}

PublishedGrid::Index PublishedDijkstra::nearestOpen() const {
  std::int64_t least = kFarthest;
  Index nearest = PublishedGrid::kNone;
  for (Index cell = 0; cell < distances_.size(); ++cell)
    if (settled_[cell] == 0 && distances_[cell] < least) {
      least = distances_[cell];
      nearest = cell;
    }
  return nearest;
}

void PublishedDijkstra::settle(Index from, Statistics& counts) {
  settled_[from] = 1;
  ++counts.expanded;
  grid_.anyNeighbour(from, [&](Index to) {
    const std::int64_t distance = distances_[from] + grid_.largerValue(from, to);
    if (settled_[to] != 0 || distances_[to] <= distance) return false;
    distances_[to] = distance;
    parents_[to] = from;
    ++counts.generated;
    return false;
  });
}

SearchResult PublishedDijkstra::doSearch(const SearchRequest& request, const StopToken& stop) {
  const Index start = grid_.index(request.start), goal = grid_.index(request.goals.front());
  startQuery(start);
  SearchResult result;
  Statistics& counts = result.statistics;
  counts.generated = 1;
  counts.search_bytes = bytesFor(map().geometry());
  StopPoll poll(stop, 16);  // a scan each
  for (Index from = start; from != PublishedGrid::kNone; from = nearestOpen()) {
    const StopReason reason = poll.ask();
    if (reason != StopReason::NONE) {
      result.status = Stopped(reason).status();
      return result;
    }
    if (request.record_expanded)
      result.expanded.push_back(map().geometry().index(grid_.cell(from)));
    settle(from, counts);
  }
  result.status = Status::UNREACHABLE;
  if (settled_[goal] == 0) return result;
  return grid_.pathBetween(map(), parents_, start, goal, std::move(result));
}

}  // namespace grid_path_planner::study
