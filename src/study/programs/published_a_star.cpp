#include "study/programs/published_a_star.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grid_path_planner::study {

using base::InputError, base::Statistics, base::Status, base::Stopped, base::StopPoll,
    base::StopReason, base::StopToken;
using grid::GridGeometry;
using planners::AStarOptions, planners::Heuristic, planners::PlannerTraits, planners::SearchRequest,
    planners::SearchResult;

namespace {

constexpr std::int64_t kNotGenerated = std::numeric_limits<std::int64_t>::max();
constexpr double kCrossShare = 0.001;
constexpr double kOccupiedEstimate = 1000.0;  // of the published tie-break
// A node of a std::set<pair<int64, uint32>>: three pointers, a colour and the pair.
constexpr std::size_t kBytesOfOpenCell = 48;

PlannerTraits traitsNamed(const char* name) {
  PlannerTraits traits;
  traits.name = name;
  traits.heuristic = true;
  return traits;
}

}  // namespace

PublishedAStar::PublishedAStar(const char* name, const AStarOptions& options,
                               const Variation& variation)
    : Planner(traitsNamed(name)), options_(options), variation_(variation) {
  checkAStarOptions(options);
  if (options.heuristic == Heuristic::BLOCKS || options.heuristic == Heuristic::LANDMARK ||
      options.heuristic == Heuristic::EXACT)
    throw InputError(std::string(name) + " knows no heuristic that is a table");
}

std::size_t PublishedAStar::bytesFor(const GridGeometry& geometry) const {
  return PublishedGrid::bytesFor(geometry) +
         geometry.size() * (sizeof(std::int64_t) + sizeof(Index) + sizeof(std::uint8_t));
}

void PublishedAStar::doPrepare(const StopToken&) {
  grid_.build(map());
  scale_ = options_.epsilon * heuristicScale(options_).value_or(map().minWeight());
}

double PublishedAStar::distance(Index cell) const {
  const double rows = std::abs(grid_.row(cell) - grid_.row(goal_));
  const double columns = std::abs(grid_.column(cell) - grid_.column(goal_));
  switch (options_.heuristic) {
    case Heuristic::MANHATTAN:
      return rows + columns;
    case Heuristic::CHEBYSHEV:
      return std::max(rows, columns);
    case Heuristic::OCTILE:
      return rows + columns + (std::sqrt(2.0) - 2.0) * std::min(rows, columns);
    case Heuristic::EUCLIDEAN:
      return std::sqrt(rows * rows + columns * columns);
    default:
      return 0.0;
  }
}

// x is the row and y the column: the published listing does not say which, and the sign depends on
// it.
double PublishedAStar::cross(Index cell) const {
  const double dx1 = grid_.row(cell) - grid_.row(goal_);
  const double dy1 = grid_.column(cell) - grid_.column(goal_);
  const double dx2 = grid_.row(start_) - grid_.row(goal_);
  const double dy2 = grid_.column(start_) - grid_.column(goal_);
  return kCrossShare * (dx1 * dy2 - dx2 * dy1);
}

double PublishedAStar::estimate(Index cell) const {
  if (!variation_.published_cross) return scale_ * distance(cell);
  return grid_.occupied(cell) ? kOccupiedEstimate : cross(cell);
}

std::int64_t PublishedAStar::stepCost(Index from, Index to) const {
  return variation_.costs_entered ? grid_.value(to) : grid_.largerValue(from, to);
}

void PublishedAStar::startQuery(Index start, Index goal) {
  start_ = start;
  goal_ = goal;
  g_.assign(grid_.size(), kNotGenerated);
  parents_.assign(grid_.size(), PublishedGrid::kNone);
  closed_.assign(grid_.size(), 0);
  open_.clear();
  g_[start] = 0;
  open_.insert({0, start});
}

// Whether the goal was generated.
bool PublishedAStar::expand(Index from, Statistics& counts) {
  closed_[from] = 1;
  ++counts.expanded;
  return grid_.anyNeighbour(from, [&](Index to) {
    if (to == goal_) {
      parents_[to] = from;
      return true;
    }
    if (closed_[to] != 0 || (variation_.skips_occupied && grid_.occupied(to))) return false;
    const std::int64_t g = g_[from] + stepCost(from, to);
    if (g_[to] <= g) return false;
    g_[to] = g;
    parents_[to] = from;
    open_.insert({static_cast<std::int64_t>(static_cast<double>(g) + estimate(to)), to});
    ++counts.generated;
    return false;
  });
}

SearchResult PublishedAStar::doSearch(const SearchRequest& request, const StopToken& stop) {
  startQuery(grid_.index(request.start), grid_.index(request.goals.front()));
  SearchResult result;
  Statistics& counts = result.statistics;
  counts.generated = 1;
  if (start_ == goal_) return grid_.pathBetween(map(), parents_, start_, goal_, result);
  StopPoll poll(stop);
  result.status = Status::UNREACHABLE;
  for (bool arrived = false; !arrived && !open_.empty();) {
    counts.peak_open = std::max<std::size_t>(counts.peak_open, open_.size());
    const StopReason reason = poll.ask();
    if (reason != StopReason::NONE) {
      result.status = Stopped(reason).status();
      break;
    }
    // A cell that got cheaper while it was open is in the set twice; the second time it is closed.
    const Index from = open_.begin()->second;
    open_.erase(open_.begin());
    if (closed_[from] != 0) continue;
    if (request.record_expanded)
      result.expanded.push_back(map().geometry().index(grid_.cell(from)));
    arrived = expand(from, counts);
    if (arrived) result = grid_.pathBetween(map(), parents_, start_, goal_, std::move(result));
  }
  counts.search_bytes = bytesFor(map().geometry()) + counts.peak_open * kBytesOfOpenCell;
  return result;
}

}  // namespace grid_path_planner::study
