// A map as one has it who takes whole maps and updates, and as another process has it who takes whole
// maps only.
#pragma once

#include <gtest/gtest.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>

#include <string>

#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::test {

class MapCopy {
 public:
  MapCopy(ros::NodeHandle nh, const std::string& topic)
      : maps_(nh, topic), updates_(nh, topic + "_updates") {}

  bool connected() const { return maps_.connected() && updates_.connected(); }
  std::size_t maps() const { return maps_.count(); }
  std::size_t updates() const { return updates_.count(); }

  // The newest whole map with the updates that are not older. Precondition: one came.
  grid::OccupancyGrid grid() const {
    const nav_msgs::OccupancyGrid newest = maps_.all().back();
    grid::OccupancyGrid grid = nodes::occupancyFromMessage(newest);
    for (const map_msgs::OccupancyGridUpdate& update : updates_.all()) {
      if (update.header.stamp < newest.header.stamp) continue;
      for (std::size_t i = 0; i < update.data.size(); ++i)
        grid[grid::Cell{update.x + static_cast<int>(i % update.width),
                        update.y + static_cast<int>(i / update.width)}] = update.data[i];
    }
    return grid;
  }

 private:
  Latest<nav_msgs::OccupancyGrid> maps_;
  Latest<map_msgs::OccupancyGridUpdate> updates_;
};

// Listens to whole maps in a process of its own, as a node that does not know of updates.
class WholeMapListener {
 public:
  explicit WholeMapListener(const std::string& topic) : echo_({"rostopic", "echo", topic}) {}

  bool hasMap() { return echo_.says("---"); }
  void end() { echo_.end(SIGINT); }

  // The first and the newest one that have come whole. Precondition of both: hasMap().
  grid::OccupancyGrid firstGrid() const {
    const std::string heard = echo_.output();
    return read(heard.substr(0, heard.find("---")));
  }
  grid::OccupancyGrid grid() const {
    const std::string heard = echo_.output();
    const std::size_t end = heard.rfind("---");
    const std::size_t before = heard.rfind("---\n", end - 1);
    const std::size_t begin = before == std::string::npos ? 0 : before + 4;
    return read(heard.substr(begin, end - begin));
  }

 private:
  static grid::OccupancyGrid read(const std::string& message) {
    const TemporaryFolder folder;
    return grid::readMapFile(folder.write("whole_map.yaml", message));
  }

  Process echo_;
};

}  // namespace grid_path_planner::test
