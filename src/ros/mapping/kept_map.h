// The lines of a kept octree (map_autosave.h) that say of which map it is, and what is in it.
//
//   const std::string text = octree.fileText(commentsOf("run 7", newest_cloud));
//   const auto kept = keptMap(text.substr(0, 4096), "run 7");     // kept->newest_cloud
#pragma once

#include <ros/time.h>

#include <optional>
#include <string>
#include <vector>

namespace grid_path_planner::nodes {

struct KeptMap {
  ros::Time newest_cloud;  // 0: nobody knows
};

// `marker`: one line.
std::vector<std::string> commentsOf(const std::string& marker, const ros::Time& newest_cloud);

// Of the beginning of such a file; none for one with another marker, and for any other file.
std::optional<KeptMap> keptMap(const std::string& beginning, const std::string& marker);

}  // namespace grid_path_planner::nodes
