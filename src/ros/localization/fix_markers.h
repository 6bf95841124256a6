// Fixes of the position as they were judged when they came, for rviz.
//
//   fix_markers   visualization_msgs/MarkerArray: the newest `kKept`; used ones in green (namespace "accepted"), gated
//                 ones in red ("rejected"), those that nothing was done with, as before the start, in grey ("unused")
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <visualization_msgs/MarkerArray.h>

#include <deque>
#include <optional>
#include <string>

#include "localization/measurement.h"

namespace grid_path_planner::nodes {

class FixMarkers {
 public:
  static constexpr std::size_t kKept = 300;

  explicit FixMarkers(ros::NodeHandle& nh);

  // A position or a pose in the frame `map`; other measurements are passed over.
  void add(const localization::Measurement& measurement, localization::Verdict verdict,
           const std::string& map);
  // ROS time begins anew.
  void clear();

 private:
  struct Fix {
    geometry_msgs::Point position;
    localization::Verdict verdict;
  };
  visualization_msgs::MarkerArray message(const std::string& map) const;

  std::deque<Fix> fixes_;
  ros::Publisher publisher_;
};

}  // namespace grid_path_planner::nodes
