// Updates of a map that have no cells.
//
// Of 0x0 cells at column 0: a heartbeat. At column 1: an announcement, that a whole map of another place or size is sent now. Maps
// have a connection of their own, and are overtaken by updates: what follows the announcement belongs to that map, and
// its columns and rows would be others in the one before. To whoever does not know it, an announcement changes nothing.
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>

namespace grid_path_planner::nodes {

inline bool hasNoCells(const map_msgs::OccupancyGridUpdate& update) {
  return update.width == 0 && update.height == 0 && update.data.empty();
}

inline bool isAnnouncement(const map_msgs::OccupancyGridUpdate& update) {
  return hasNoCells(update) && update.x == 1;
}

// Stamped as the map is.
inline map_msgs::OccupancyGridUpdate announcementOf(const nav_msgs::OccupancyGrid& map) {
  map_msgs::OccupancyGridUpdate update;
  update.header.frame_id = map.header.frame_id;
  update.header.stamp = map.header.stamp;
  update.x = 1;
  return update;
}

}  // namespace grid_path_planner::nodes
