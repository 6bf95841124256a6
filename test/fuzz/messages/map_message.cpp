// A map and its updates as MapReceiver takes them.
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid/map_differences.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/input/map_receiver.h"

namespace grid_path_planner::fuzz {
namespace {

nav_msgs::OccupancyGrid smallMap() {
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "/map";
  map.info.resolution = 0.05f;
  map.info.width = 4;
  map.info.height = 3;
  map.info.origin.orientation.w = 1.0;
  map.data = {0, 0, 100, -1, 50, 7, 0, 0, 1, 2, 3, 4};
  return map;
}

std::vector<std::string> seedsOfMapMessages() {
  return {bytesOf(smallMap())};
}

FUZZ_TARGET(map_message, seedsOfMapMessages) {
  const auto message = messageOf<nav_msgs::OccupancyGrid>(input);
  if (!message) return;
  mayRefuse([&] {
    const std::string frame = nodes::frameName(message->header.frame_id);
    const grid::OccupancyGrid map = nodes::occupancyFromMessage(*message);
    mustHold(grid::differences(map, map.values()).empty(), "a map differs nowhere from itself");
    const auto again = nodes::occupancyToMessage(map, frame, message->header.stamp);
    mustHold(again.data == message->data, "the cells come back");
  });
}

std::vector<std::string> seedsOfUpdates() {
  map_msgs::OccupancyGridUpdate update;
  update.x = 1;
  update.y = 1;
  update.width = 2;
  update.height = 2;
  update.data = {0, 100, -1, 7};
  return {bytesOf(update), bytesOf(map_msgs::OccupancyGridUpdate())};
}

FUZZ_TARGET(map_update, seedsOfUpdates) {
  const auto update = messageOf<map_msgs::OccupancyGridUpdate>(input);
  if (!update) return;
  static const grid::OccupancyGrid before = nodes::occupancyFromMessage(smallMap());
  mayRefuse([&] {
    grid::OccupancyGrid after = before;
    const grid::CellRect rect = nodes::checkedRect(before, *update);
    nodes::applyUpdate(*update, rect, after);
    for (const grid::CellRect& changed : grid::differences(before, after.values()))
      mustHold(changed.intersection(rect) == changed, "only cells of the update change");
    grid::checkOccupancyValues(after);
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
