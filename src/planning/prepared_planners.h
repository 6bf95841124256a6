// The searches of all planners and options that were asked for, each with what it prepared of the
// map: a question to another planner throws nothing away.
//
//   PreparedPlanners searches(planners::makePlanner);
//   searches.use("a_star", options);
//   searches.keepWithin(bytes, bytes_of_current);  // those asked longest ago go first
//   searches.current().prepare(maps, stop);
//   searches.followOthers(maps, stop);  // a map changed a little
//
// The searches that are not current follow a change of the map where it is small and their planner
// repairs what it prepared; otherwise they are given up, as they are for another map.
#pragma once

#include <cstddef>
#include <iterator>
#include <list>
#include <string>

#include "planning/multi_resolution_planner.h"

namespace grid_path_planner::planning {

class PreparedPlanners {
 public:
  static constexpr std::size_t kMost = 32;

  explicit PreparedPlanners(planners::PlannerMaker make_planner);

  // Makes the search of these options current: the one that is kept, or a new one. Throws
  // InputError for an unknown planner or options that cannot be used; the current one stays then.
  void use(const std::string& planner, const planners::SearchOptions& options);
  // Precondition of all others: use() was called.
  MultiResolutionPlanner& current() { return entries_.front().search; }
  const MultiResolutionPlanner& current() const { return entries_.front().search; }

  void giveUpOthers() { entries_.erase(std::next(entries_.begin()), entries_.end()); }

  // Brings the others up to date, or gives them up. Throws Stopped; those left behind are given up
  // by a later call.
  void followOthers(const CostmapPair& maps, const base::StopToken& stop);

  // As Planner::releaseOptionalMemory(), of all.
  void releaseOptionalMemory();
  // What is optional of others goes, then others do, until all take at most `bytes`, of which the current one takes
  // `bytes_of_current`.
  void keepWithin(std::size_t bytes, std::size_t bytes_of_current);
  // That the others hold.
  std::size_t bytesOfOthers() const;
  std::size_t number() const { return entries_.size(); }

 private:
  struct Entry {
    std::string planner;
    planners::SearchOptions options;
    MultiResolutionPlanner search;
  };

  planners::PlannerMaker make_planner_;
  std::list<Entry> entries_;  // the one asked last first
};

}  // namespace grid_path_planner::planning
