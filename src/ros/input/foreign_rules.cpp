#include "ros/input/foreign_rules.h"

#include <ros/console.h>

#include "grid_path_planner/base/level_quaternion.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

bool ToldOnce::isNew(const std::string& thing) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (told_.size() >= kMost) told_.clear();
  return told_.insert(thing).second;
}

void warnOnce(const std::string& topic, const std::string& publisher, const std::string& trait) {
  static ToldOnce told;
  const std::string sentence = printable(topic) + " of " + printable(publisher) + ": " + trait;
  ROS_WARN_STREAM_COND(told.isNew(sentence), sentence);
}

std::string topicOf(const boost::shared_ptr<ros::M_string>& connection_header) {
  if (!connection_header) return "";
  const auto topic = connection_header->find("topic");
  return topic == connection_header->end() ? "" : topic->second;
}

bool isNotYet(const MapEvent& event) {
  if (!isEmptyMap(*event.getConstMessage())) return false;
  warnOnce(event, "a map without cells is none yet, and the map before it stays");
  return true;
}

void tellTraits(const MapEvent& event) {
  const nav_msgs::OccupancyGrid& map = *event.getConstMessage();
  if (hasNoOrientation(map.info)) warnOnce(event, base::kYawAssumed);
  if (grid::isInflated(map.data, map.info.width)) warnOnce(event, grid::kInflated);
}

std::string MapFit::problem(const std::shared_ptr<const grid::OccupancyGrid>& map,
                            const grid::OccupancyThresholds& thresholds) {
  if (!map) return "";
  const std::string& problem = fit_.problem(map, thresholds);
  if (!problem.empty() && problem != told_) ROS_WARN_STREAM(problem);
  told_ = problem;
  return problem;
}

}  // namespace grid_path_planner::nodes
