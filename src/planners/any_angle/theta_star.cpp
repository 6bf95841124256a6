#include "planners/any_angle/theta_star.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "grid_path_planner/path/smoothing.h"
#include "planners/any_angle/turning_points.h"
#include "planners/core/any_angle_traits.h"

namespace grid_path_planner::planners {

using base::Statistics, base::Status, base::StopPoll, base::StopToken, base::ZeroedArray;
using costmap::BitMaps, costmap::lineCostWithin, costmap::SegmentPoint, costmap::waypointOf;
using grid::Cell, grid::CellRect, grid::GridGeometry;

namespace {

// An expansion may try eight segments across the map.
constexpr std::uint32_t kExpansionsBetweenPolls = 32;
// Of what remains by steps, the parts that are the estimate, from one search to the next; at last the
// straight distance is. A segment may cost 0.924 of the steps, and far less where it grazes the corners of
// blocked cells, which steps go around; but at 0.93 a search across a map takes about twice as long as at
// 0.97, for paths that cost a few ten-thousandths less.
constexpr std::array<double, 4> kShares = {0.97, 0.85, 0.5, 0.0};
// After fewer expansions than these together the next, wider search is affordable.
constexpr std::size_t kCheap = 500;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

PlannerTraits thetaStarTraits(const char* name) {
  PlannerTraits traits = anyAngleTraits(name);
  traits.repairs = true;
  return traits;
}

}  // namespace

ThetaStar::ThetaStar(const char* name, bool guided)
    : Planner(thetaStarTraits(name)), may_be_guided_(guided) {}

PlannerTraits LazyThetaStar::declaredTraits() {
  return thetaStarTraits(kName);
}

std::size_t ThetaStar::ownBytes(const GridGeometry& geometry) {
  return geometry.size() * (sizeof(Node) + sizeof(std::uint8_t)) + BitMaps::bytesFor(geometry);
}

std::size_t ThetaStar::bytesFor(const GridGeometry& geometry) const {
  return ownBytes(geometry) + (may_be_guided_ ? BackwardGuide::bytesFor(geometry) : 0);
}

void ThetaStar::doPrepare(const StopToken& stop) {
  masks_.build(map(), stop);
  nodes_ = ZeroedArray<Node>(map().geometry().size());
  stamp_.restart();
  followMap(stop);
  if (guided()) guide_.prepare(map(), stop);
}

void ThetaStar::doUpdate(const std::vector<CellRect>& changed, const StopToken& stop) {
  const bool was_guided = guided();
  for (const CellRect& rect : changed) masks_.update(map(), rect, stop);
  followMap(stop);
  if (!guided()) return;
  if (was_guided)
    guide_.update(map(), changed, stop);
  else
    guide_.prepare(map(), stop);
}

void ThetaStar::followMap(const StopToken& stop) {
  bits_ = map().uniform() ? &map().bitMaps(stop) : nullptr;
  const GridGeometry& original = map().original();
  centred_ = {original.width() / map().kernel(), original.height() / map().kernel()};
}

SegmentPoint ThetaStar::point(Cell cell) const {
  return centred(cell) ? SegmentPoint::centreOf(cell) : waypointOf(map(), cell);
}

double ThetaStar::costBound(Cell from, Cell to) const {
  const double least = map().kernel() * map().minWeight();
  if (centred(from) && centred(to)) {
    const double columns = from.column - to.column, rows = from.row - to.row;
    return std::sqrt(columns * columns + rows * rows) * least;
  }
  const SegmentPoint a = point(from), b = point(to);
  return std::hypot(double(a.x - b.x), double(a.y - b.y)) / double(SegmentPoint::kUnitsPerCell) *
         least;
}

std::optional<double> ThetaStar::segmentCost(Cell from, Cell to, double limit) const {
  return lineCostWithin(map(), bits_, point(from), point(to), limit);
}

double ThetaStar::stepCost(Cell from, Cell to) const {
  if (!centred(from) || !centred(to)) {
    const auto cost = segmentCost(from, to, kInfinity);
    if (cost)
      return *cost;  // none where the step may cut a corner, but no segment between these two points
  }
  const double length = from.column == to.column || from.row == to.row ? 1.0 : M_SQRT2;
  return length * (std::max(map().weight(from), map().weight(to)) * map().kernel());
}

double ThetaStar::toGoal(Cell cell) const {
  if (share_ == 0.0) return costBound(cell, goal_);
  return guide_.toGoal(map().geometry().index(cell).value()) * map().kernel() * share_;
}

void ThetaStar::startQuery(const SearchRequest& request) {
  goal_ = request.goals.front();
  const std::uint32_t start = map().geometry().index(request.start).value();
  stamp_.next([this] { nodes_.clear(); });
  open_.clear();
  nodes_[start] = Node{0.0, start, stamp_.word()};
  open_.push({toGoal(request.start), 0.0, start});
}

void ThetaStar::relax(std::uint32_t index, Cell at, std::uint32_t parent, double g,
                      std::uint16_t state, Statistics& counts) {
  if (generated(index) && nodes_[index].g <= g) return;
  const double f = g + toGoal(at);
  if (f == kInfinity) return;
  nodes_[index] = Node{g, parent, static_cast<std::uint16_t>(stamp_.word() | state)};
  open_.push({f, g, index});
  ++counts.generated;
}

// The least g-value of a cell by a step from a closed neighbour.
ThetaStar::Arrival ThetaStar::bestStep(std::uint32_t index, Cell at) const {
  Arrival best{kInfinity, index};
  forNeighbours(index, at, [&](std::uint32_t from, Cell neighbour) {
    if (!closed(from)) return;
    const double g = nodes_[from].g + stepCost(neighbour, at);
    if (g < best.g) best = {g, from};
  });
  return best;
}

// Checks the assumed line of sight to the cell's parent (SetVertex of the paper): the parent stays,
// or is the closed neighbour with the least-cost step. False where the g-value rose by that; then
// the cell is pushed again.
bool ThetaStar::checkParent(std::uint32_t index, Statistics& counts) {
  Node& node = nodes_[index];
  const Cell at = cell(index);
  const double assumed = node.g, parent_g = nodes_[node.parent].g;
  node.state = stamp_.word();
  Arrival best{kInfinity, index};
  if (!bits_) best = bestStep(index, at);
  const auto cost = segmentCost(cell(node.parent), at, best.g - parent_g);
  if (cost && parent_g + *cost <= best.g)
    best = {parent_g + *cost, node.parent};
  else if (bits_)
    best = bestStep(index, at);
  node.g = best.g;
  node.parent = best.parent;
  if (best.g <= assumed * (1.0 + kRounding)) return true;
  open_.push({best.g + toGoal(at), best.g, index});
  ++counts.generated;
  return false;
}

SearchResult ThetaStar::doSearch(const SearchRequest& request, const StopToken& stop) {
  SearchResult result;
  if (guided()) {
    result = guide_.search(map(), request, stop);
    if (result.status != Status::FOUND) return withStatus(result.status, result);
  }
  const std::vector<Cell> steps = std::move(result.cells);
  const std::size_t guide_expanded = result.statistics.expanded;
  result.cost = {};
  result.segment_cost = kInfinity;
  for (const double share : kShares) {
    share_ = guided() ? share : 0.0;
    const Status status = searchForward(request, result, stop);
    if (status != Status::FOUND) return withStatus(status, result);
    if (share_ == 0.0 || result.statistics.expanded - guide_expanded >= kCheap) break;
  }
  if (guided()) improve(result, steps, stop);
  for (const Cell at : result.cells) result.points.push_back(point(at));
  return withStatus(Status::FOUND, std::move(result));
}

// Replaces what was found before by what costs less.
Status ThetaStar::searchForward(const SearchRequest& request, SearchResult& result,
                                const StopToken& stop) {
  const std::uint32_t goal = map().geometry().index(request.goals.front()).value();
  startQuery(request);
  Statistics& counts = result.statistics;
  ++counts.generated;
  StopPoll poll(stop, kExpansionsBetweenPolls);
  while (!open_.empty()) {
    const base::StopReason reason = poll.ask();
    if (reason != base::StopReason::NONE) return base::Stopped(reason).status();
    counts.peak_open = std::max(counts.peak_open, open_.size());
    const Entry entry = open_.pop();
    const std::uint32_t from = entry.index;
    if (closed(from) || entry.g != nodes_[from].g) continue;
    if ((nodes_[from].state & kUnchecked) != 0 && !checkParent(from, counts)) continue;
    nodes_[from].state = stamp_.word() | kClosed;
    ++counts.expanded;
    if (request.record_expanded) result.expanded.emplace_back(from);
    if (from == goal) {
      if (nodes_[goal].g < result.segment_cost) {
        result.segment_cost = nodes_[goal].g;
        result.cells = cellsFound();
      }
      return Status::FOUND;
    }
    expand(from, counts);
  }
  return Status::UNREACHABLE;
}

std::vector<Cell> ThetaStar::cellsFound() const {
  std::vector<Cell> cells;
  for (std::uint32_t at = map().geometry().index(goal_).value();; at = nodes_[at].parent) {
    cells.push_back(cell(at));
    if (nodes_[at].parent == at) break;
  }
  std::reverse(cells.begin(), cells.end());
  return cells;
}

// The cheaper of what was found and of the least-cost path of steps, smoothed; tightened.
void ThetaStar::improve(SearchResult& result, const std::vector<Cell>& steps,
                        const StopToken& stop) const {
  std::vector<SegmentPoint> points;
  for (const Cell step : steps) points.push_back(point(step));
  const path::SmoothPath smooth = path::smoothed(map(), points, stop);
  if (smooth.cost < result.segment_cost) {
    result.cells.clear();
    for (const std::size_t i : smooth.kept) result.cells.push_back(steps[i]);
  }
  result.cells = tightened(map(), std::move(result.cells), stop);
  result.segment_cost = costOfTurningPoints(map(), result.cells);
}

SearchResult ThetaStar::withStatus(Status status, SearchResult result) const {
  result.status = status;
  result.statistics.search_bytes +=
      ownBytes(map().geometry()) + result.statistics.peak_open * sizeof(Entry);
  return result;
}

// Relaxes each neighbour by the segment from the parent, whose line of sight is assumed. On maps of
// several weights the segment is assumed to be as much cheaper than the step as it is shorter.
void LazyThetaStar::expand(std::uint32_t from, Statistics& counts) {
  const Node here = node(from);
  const double parent_g = node(here.parent).g;
  const Cell at = cell(from), parent = cell(here.parent);
  const double to_parent = costBound(parent, at);
  forNeighbours(from, at, [&](std::uint32_t index, Cell to) {
    if (closed(index)) return;
    double g = parent_g + costBound(parent, to);
    if (!oneWeight()) {
      const double shorter = to_parent + costBound(at, to) - (g - parent_g);
      const double weight =
          std::max(map().weight(at), map().weight(to)) / double(map().minWeight());
      g = here.g + stepCost(at, to) - weight * shorter;
    }
    relax(index, to, here.parent, g, kUnchecked, counts);
  });
}

}  // namespace grid_path_planner::planners
