#include "ros/planning/plan_publisher.h"

#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/ros/conversions.h"

namespace grid_path_planner::nodes {

using path::Pose;
using path::turningOf;
using planning::Plan;

namespace {

constexpr std::size_t kMostMarkers = 50000;

using visualization_msgs::Marker;

Marker marker(const Plan& plan, const char* name, int type, double size, const ros::Time& stamp) {
  Marker marker;
  marker.header.frame_id = plan.path.frame_id;
  marker.header.stamp = stamp;
  marker.ns = name;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = size;
  marker.scale.z = type == Marker::SPHERE_LIST ? size : 0.01;
  marker.color.a = 1.0F;
  return marker;
}

geometry_msgs::Point point(double x, double y, double z) {
  geometry_msgs::Point point;
  point.x = x;
  point.y = y;
  point.z = z;
  return point;
}

// rviz shows the markers of an action only where there are points.
void deleteIfEmpty(Marker& marker) {
  if (marker.points.empty()) marker.action = Marker::DELETE;
}

}  // namespace

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

visualization_msgs::MarkerArray searchMarkers(const Plan& plan, double cell_size,
                                              const ros::Time& stamp) {
  visualization_msgs::MarkerArray array;
  const auto& cells = plan.expanded;
  Marker expanded = marker(plan, "expanded", Marker::CUBE_LIST, cell_size, stamp);
  expanded.color.g = 0.6F;
  expanded.color.b = 0.9F;
  expanded.color.a = 0.4F;
  const std::size_t stride = cells.size() / kMostMarkers + 1;
  for (std::size_t i = 0; i < cells.size(); i += stride)
    expanded.points.push_back(point(cells[i].x(), cells[i].y(), 0.0));

  Marker waypoints = marker(plan, "waypoints", Marker::SPHERE_LIST, cell_size * 0.6, stamp);
  waypoints.color.r = 1.0F;
  waypoints.color.g = 0.5F;
  for (const Pose& pose : plan.path.poses)
    waypoints.points.push_back(point(pose.position.x(), pose.position.y(), pose.position.z()));

  for (Marker* marker : {&expanded, &waypoints}) {
    deleteIfEmpty(*marker);
    array.markers.push_back(*marker);
  }
  return array;
}

PlanPublisher::PlanPublisher(ros::NodeHandle nh)
    : path_(nh.advertise<nav_msgs::Path>("path", 1, true)),
      statistics_(nh.advertise<PlanStatistics>("plan_statistics", 1, true)) {
  markers_ = nh.advertise<visualization_msgs::MarkerArray>(
      "search_markers", 1, [this](const auto&) { showUnseenSearch(); }, {}, {}, true);
}

void PlanPublisher::publishPath(const Plan& plan) {
  path_.publish(pathToMessage(plan.path, ros::Time::now()));
}

void PlanPublisher::publishSearch(const Plan& plan, PlanStatistics statistics, double cell_size) {
  const ros::Time now = ros::Time::now();
  statistics.header.stamp = now;
  statistics_.publish(statistics);
  std::lock_guard<std::mutex> lock(mutex_);
  if (markers_.getNumSubscribers() > 0) {
    unseen_.reset();
    markers_.publish(searchMarkers(plan, cell_size, now));
  } else {
    unseen_ = {plan, cell_size, now};
  }
}

void PlanPublisher::showUnseenSearch() {
  std::lock_guard<std::mutex> lock(mutex_);
  if (unseen_) markers_.publish(searchMarkers(unseen_->plan, unseen_->cell_size, unseen_->stamp));
  unseen_.reset();
}

}  // namespace grid_path_planner::nodes
