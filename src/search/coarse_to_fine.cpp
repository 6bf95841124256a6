#include "grid_path_planner/search/coarse_to_fine.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <sstream>
#include <utility>

namespace grid_path_planner {
namespace {

constexpr std::uint64_t kEffort = 8;  // of the second search, in expansions of the first

Traits coarseToFineTraits() {
  Traits traits;
  traits.name = "coarse_to_fine";
  traits.repairs = true;
  return traits;
}

// The best closed form for the map's motion model, whatever A* would be guided by.
SearchOptions guide() {
  SearchOptions options;
  options.heuristic = Heuristic::LANDMARK;  // without its tables
  return options;
}

double octile(Cell a, Cell b) {
  const int columns = std::abs(a.column - b.column);
  const int rows = std::abs(a.row - b.row);
  return std::max(columns, rows) + (std::sqrt(2.0) - 1.0) * std::min(columns, rows);
}

struct OpenRegion {
  double promise;
  RegionMap::Id id;
  bool operator<(const OpenRegion& other) const {
    return promise != other.promise ? promise > other.promise : id > other.id;
  }
};

struct KnownRegion {
  double cost = 0.0;
  RegionMap::Id from = 0;
  bool closed = false;
};

// A little below the cost that the key stands for: keys are rounded up by less than 1e-19.
double costOfKey(SearchKey key, int kernel) {
  return static_cast<double>(key) / static_cast<double>(kStraightKey) * kernel * (1.0 - 1e-14);
}

}  // namespace

CoarseToFine::CoarseToFine(const SearchOptions& options)
    : Planner(coarseToFineTraits()), options_(options) {
  checkSearchOptions(options);
}

// At the worst the second search visits every cell.
std::size_t CoarseToFine::bytesFor(const GridGeometry& geometry) const {
  const std::size_t cells = geometry.size();
  return RegionMap::bytesFor(geometry) + cells * (1 + sizeof(Node));
}

void CoarseToFine::doPrepare(const StopToken& stop) {
  masks_.build(map(), stop);
  regions_.build(map(), masks_, stop);
  const auto sectors =
      static_cast<std::size_t>(regions_.columns()) * static_cast<std::size_t>(regions_.rows());
  corridor_.assign(sectors, 0);
  marked_.clear();
  places_.assign(sectors, kNoNodes);
  visited_.clear();
  nodes_.clear();
}

void CoarseToFine::doUpdate(const CellRect& changed, const StopToken& stop) {
  masks_.update(map(), changed, stop);
  regions_.update(map(), masks_, changed, stop);
}

PlanResult CoarseToFine::doPlan(const PlanRequest& request, const StopToken& stop) {
  const Cell goal = request.goals.front();
  PlanResult result;
  result.status = Status::UNREACHABLE;
  const auto way = wayOverRegions(request.start, goal, result, request.record_expanded, stop);
  if (way.empty()) return result;
  markCorridor(way);

  // 1. Inside the corridor.
  const Estimate estimate(guide(), map(), request.start, goal);
  const std::uint64_t before = result.statistics.expanded;
  Outcome best = search(request, {true, kInfiniteKey, kInfiniteKey, ~std::uint64_t{0}}, estimate,
                        result, stop);
  if (best.cost == kInfiniteKey) return result;
  result.cells = pathTo(request.start, goal);
  SearchKey bound = std::max(estimate(request.start), std::min(best.bound, best.cost));

  // 2. Everywhere, as far as the answer asks for it.
  const auto enough =
      static_cast<SearchKey>(static_cast<double>(best.cost) / options_.accuracy) + 1;
  if (bound < enough) {
    const std::uint64_t effort = kEffort * (result.statistics.expanded - before);
    const Outcome second =
        search(request, {false, best.cost, enough, effort}, estimate, result, stop);
    if (second.cost < best.cost) result.cells = pathTo(request.start, goal);
    best.cost = std::min(best.cost, second.cost);
    bound = std::max(bound, std::min(second.bound, best.cost));
  }
  describe(result, bound);
  return result;
}

std::vector<RegionMap::Id> CoarseToFine::wayOverRegions(Cell start, Cell goal, PlanResult& result,
                                                        bool record_expanded,
                                                        const StopToken& stop) const {
  const GridGeometry& geometry = map().geometry();
  const RegionMap::Id first = regions_.regionAt(geometry, start);
  const RegionMap::Id last = regions_.regionAt(geometry, goal);
  std::unordered_map<RegionMap::Id, KnownRegion> known;
  std::priority_queue<OpenRegion> open;
  std::vector<RegionMap::Id> ids;
  StopPoll poll(stop, 256);
  known[first] = {0.0, first, false};
  open.push({0.0, first});
  while (!open.empty()) {
    poll();
    const RegionMap::Id from = open.top().id;
    open.pop();
    KnownRegion& at = known[from];
    if (at.closed) continue;
    at.closed = true;
    if (from == last) break;
    const RegionMap::Region& region = regions_.region(from);
    ++result.statistics.expanded;
    if (record_expanded) result.expanded.push_back(geometry.index(region.middle));
    const double cost = at.cost;
    regions_.neighbours(geometry, masks_, from, ids);
    for (const RegionMap::Id id : ids) {
      const RegionMap::Region& to = regions_.region(id);
      const double next =
          cost + octile(region.middle, to.middle) * 0.5 * (region.weight + to.weight);
      const auto inserted = known.insert({id, {next, from, false}});
      KnownRegion& there = inserted.first->second;
      if (!inserted.second && there.cost <= next) continue;
      there = {next, from, false};
      open.push({next + octile(to.middle, goal) * map().cheapest(), id});
      ++result.statistics.generated;
    }
  }
  std::vector<RegionMap::Id> way;
  if (known.count(last) == 0) return way;
  for (RegionMap::Id id = last;; id = known[id].from) {
    way.push_back(id);
    if (id == first) break;
  }
  return way;
}

// The sectors of the way and those around them.
void CoarseToFine::markCorridor(const std::vector<RegionMap::Id>& way) {
  for (const std::uint32_t sector : marked_) corridor_[sector] = 0;
  marked_.clear();
  for (const RegionMap::Id id : way) {
    const int column = static_cast<int>(id >> 8) % regions_.columns();
    const int row = static_cast<int>(id >> 8) / regions_.columns();
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, regions_.rows() - 1); ++r)
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, regions_.columns() - 1);
           ++c) {
        const auto sector = static_cast<std::uint32_t>(r * regions_.columns() + c);
        if (corridor_[sector] == 0) marked_.push_back(sector);
        corridor_[sector] = 1;
      }
  }
}

CoarseToFine::Node& CoarseToFine::node(Cell cell) {
  const std::uint32_t sector = regions_.sectorOf(cell);
  std::uint32_t& place = places_[sector];
  if (place == kNoNodes) {
    place = static_cast<std::uint32_t>(visited_.size());
    visited_.push_back(sector);
    if (nodes_.size() < visited_.size()) nodes_.push_back(std::make_unique<Nodes>());
    nodes_[place]->fill({kInfiniteKey, 0, false});
  }
  constexpr int kMask = RegionMap::kSide - 1;
  const int local = (cell.row & kMask) << RegionMap::kShift | (cell.column & kMask);
  return (*nodes_[place])[static_cast<std::size_t>(local)];
}

void CoarseToFine::forgetNodes() {
  for (const std::uint32_t sector : visited_) places_[sector] = kNoNodes;
  visited_.clear();
}

CoarseToFine::Outcome CoarseToFine::search(const PlanRequest& request, const Task& task,
                                           const Estimate& estimate, PlanResult& result,
                                           const StopToken& stop) {
  const GridGeometry& geometry = map().geometry();
  const Cell goal = request.goals.front();
  const SearchKey width = kStraightKey * std::max<SearchKey>(map().cheapest(), 1) / 2;
  Statistics& counts = result.statistics;
  const std::uint64_t most = counts.expanded + std::min(task.most_expanded, ~counts.expanded);
  StopPoll poll(stop);
  Outcome outcome;
  forgetNodes();
  node(request.start) = {0, 0, false};
  const SearchKey first = estimate(request.start);
  open_.begin(first, 63U - static_cast<unsigned>(__builtin_clzll(width)));
  open_.push(first, geometry.index(request.start).value());
  while (!open_.empty()) {
    poll();
    counts.peak_open = std::max(counts.peak_open, open_.size());
    const SearchKey lowest = open_.lowest();
    const SearchKey useless = std::min(outcome.cost, task.known);
    if (lowest >= std::min(useless, task.enough) || counts.expanded >= most) {
      outcome.bound = std::min(outcome.bound, lowest);
      break;
    }
    const Cell cell = geometry.cell(CellIndex(open_.pop()));
    Node& from = node(cell);
    if (from.closed || saturatingSum(from.cost, estimate(cell)) >= useless) continue;
    from.closed = true;
    ++counts.expanded;
    if (request.record_expanded) result.expanded.push_back(geometry.index(cell));
    if (cell == goal) {
      outcome.cost = from.cost;
      continue;
    }
    const SearchKey cost = from.cost;
    for (unsigned mask = masks_[geometry.index(cell).value()]; mask != 0; mask &= mask - 1) {
      const auto step = static_cast<std::size_t>(__builtin_ctz(mask));
      const Cell to{cell.column + kSteps[step].column, cell.row + kSteps[step].row};
      const SearchKey length = step < 4 ? kStraightKey : diagonalKey(map().motion().diagonal_cost);
      const SearchKey to_cost = cost + length * std::max(map().weight(cell), map().weight(to));
      if (to_cost > kLargestKey) throw CostOverflow();
      const SearchKey promise = saturatingSum(to_cost, estimate(to));
      if (task.in_corridor && corridor_[regions_.sectorOf(to)] == 0) {
        outcome.bound = std::min(outcome.bound, promise);
        continue;
      }
      Node& there = node(to);
      if (there.cost <= to_cost || promise >= useless) continue;
      if (there.closed) ++counts.reopened;
      there = {to_cost, static_cast<std::uint8_t>(step), false};
      open_.push(promise, geometry.index(to).value());
      ++counts.generated;
    }
  }
  counts.search_bytes = RegionMap::bytesFor(geometry) + geometry.size() +
                        nodes_.size() * sizeof(Nodes) + counts.peak_open * sizeof(std::uint32_t);
  return outcome;
}

std::vector<Cell> CoarseToFine::pathTo(Cell start, Cell goal) {
  std::vector<Cell> cells;
  for (Cell at = goal; at != start;) {
    cells.push_back(at);
    const Cell step = kSteps[node(at).step];
    at = {at.column - step.column, at.row - step.row};
  }
  cells.push_back(start);
  std::reverse(cells.begin(), cells.end());
  return cells;
}

void CoarseToFine::describe(PlanResult& result, SearchKey bound) const {
  result.status = Status::FOUND;
  result.cost = costOfSteps(map(), result.cells);
  result.lower_bound = std::min(costOfKey(bound, map().kernel()), result.costValue());
  std::ostringstream message;
  message.precision(5);
  message << "at most "
          << (result.lower_bound > 0.0 ? result.costValue() / result.lower_bound : 1.0)
          << " times the least cost";
  result.message = message.str();
}

}  // namespace grid_path_planner
