#include "ros/driving/map_liveness.h"

#include "grid_path_planner/base/decimal_text.h"

namespace grid_path_planner::nodes {

std::string silenceText(double seconds) {
  return base::decimalText(static_cast<int>(seconds * 10.0) / 10.0) + " s";
}

std::string whyNoMap(const MapLiveness& life, const MapTimeouts& timeouts) {
  if (!life.map.grid)
    return "no map has come on " + life.topic +
           " yet: the vehicle does not start without one (check_map:=false drives without a map)";
  const double silence = life.silence();
  const bool beats = life.map.data.beats();
  if (beats && silence > timeouts.heartbeat)
    return "the map on " + life.topic + " is not kept up: no heartbeat of " + life.map.publisher +
           " for " + silenceText(silence);
  if (!beats && silence > kPublisherTimeout)
    return "the map on " + life.topic + " is not kept up: " + life.map.publisher +
           " has not answered for " + silenceText(silence);
  if (life.lost_since && base::secondsSince(*life.lost_since) > kLostTimeout)
    return "the map on " + life.topic + " lacks changes: " + life.lost;
  const auto old = life.map.data.problem(Instant::now(), life.driven.seconds(), timeouts.data);
  if (old && !life.of_file.value_or(false))
    return "the map on " + life.topic + " is too old: " + *old;
  return "";
}

}  // namespace grid_path_planner::nodes
