#include "grid_path_planner/planners/theta_star.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid_path_planner/costmap/line_of_sight.h"

namespace grid_path_planner::planners {

using base::Statistics;
using base::Status;
using base::Stopped;
using base::StopPoll;
using base::StopReason;
using base::StopToken;
using base::ZeroedArray;
using costmap::BitMaps;
using costmap::lineCostWithin;
using costmap::SegmentPoint;
using costmap::waypointOf;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;

namespace {

// An expansion may try eight segments across the map.
constexpr std::uint32_t kExpansionsBetweenPolls = 32;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

PlannerTraits thetaStarTraits(const char* name) {
  PlannerTraits traits;
  traits.name = name;
  traits.four_connected = false;
  traits.unit_diagonals = false;
  traits.any_angle = true;
  traits.repairs = true;
  return traits;
}

}  // namespace

ThetaStar::ThetaStar(const char* name) : Planner(thetaStarTraits(name)) {}

std::size_t ThetaStar::bytesFor(const GridGeometry& geometry) const {
  return geometry.size() * (sizeof(Node) + sizeof(std::uint8_t)) + BitMaps::bytesFor(geometry);
}

void ThetaStar::doPrepare(const StopToken& stop) {
  masks_.build(map(), stop);
  nodes_ = ZeroedArray<Node>(map().geometry().size());
  query_ = 0;
  doUpdate({}, stop);
}

void ThetaStar::doUpdate(const CellRect& changed, const StopToken& stop) {
  if (!changed.empty()) masks_.update(map(), changed, stop);
  bits_ = map().uniform() ? &map().bitMaps(stop) : nullptr;
  const GridGeometry& original = map().original();
  centred_ = {original.width() / map().kernel(), original.height() / map().kernel()};
}

SegmentPoint ThetaStar::point(Cell cell) const {
  return centred(cell) ? SegmentPoint::centreOf(cell) : waypointOf(map(), cell);
}

double ThetaStar::leastCost(Cell from, Cell to) const {
  const double least = map().kernel() * map().minWeight();
  if (centred(from) && centred(to)) {
    const double columns = from.column - to.column, rows = from.row - to.row;
    return std::sqrt(columns * columns + rows * rows) * least;
  }
  const SegmentPoint a = point(from), b = point(to);
  return std::hypot(double(a.x - b.x), double(a.y - b.y)) / double(SegmentPoint::kUnitsPerCell) *
         least;
}

std::optional<double> ThetaStar::straight(Cell from, Cell to, double limit) const {
  return lineCostWithin(map(), bits_, point(from), point(to), limit);
}

double ThetaStar::stepTo(Cell from, Cell to) const {
  if (!centred(from) || !centred(to)) {
    const auto cost = straight(from, to, kInfinity);
    if (cost) return *cost;  // none past a corner that may be cut, but not between these middles
  }
  const double length = from.column == to.column || from.row == to.row ? 1.0 : M_SQRT2;
  return length * (std::max(map().weight(from), map().weight(to)) * map().kernel());
}

void ThetaStar::begin(std::uint32_t start) {
  if (++query_ == kQueries) {
    nodes_.clear();
    query_ = 1;
  }
  heap_.clear();
  nodes_[start] = Node{0.0, start, query_, 0, 0};
  heap_.push_back({leastCost(cell(start), goal_), 0.0, start});
}

void ThetaStar::reach(std::uint32_t index, Cell at, std::uint32_t parent, double g, bool trusted,
                      Statistics& counts) {
  if (known(index) && nodes_[index].g <= g) return;
  nodes_[index] = Node{g, parent, query_, 0, trusted};
  heap_.push_back({g + leastCost(at, goal_), g, index});
  std::push_heap(heap_.begin(), heap_.end(), Later());
  ++counts.generated;
}

// The cheapest step to a cell from a neighbour that was expanded.
ThetaStar::Arrival ThetaStar::byStep(std::uint32_t index, Cell at) const {
  Arrival best{kInfinity, index};
  forNeighbours(index, at, [&](std::uint32_t from, Cell neighbour) {
    if (!closed(from)) return;
    const double g = nodes_[from].g + stepTo(neighbour, at);
    if (g < best.g) best = {g, from};
  });
  return best;
}

// Makes the trusted way to a cell a true one: the segment, or a step. Whether the cell's turn is
// still now.
bool ThetaStar::verify(std::uint32_t index, Statistics& counts) {
  Node& node = nodes_[index];
  const Cell at = cell(index);
  const double trusted = node.g, parent_g = nodes_[node.parent].g;
  node.trusted = 0;
  Arrival best{kInfinity, index};
  if (!bits_) best = byStep(index, at);
  const auto cost = straight(cell(node.parent), at, best.g - parent_g);
  if (cost && parent_g + *cost <= best.g)
    best = {parent_g + *cost, node.parent};
  else if (bits_)
    best = byStep(index, at);
  node.g = best.g;
  node.parent = best.parent;
  if (best.g <= trusted * (1.0 + kRounding)) return true;
  heap_.push_back({best.g + leastCost(at, goal_), best.g, index});
  std::push_heap(heap_.begin(), heap_.end(), Later());
  ++counts.generated;
  return false;
}

SearchResult ThetaStar::doSearch(const SearchRequest& request, const StopToken& stop) {
  const GridGeometry& geometry = map().geometry();
  goal_ = request.goals.front();
  const std::uint32_t goal = geometry.index(goal_).value();
  begin(geometry.index(request.start).value());
  SearchResult result;
  Statistics& counts = result.statistics;
  counts.generated = 1;
  StopPoll poll(stop, kExpansionsBetweenPolls);
  while (!heap_.empty()) {
    const StopReason reason = poll.ask();
    if (reason != StopReason::NONE) return withStatus(Stopped(reason).status(), result);
    counts.peak_open = std::max(counts.peak_open, heap_.size());
    std::pop_heap(heap_.begin(), heap_.end(), Later());
    const Entry entry = heap_.back();
    const std::uint32_t from = entry.index;
    heap_.pop_back();
    if (nodes_[from].closed || entry.g != nodes_[from].g) continue;
    if (nodes_[from].trusted && !verify(from, counts)) continue;
    nodes_[from].closed = 1;
    ++counts.expanded;
    if (request.record_expanded) result.expanded.emplace_back(from);
    if (from == goal) return found(std::move(result));
    expand(from, counts);
  }
  return withStatus(Status::UNREACHABLE, result);
}

SearchResult ThetaStar::found(SearchResult result) const {
  const std::uint32_t goal = map().geometry().index(goal_).value();
  for (std::uint32_t at = goal;; at = nodes_[at].parent) {
    result.cells.push_back(cell(at));
    result.points.push_back(point(cell(at)));
    if (nodes_[at].parent == at) break;
  }
  std::reverse(result.cells.begin(), result.cells.end());
  std::reverse(result.points.begin(), result.points.end());
  result.segment_cost = nodes_[goal].g;
  return withStatus(Status::FOUND, std::move(result));
}

SearchResult ThetaStar::withStatus(Status status, SearchResult result) const {
  result.status = status;
  result.statistics.search_bytes =
      bytesFor(map().geometry()) + result.statistics.peak_open * sizeof(Entry);
  return result;
}

// Each neighbour by the segment from the parent, taken on trust. On maps of several
// weights it is thought to be as much cheaper than the step as it is shorter.
void LazyThetaStar::expand(std::uint32_t from, Statistics& counts) {
  const Node here = node(from);
  const double parent_g = node(here.parent).g;
  const Cell at = cell(from), parent = cell(here.parent);
  const double to_parent = leastCost(parent, at);
  forNeighbours(from, at, [&](std::uint32_t index, Cell to) {
    if (closed(index)) return;
    double g = parent_g + leastCost(parent, to);
    if (!oneWeight()) {
      const double shorter = to_parent + leastCost(at, to) - (g - parent_g);
      const double dearer =
          std::max(map().weight(at), map().weight(to)) / double(map().minWeight());
      g = here.g + stepTo(at, to) - dearer * shorter;
    }
    reach(index, to, here.parent, g, true, counts);
  });
}

}  // namespace grid_path_planner::planners
