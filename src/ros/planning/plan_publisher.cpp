#include "ros/planning/plan_publisher.h"

#include <utility>

#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/ros/conversions.h"
#include "ros/guard/outgoing/latched_message.h"

namespace grid_path_planner::nodes {

using path::Path;
using path::turningOf;
using planning::Plan;

PlanStatistics statisticsMessage(const Plan& plan) {
  PlanStatistics message;
  message.header.frame_id = plan.path.frame_id;
  message.status = std::string(toString(plan.status));
  message.message = plan.message;
  message.kernel = plan.kernel;
  message.cost = plan.costValue();
  message.length_m = plan.length_m;
  message.turning_rad = turningOf(plan.path);
  message.cells = static_cast<std::uint32_t>(plan.cells);
  message.expanded = plan.statistics.expanded;
  message.generated = plan.statistics.generated;
  message.reopened = plan.statistics.reopened;
  message.peak_open = plan.statistics.peak_open;
  message.search_bytes = plan.statistics.search_bytes;
  message.planning_time_ms = plan.statistics.time_s * 1000.0;
  message.preparation_time_ms = plan.preparation_time_s * 1000.0;
  return message;
}

PlanPublisher::PlanPublisher(ros::NodeHandle nh)
    : path_(nh.advertise<nav_msgs::Path>("path", 1, true)),
      statistics_(nh.advertise<PlanStatistics>("plan_statistics", 1, true)) {
  markers_ = nh.advertise<visualization_msgs::MarkerArray>(
      "search_markers", 1, [this](const auto&) { showUnseenSearch(); }, {}, {}, true);
}

void PlanPublisher::publishPath(const Path& path, const ros::Time& goal_given) {
  nav_msgs::Path message = pathToMessage(path, ros::Time::now());
  if (!message.poses.empty()) message.poses.back().header.stamp = goal_given;
  publishLatched(path_, message);
}

void PlanPublisher::publishSearch(ShownPlan shown) {
  shown.statistics.header.stamp = ros::Time::now();
  publishLatched(statistics_, shown.statistics);
  std::lock_guard<std::mutex> lock(mutex_);
  unseen_.reset();
  if (markers_.getNumSubscribers() > 0)
    markers_.publish(planMarkers(shown));
  else
    unseen_ = std::move(shown);
}

void PlanPublisher::showUnseenSearch() {
  std::lock_guard<std::mutex> lock(mutex_);
  if (unseen_) markers_.publish(planMarkers(*unseen_));
  unseen_.reset();
}

}  // namespace grid_path_planner::nodes
