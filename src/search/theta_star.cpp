#include "grid_path_planner/search/theta_star.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner {
namespace {

// An expansion may try eight segments across the map.
constexpr std::uint32_t kExpansionsBetweenPolls = 32;

Traits thetaStarTraits() {
  Traits traits;
  traits.name = "theta_star";
  traits.four_connected = false;
  traits.unit_diagonals = false;
  traits.any_angle = true;
  traits.repairs = true;
  return traits;
}

}  // namespace

ThetaStar::ThetaStar() : Planner(thetaStarTraits()) {}

std::size_t ThetaStar::bytesFor(const GridGeometry& geometry) const {
  return geometry.size() * (sizeof(Node) + sizeof(std::uint8_t));
}

void ThetaStar::doPrepare(const StopToken& stop) {
  masks_.build(map(), stop);
  nodes_.assign(map().geometry().size(), Node());
  query_ = 0;
}

void ThetaStar::doUpdate(const CellRect& changed, const StopToken& stop) {
  masks_.update(map(), changed, stop);
}

// The straight line at the cheapest weight.
double ThetaStar::estimate(std::uint32_t index) const {
  const Cell from = cell(index), to = cell(goal_);
  return std::hypot(from.column - to.column, from.row - to.row) * map().kernel() * map().cheapest();
}

void ThetaStar::begin(std::uint32_t start) {
  if (++query_ == 0) {
    nodes_.assign(nodes_.size(), Node());
    query_ = 1;
  }
  heap_.clear();
  nodes_[start] = {0.0, start, query_, false};
  heap_.push_back({estimate(start), 0.0, start});
}

void ThetaStar::reach(std::uint32_t index, std::uint32_t parent, double g, Statistics& counts) {
  Node& node = nodes_[index];
  if (node.query == query_ && node.g <= g) return;
  node = {g, parent, query_, false};
  heap_.push_back({g + estimate(index), g, index});
  std::push_heap(heap_.begin(), heap_.end(), Later());
  ++counts.generated;
}

void ThetaStar::expand(std::uint32_t from, Statistics& counts) {
  const Node node = nodes_[from];
  const SegmentPoint parent = point(node.parent);
  for (unsigned mask = masks_[from]; mask != 0; mask &= mask - 1) {
    const auto step = static_cast<std::size_t>(__builtin_ctz(mask));
    const auto to = static_cast<std::uint32_t>(from + masks_.offsets()[step]);
    if (nodes_[to].query == query_ && nodes_[to].closed) continue;
    const double by_step = node.g + stepCost(map(), cell(from), cell(to)).toDouble();
    if (node.parent != from && segmentLegal(map(), parent, point(to))) {
      const double straight = nodes_[node.parent].g + segmentCost(map(), parent, point(to));
      if (straight <= by_step) {
        reach(to, node.parent, straight, counts);
        continue;
      }
    }
    reach(to, from, by_step, counts);
  }
}

PlanResult ThetaStar::doPlan(const PlanRequest& request, const StopToken& stop) {
  const GridGeometry& geometry = map().geometry();
  goal_ = geometry.index(request.goals.front()).value();
  begin(geometry.index(request.start).value());
  PlanResult result;
  Statistics& counts = result.statistics;
  counts.generated = 1;
  StopPoll poll(stop, kExpansionsBetweenPolls);
  while (!heap_.empty()) {
    const StopReason reason = poll.ask();
    if (reason != StopReason::NONE) return withStatus(Stopped(reason).status(), result);
    counts.peak_open = std::max(counts.peak_open, heap_.size());
    std::pop_heap(heap_.begin(), heap_.end(), Later());
    const std::uint32_t from = heap_.back().index;
    heap_.pop_back();
    if (nodes_[from].closed) continue;
    nodes_[from].closed = true;
    ++counts.expanded;
    if (request.record_expanded) result.expanded.emplace_back(from);
    if (from == goal_) return found(std::move(result));
    expand(from, counts);
  }
  return withStatus(Status::UNREACHABLE, result);
}

PlanResult ThetaStar::found(PlanResult result) const {
  for (std::uint32_t at = goal_;; at = nodes_[at].parent) {
    result.cells.push_back(cell(at));
    result.points.push_back(point(at));
    if (nodes_[at].parent == at) break;
  }
  std::reverse(result.cells.begin(), result.cells.end());
  std::reverse(result.points.begin(), result.points.end());
  result.segment_cost = nodes_[goal_].g;
  return withStatus(Status::FOUND, std::move(result));
}

PlanResult ThetaStar::withStatus(Status status, PlanResult result) const {
  result.status = status;
  result.statistics.search_bytes =
      bytesFor(map().geometry()) + result.statistics.peak_open * sizeof(Entry);
  return result;
}

}  // namespace grid_path_planner
