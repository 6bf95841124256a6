#include "grid_path_planner/planners/planner.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <sstream>
#include <utility>

#include "planners/core/keys.h"

namespace grid_path_planner::planners {

using base::Status, base::Stopped, base::StopReason, base::StopToken;
using costmap::Connectivity, costmap::CostGrid, costmap::DiagonalCost, costmap::MotionModel;
using grid::Cell, grid::CellRect, grid::Grid, grid::grownRects, grid::Occupancy;

namespace {

template <class... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

SearchResult failure(Status status, std::string message) {
  SearchResult result;
  result.status = status;
  result.message = std::move(message);
  return result;
}

std::string sizeOf(const CostGrid& map) {
  return sentence(map.geometry().width(), "x", map.geometry().height(), " cells");
}

std::size_t megabytes(std::size_t bytes) {
  return bytes / 1000000 + (bytes % 1000000 != 0 ? 1 : 0);
}

// The first error of the request, FOUND where there is none.
SearchResult check(const CostGrid& map, const SearchRequest& request, const PlannerTraits& traits) {
  if (request.goals.empty()) return failure(Status::INVALID_REQUEST, "the request has no goal");
  if (request.goals.size() > 1 && !traits.several_goals)
    return failure(Status::INVALID_REQUEST,
                   sentence(traits.name, " takes one goal, got ", request.goals.size()));
  if (!map.geometry().contains(request.start))
    return failure(Status::START_OUTSIDE_MAP,
                   sentence("start ", request.start, " lies outside the map of ", sizeOf(map)));
  for (const Cell goal : request.goals)
    if (!map.geometry().contains(goal))
      return failure(Status::GOAL_OUTSIDE_MAP,
                     sentence("goal ", goal, " lies outside the map of ", sizeOf(map)));
  if (!map.passable(request.start))
    return failure(Status::START_OCCUPIED, sentence("start ", request.start, " is blocked"));
  const auto open = [&map](Cell goal) { return map.passable(goal); };
  if (std::none_of(request.goals.begin(), request.goals.end(), open))
    return failure(Status::GOAL_OCCUPIED,
                   request.goals.size() == 1
                       ? sentence("goal ", request.goals.front(), " is blocked")
                       : sentence("all ", request.goals.size(), " goals are blocked"));
  return failure(Status::FOUND, "");
}

std::string unreachable(const SearchRequest& request) {
  if (request.goals.size() == 1)
    return sentence("no path leads from ", request.start, " to ", request.goals.front());
  return sentence("no path leads from ", request.start, " to any of ", request.goals.size(),
                  " goals");
}

// The message where the planner itself gives none.
std::string usualMessage(Status status, const SearchRequest& request, const std::string& name) {
  switch (status) {
    case Status::UNREACHABLE:
      return unreachable(request);
    case Status::TIMEOUT:
      return name + " reached its time limit";
    case Status::CANCELLED:
      return name + " was cancelled";
    default:
      return "";
  }
}

// The weights of a class's passable cells; none: 0.
struct WeightRange {
  CostGrid::Weight least = 0;
  CostGrid::Weight most = 0;

  void add(CostGrid::Weight weight) {
    least = least == 0 ? weight : std::min(least, weight);
    most = std::max(most, weight);
  }
};

// The options that make passable cells weigh differently on this map, set so that they do not.
std::string oneWeightAdvice(const CostGrid& map) {
  WeightRange free, unknown, occupied;
  const Grid<CostGrid::Weight>& weights = map.weights();
  for (int row = 0; row < weights.height(); ++row)
    for (int column = 0; column < weights.width(); ++column) {
      const CostGrid::Weight weight = weights[Cell{column, row}];
      if (weight == CostGrid::kBlocked) continue;
      const Occupancy occupancy = map.occupancy({column, row});
      (occupancy == Occupancy::FREE      ? free
       : occupancy == Occupancy::UNKNOWN ? unknown
                                         : occupied)
          .add(weight);
    }
  std::string advice;
  const auto add = [&advice](const char* setting) {
    advice += (advice.empty() ? "set " : " and ") + std::string(setting);
  };
  if (unknown.most > free.least) add("unknown_is_passable false or unknown_weight to free_weight");
  if (occupied.most > free.least) add("occupied_is_passable false");
  if (free.least != free.most) add("decay 0");
  return advice;
}

// Goals that are blocked cannot be reached; the others may.
SearchRequest withoutBlockedGoals(SearchRequest request, const CostGrid& map) {
  auto& goals = request.goals;
  goals.erase(
      std::remove_if(goals.begin(), goals.end(), [&map](Cell goal) { return !map.passable(goal); }),
      goals.end());
  return request;
}

}  // namespace

void Planner::prepare(std::shared_ptr<const CostGrid> map, const StopToken& stop) {
  map_ = std::move(map);
  map_before_.reset();
  prepared_ = false;
  refusal_ = reasonAgainst(*map_);
  if (refusal_.empty()) doPrepare(stop);
  prepared_ = true;
}

void Planner::update(std::shared_ptr<const CostGrid> map, const std::vector<CellRect>& changed,
                     const StopToken& stop) {
  if (prepared_ && map == map_) return;
  const bool follows = holdsItsMap() && map->geometry() == map_->geometry() &&
                       map->motion() == map_->motion() && map->revision() > map_->revision();
  if (!follows || !reasonAgainst(*map).empty()) return prepare(std::move(map), stop);
  map_before_ = std::exchange(map_, std::move(map));
  prepared_ = false;
  doUpdate(grownRects(changed, 0, map_->geometry().rect()), stop);
  prepared_ = true;
  map_before_.reset();
}

BackgroundWork Planner::backgroundWork() {
  return holdsItsMap() ? doBackgroundWork() : BackgroundWork();
}

void Planner::finishBackgroundWork(const StopToken& stop) {
  if (holdsItsMap()) doFinishBackgroundWork(stop);
}

SearchResult Planner::search(const SearchRequest& request, const StopToken& stop) {
  if (!prepared_) return failure(Status::NO_MAP, traits_.name + " has no map yet");
  if (!refusal_.empty()) return failure(Status::INVALID_REQUEST, traits_.name + " " + refusal_);
  SearchResult checked = check(*map_, request, traits_);
  if (checked.status != Status::FOUND) return checked;

  const auto begin = StopToken::Clock::now();
  SearchResult result;
  try {
    const StopReason reason_to_stop = stop.reason();
    if (reason_to_stop != StopReason::NONE) throw Stopped(reason_to_stop);
    result = doSearch(withoutBlockedGoals(request, *map_), stop);
  } catch (const TooExpensive&) {
    result = failure(Status::INVALID_REQUEST, TooExpensive::kMessage);
  } catch (const Stopped& stopped) {
    result = failure(stopped.status(), "");
  }
  if (result.answered_by.empty()) result.answered_by = traits_.name;
  if (result.message.empty()) result.message = usualMessage(result.status, request, traits_.name);
  result.statistics.time_s = std::chrono::duration<double>(StopToken::Clock::now() - begin).count();
  return result;
}

SearchResult Planner::answerOf(Planner& inner, const SearchRequest& request,
                               const StopToken& stop) const {
  assert(inner.optimalFor(*map_) || !optimalFor(*map_));
  return inner.search(request, stop);
}

std::string Planner::lessMemoryAdvice() const {
  return "raise it or search with a larger kernel";
}

bool Planner::optimalFor(const CostGrid&) const {
  return traits_.optimal;
}

std::string Planner::reasonAgainst(const CostGrid& map) const {
  const std::size_t bytes = bytesFor(map.geometry());
  if (bytes > memory_limit_)
    return sentence("needs ", megabytes(bytes), " MB to search a map of ", sizeOf(map),
                    ", more than the ", memory_limit_ / 1000000,
                    " MB that memory_limit leaves it: ", lessMemoryAdvice());
  return refusal(map);
}

std::string Planner::refusal(const CostGrid& map) const {
  const MotionModel& motion = map.motion();
  if (motion.connectivity == Connectivity::FOUR && !traits_.four_connected)
    return "does not plan with connectivity 4, which a_star does";
  if (motion.diagonal_cost == DiagonalCost::UNIT && !traits_.unit_diagonals)
    return "does not plan with diagonal_cost unit, which a_star does";
  if (motion.cut_corners && !traits_.cut_corners)
    return "does not plan with cut_corners, which a_star does";
  if (!map.uniform() && !traits_.weights)
    return sentence("plans only where all passable cells weigh the same, and these weigh ",
                    map.minWeight(), " to ", map.maxWeight(), ": ", oneWeightAdvice(map),
                    ", or take a_star");
  return "";
}

}  // namespace grid_path_planner::planners
