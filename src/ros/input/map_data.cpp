#include "ros/input/map_data.h"

#include <algorithm>

#include "grid_path_planner/base/decimal_text.h"
#include "ros/guard/clock.h"

namespace grid_path_planner::nodes {
namespace {

constexpr double kLongestWait = 60.0;  // s, after which maps that come are no sequence

// With one decimal: the text changes from tick to tick.
std::string seconds(double value) {
  return base::decimalText(static_cast<int>(value * 10.0) / 10.0) + " s";
}

}  // namespace

void MapData::noteMap(const ros::Time& stamp, const Instant& now) {
  if (beats_) {
    if (newest_.isZero() || stamp <= newest_) return;
  } else {
    if (!stamp.isZero() && stamp == newest_) return;  // what was latched comes again
    const double waited = secondsBetween(told_.ros, now.ros);
    waits_ = changes_ > 0 && waited >= 0.0 && waited <= kLongestWait;
    if (waits_) longest_wait_ = std::max(longest_wait_, waited);
  }
  newest_ = stamp;
  told_ = now;
  ++changes_;
}

void MapData::noteHeartbeat(const ros::Time& stamp, const Instant& now) {
  beats_ = true;
  newest_ = stamp;
  told_ = now;
}

double MapData::age(const Instant& now) const {
  const std::chrono::duration<double> by_wall = now.wall - told_.wall;
  const double since = std::min(secondsBetween(told_.ros, now.ros), by_wall.count());
  return secondsBetween(newest_, told_.ros) + std::max(since, 0.0);
}

std::optional<std::string> MapData::problem(const Instant& now, double driven,
                                            double timeout) const {
  if (beats_) {
    const double old = newest_.isZero() ? 0.0 : age(now);
    if (old > timeout)
      return "its newest data is " + seconds(old) + " old: has the camera or laser ceased?";
    if (old < -timeout)
      return "its newest data is stamped " + seconds(-old) + " ahead of the time here";
  } else if (waits_ && driven > std::max(3.0 * longest_wait_, timeout)) {
    return "no other one has come while the vehicle was driven for " + seconds(driven) +
           ", and before at least every " + seconds(longest_wait_);
  }
  return std::nullopt;
}

}  // namespace grid_path_planner::nodes
