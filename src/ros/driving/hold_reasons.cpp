#include "ros/driving/hold_reasons.h"

namespace grid_path_planner::nodes {

void HoldReasons::setMap(const MapLiveness& life) {
  const bool same = life.map.data.changes() == map.map.data.changes();
  const DrivenTime driven = same ? map.driven : DrivenTime();
  map = life;
  map.driven = driven;
}

std::optional<std::string> HoldReasons::problem(const NavigatePathOptions& options) const {
  if (options.check_map) {
    const std::string why = whyNoMap(map, {options.map_timeout, options.map_data_timeout});
    if (!why.empty()) return why;
  }
  if (const auto why = localization.problem(now_.toSec(), options.degraded)) return why;
  if (options.use_speed_limit && !limits.grid)
    return "no map of speed limits has come on speed_limit yet (use_speed_limit:=false drives "
           "without one)";
  if (const std::string why = whyNoLimits(limits); !why.empty()) return why;
  return std::nullopt;
}

}  // namespace grid_path_planner::nodes
