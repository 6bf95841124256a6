#include "ros/driving/map_life.h"

#include "grid_path_planner/base/decimal_text.h"

namespace grid_path_planner::nodes {
namespace {

// With one decimal: the text changes from tick to tick.
std::string seconds(double value) {
  return base::decimalText(static_cast<int>(value * 10.0) / 10.0) + " s";
}

}  // namespace

std::string whyNoMap(const MapLife& life, double map_timeout) {
  if (!life.map.grid)
    return "no map has come on " + life.topic +
           " yet: the vehicle does not start without one (check_map:=false drives without a map)";
  const double silence = life.silence();
  if (life.heartbeat && silence > map_timeout)
    return "the map on " + life.topic + " is not kept up: no heartbeat of " + life.map.publisher +
           " for " + seconds(silence);
  if (!life.heartbeat && silence > kPublisherTimeout)
    return "the map on " + life.topic + " is not kept up: " + life.map.publisher +
           " has not answered for " + seconds(silence);
  if (life.lost_since && base::secondsSince(*life.lost_since) > kLostTimeout)
    return "the map on " + life.topic + " lacks changes: " + life.lost;
  return "";
}

}  // namespace grid_path_planner::nodes
