#include "ros/driving/hold_reasons.h"

namespace grid_path_planner::nodes {

namespace {

constexpr std::chrono::milliseconds kClockTimeout(500);  // by the wall clock

}  // namespace

void HoldReasons::setMap(const MapLiveness& life) {
  const bool same = life.map.data.changes() == map.map.data.changes();
  const DrivenTime driven = same ? map.driven : DrivenTime();
  map = life;
  map.driven = driven;
}

void HoldReasons::tick(const ros::Time& now) {
  if (now != now_) moved_ = std::chrono::steady_clock::now();
  now_ = now;
}

std::optional<std::string> HoldReasons::problem(const NavigatePathOptions& options,
                                                const std::string& stop_topic) const {
  if (stopped) return "stopped by the topic " + stop_topic;
  if (std::chrono::steady_clock::now() - moved_ > kClockTimeout)
    return "ROS time stands still: no /clock comes";
  if (options.check_map) {
    const std::string why = whyNoMap(map, {options.map_timeout, options.map_data_timeout});
    if (!why.empty()) return why;
  }
  if (const auto why = localization.problem(now_.toSec(), options.degraded)) return why;
  if (options.use_speed_limit && !limits.grid)
    return "no map of speed limits has come on speed_limit yet (use_speed_limit:=false drives "
           "without one)";
  if (const std::string why = whyNoLimits(limits); !why.empty()) return why;
  if (options.master_timeout > 0.0 && master_->silence() > options.master_timeout)
    return "the ROS master has not answered for longer than master_timeout";
  return std::nullopt;
}

}  // namespace grid_path_planner::nodes
