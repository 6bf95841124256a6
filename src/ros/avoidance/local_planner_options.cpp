#include "ros/avoidance/local_planner_options.h"

#include <ros/names.h>

#include <sstream>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {
namespace {

constexpr std::size_t kMostTopics = 16;

}  // namespace

void checkLocalPlannerOptions(const LocalPlannerOptions& options) {
  base::checkOptionLimits(options);
  avoidance::checkPilotOptions(options.pilot);
  if (options.control_rate * options.pilot.frame_period < 1.0 - 1e-9)
    throw base::InputError(
        "control_rate must be at least 1 / frame_period, since a command holds "
        "for frame_period; got " +
        base::decimalText(options.control_rate) + " Hz and " +
        base::decimalText(options.pilot.frame_period) + " s");
  checkNetworkText("map_frame", options.map_frame);
  checkNetworkText("base_frame", options.base_frame);
  if (options.map_frame.empty() || options.base_frame.empty())
    throw base::InputError("map_frame and base_frame must not be empty");
  checkNetworkText("cloud_topics", options.cloud_topics);
  const std::vector<std::string> topics = cloudTopics(options);
  if (topics.size() > kMostTopics)
    throw base::InputError("cloud_topics may name at most 16, got " +
                           std::to_string(topics.size()));
  std::string error;
  for (const std::string& topic : topics)
    if (!ros::names::validate(topic, error)) throw base::InputError("cloud_topics: " + error);
}

void nameFrames(LocalPlannerOptions& options) {
  options.map_frame = frameName(options.map_frame);
  options.base_frame = frameName(options.base_frame);
}

std::vector<std::string> cloudTopics(const LocalPlannerOptions& options) {
  std::istringstream in(options.cloud_topics);
  std::vector<std::string> topics;
  for (std::string topic; in >> topic;) topics.push_back(topic);
  if (topics.empty()) topics = {"points"};
  return topics;
}

std::string cameraTopic(const std::string& cloud_topic) {
  return cloud_topic.substr(0, cloud_topic.rfind('/') + 1) + "camera_info";
}

}  // namespace grid_path_planner::nodes
