// The contract of all planners: how a path over cells is found.
//
//   std::unique_ptr<Planner> planner = makePlanner("a_star", options);
//   planner->prepare(map, StopToken());
//   SearchResult result = planner->search({Cell{1, 2}, {Cell{30, 40}}}, source.token());
//
// search() checks the request once and then computes. It never changes the map, and the same request
// on the same map gives the same cells, whatever the load, unless one answers that is `incremental`.
// What cannot be answered gives a status with a sentence; search() before prepare() gives NO_MAP.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/status.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/costmap/exact_cost.h"
#include "grid_path_planner/costmap/line_of_sight.h"

namespace grid_path_planner::planners {

// What a planner can do and what it promises.
struct PlannerTraits {
  std::string name;
  bool four_connected = true;  // understands Connectivity::FOUR
  bool unit_diagonals = true;  // understands DiagonalCost::UNIT
  bool cut_corners = true;     // understands cut_corners
  bool weights = true;         // cells of different weights
  bool optimal = false;        // can be; optimalFor() says whether it is on a map
  bool heuristic = false;      // is guided by AStarOptions::heuristic
  bool any_angle = false;      // the result is turning points: SearchResult::points
  bool shortest = false;       // no any-angle path is shorter, but for rounding
  bool several_goals = false;  // answers "the nearest of these goals"
  bool repairs = false;        // update() costs less than prepare()
  // search() continues earlier searches: its statistics count new work only, and which of several
  // least-cost paths it returns depends on the calls since prepare().
  bool incremental = false;
};

struct SearchRequest {
  grid::Cell start;
  std::vector<grid::Cell> goals;  // the answer is the one of least cost; most planners accept one
  bool record_expanded = false;   // fill SearchResult::expanded, for pictures
};

struct SearchResult {
  base::Status status = base::Status::NO_MAP;
  std::string message;            // one sentence that holds the values
  std::string answered_by;        // the planner that searched; empty where none did
  std::vector<grid::Cell> cells;  // start and goal included; start = goal: one cell
  // Of any-angle planners only: the turning points on the searched map, from the waypoint of the
  // start to that of the goal, which may be corners of cells. `cells` then has as many, each
  // passable and holding or touching its point.
  std::vector<costmap::SegmentPoint> points;
  // In cells of the original map x weight: of the steps, and of the segments of any-angle planners,
  // which have no exact form.
  costmap::ExactCost cost;
  double segment_cost = 0.0;
  double costValue() const { return cost.toDouble() + segment_cost; }

  base::Statistics statistics;
  std::vector<grid::CellIndex> expanded;  // in order, where the request asks for it
};

// What a planner computes in a background thread, or when a search first needs it, to be faster
// once it is done.
struct BackgroundWork {
  bool pending = false;   // not all of it is done
  double time_s = 0.0;    // of the last computation; 0 where there is none
  std::size_t bytes = 0;  // that its result holds
};

class Planner {
 public:
  virtual ~Planner() = default;

  const PlannerTraits& traits() const { return traits_; }

  // Whether paths on `map` have exactly the least cost.
  virtual bool optimalFor(const costmap::CostGrid& map) const;

  // Memory that prepare() and search() will hold for a map of this geometry, the map excluded.
  virtual std::size_t bytesFor(const grid::GridGeometry& geometry) const = 0;

  // Limits bytesFor() of the prepared map. For a map that needs more, prepare() allocates nothing,
  // and search() gives INVALID_REQUEST with both figures.
  void limitMemory(std::size_t bytes) { memory_limit_ = bytes; }

  // Frees what bytesFor() counts and searches can do without, at once: for others that cannot.
  virtual void releaseOptionalMemory() {}

  // Stores the map and computes what the planner needs of it; nothing for a map that it cannot
  // search. Throws Stopped.
  void prepare(std::shared_ptr<const costmap::CostGrid> map, const base::StopToken& stop);

  // `map` differs from the prepared one only inside `changed`, and its revision is higher; maps
  // between the two may have been left out. With a map of another geometry or motion model, or of no
  // higher revision, this is prepare(); with the prepared map itself it does nothing.
  void update(std::shared_ptr<const costmap::CostGrid> map,
              const std::vector<grid::CellRect>& changed, const base::StopToken& stop);

  // Searches take longer until background work is done. An optimal planner finds the same cost
  // before and after, though perhaps another path of that cost.
  // Nothing where the last map was refused, or its preparation was stopped.
  BackgroundWork backgroundWork();
  // Does the rest of it, or waits for it. Throws Stopped; what is done stays, and a thread continues.
  void finishBackgroundWork(const base::StopToken& stop);

  SearchResult search(const SearchRequest& request, const base::StopToken& stop);

 protected:
  explicit Planner(PlannerTraits traits) : traits_(std::move(traits)) {}

  const costmap::CostGrid& map() const { return *map_; }
  // The same, for a planner inside this one.
  const std::shared_ptr<const costmap::CostGrid>& sharedMap() const { return map_; }
  // What `inner` answers, which searches this planner's map in its place. Precondition: it promises as much, so
  // where optimalFor() holds for this planner, it does for `inner`.
  SearchResult answerOf(Planner& inner, const SearchRequest& request,
                        const base::StopToken& stop) const;
  // The map that update() replaces, before all of its changes. Precondition: called by doUpdate().
  const costmap::CostGrid& previousMap() const { return *map_before_; }

  // What a user can do where bytesFor() exceeds the limit.
  virtual std::string lessMemoryAdvice() const;

  // The reason why this planner cannot search `map`, "" where it can.
  virtual std::string refusal(const costmap::CostGrid& map) const;
  virtual void doPrepare(const base::StopToken&) {}
  // For doPrepare(), where it finds that the map cannot be searched.
  void refuse(std::string reason) { refusal_ = std::move(reason); }
  std::size_t memoryLimit() const { return memory_limit_; }
  // `changed`: disjoint rectangles in the map, none empty.
  virtual void doUpdate(const std::vector<grid::CellRect>&, const base::StopToken& stop) {
    doPrepare(stop);
  }
  // For the prepared map.
  virtual BackgroundWork doBackgroundWork() { return {}; }
  virtual void doFinishBackgroundWork(const base::StopToken&) {}
  // Precondition: start and goals are in the map and passable. May throw Stopped; TIMEOUT or
  // CANCELLED with the statistics so far is better.
  virtual SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) = 0;

 private:
  PlannerTraits traits_;
  std::string reasonAgainst(const costmap::CostGrid& map) const;
  bool holdsItsMap() const { return prepared_ && refusal_.empty(); }

  std::size_t memory_limit_ = std::numeric_limits<std::size_t>::max();
  std::shared_ptr<const costmap::CostGrid> map_;
  std::shared_ptr<const costmap::CostGrid> map_before_;  // during an update
  std::string refusal_;    // why map_ cannot be searched, "" where it can
  bool prepared_ = false;  // false where a preparation was stopped before its end
};

}  // namespace grid_path_planner::planners
