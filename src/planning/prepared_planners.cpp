#include "planning/prepared_planners.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::planning {

using base::sameOptions, base::StopToken;
using planners::PlannerMaker, planners::SearchOptions;

PreparedPlanners::PreparedPlanners(PlannerMaker make_planner)
    : make_planner_(std::move(make_planner)) {}

void PreparedPlanners::use(const std::string& planner, const SearchOptions& options) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& each) {
    return each.planner == planner && sameOptions(each.options, options);
  });
  if (found != entries_.end())
    entries_.splice(entries_.begin(), entries_, found);
  else
    entries_.push_front({planner, options, {planner, options, make_planner_}});
  if (entries_.size() > kMost) entries_.pop_back();
}

void PreparedPlanners::followOthers(const CostmapPair& maps, const StopToken& stop) {
  for (auto each = std::next(entries_.begin()); each != entries_.end();) {
    const bool kept = each->search.isPreparedFor(maps) || each->search.canFollow(maps);
    if (!kept) {
      each = entries_.erase(each);
      continue;
    }
    each->search.follow(maps, stop);
    ++each;
  }
}

void PreparedPlanners::releaseOptionalMemory() {
  for (Entry& each : entries_) each.search.releaseOptionalMemory();
}

void PreparedPlanners::keepWithin(std::size_t bytes, std::size_t bytes_of_current) {
  if (bytes_of_current + bytesOfOthers() > bytes)
    for (auto each = std::next(entries_.begin()); each != entries_.end(); ++each)
      each->search.releaseOptionalMemory();
  while (entries_.size() > 1 && bytes_of_current + bytesOfOthers() > bytes) entries_.pop_back();
}

std::size_t PreparedPlanners::bytesOfOthers() const {
  std::size_t bytes = 0;
  for (auto each = std::next(entries_.begin()); each != entries_.end(); ++each)
    bytes += each->search.bytes();
  return bytes;
}

}  // namespace grid_path_planner::planning
