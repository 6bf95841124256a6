#include "ros/planning/shown/plan_markers.h"

#include <algorithm>

#include "grid_path_planner/ros/conversions.h"
#include "ros/messages/wrapped_text.h"

namespace grid_path_planner::nodes {

using path::Pose;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

namespace {

constexpr std::size_t kMostMarkers = 50000;
constexpr double kDiscHeight = 0.02, kOutline = 0.03;                 // m
constexpr double kSmallestEnd = 0.25, kArrow = 0.8, kTextSize = 0.4;  // m
constexpr double kLinesOfText = 45.0;  // in the height of a map that fills the view
constexpr double kClearOfGoal = 0.6;   // m, so that rviz's handle of a point there can be clicked

struct Colour {
  float red, green, blue, alpha;
};
constexpr Colour kExpanded{0.0F, 0.6F, 0.9F, 0.4F}, kCorner{1.0F, 0.5F, 0.0F, 1.0F},
    kStart{0.0F, 0.62F, 0.45F, 0.9F}, kGoal{0.84F, 0.37F, 0.0F, 0.9F},
    kVehicle{0.0F, 0.45F, 0.7F, 0.35F}, kFailure{0.84F, 0.37F, 0.0F, 1.0F};

geometry_msgs::Point pointOf(double x, double y, double z) {
  geometry_msgs::Point point;
  point.x = x;
  point.y = y;
  point.z = z;
  return point;
}

// Says nothing yet: it is deleted from the display.
Marker nothing(const ShownPlan& shown, const char* name, const Colour& colour) {
  Marker marker;
  marker.header.frame_id = shown.plan.path.frame_id;
  marker.header.stamp = shown.statistics.header.stamp;
  marker.ns = name;
  marker.action = Marker::DELETE;
  marker.pose.orientation.w = 1.0;
  marker.color.r = colour.red;
  marker.color.g = colour.green;
  marker.color.b = colour.blue;
  marker.color.a = colour.alpha;
  return marker;
}

void show(Marker& marker, int type, double x, double y, double z) {
  marker.type = type;
  marker.action = Marker::ADD;
  marker.scale.x = x;
  marker.scale.y = y;
  marker.scale.z = z;
}

void showOutline(Marker& marker, const std::vector<Eigen::Vector2d>& corners) {
  show(marker, Marker::LINE_STRIP, kOutline, 0.0, 0.0);
  for (std::size_t i = 0; i <= corners.size(); ++i) {
    const Eigen::Vector2d& corner = corners[i % corners.size()];
    marker.points.push_back(pointOf(corner.x(), corner.y(), kDiscHeight));
  }
}

Marker expandedMarker(const ShownPlan& shown) {
  Marker marker = nothing(shown, "expanded", kExpanded);
  const auto& cells = shown.plan.expanded;
  if (!cells.empty()) show(marker, Marker::CUBE_LIST, shown.cell_size, shown.cell_size, 0.01);
  const std::size_t stride = cells.size() / kMostMarkers + 1;
  for (std::size_t i = 0; i < cells.size(); i += stride)
    marker.points.push_back(pointOf(cells[i].x(), cells[i].y(), 0.0));
  return marker;
}

Marker waypointsMarker(const ShownPlan& shown) {
  Marker marker = nothing(shown, "waypoints", kCorner);
  const double size = shown.cell_size * 0.6;
  if (shown.plan.found()) show(marker, Marker::SPHERE_LIST, size, size, size);
  for (const Pose& pose : shown.plan.path.poses)
    marker.points.push_back(pointOf(pose.position.x(), pose.position.y(), pose.position.z()));
  return marker;
}

Marker startMarker(const ShownPlan& shown) {
  Marker marker = nothing(shown, "start", kStart);
  if (!shown.plan.found()) return marker;
  const double size = std::max(kSmallestEnd, 2.0 * shown.cell_size);
  show(marker, Marker::CYLINDER, size, size, kDiscHeight);
  marker.pose = poseToMessage(shown.plan.path.poses.front());
  return marker;
}

Marker goalMarker(const ShownPlan& shown) {
  Marker marker = nothing(shown, "goal", kGoal);
  if (!shown.plan.found()) return marker;
  const double length = std::max(kArrow, 4.0 * shown.cell_size);
  show(marker, Marker::ARROW, length, 0.25 * length, kDiscHeight);
  marker.pose = poseToMessage(shown.plan.path.poses.back());
  return marker;
}

// Without a stamp: rviz moves it with the newest transform.
Marker vehicleMarker(const ShownPlan& shown) {
  Marker marker = nothing(shown, "vehicle", kVehicle);
  if (shown.radius <= 0.0 && shown.footprint.empty()) return marker;
  if (shown.footprint.empty())
    show(marker, Marker::CYLINDER, 2.0 * shown.radius, 2.0 * shown.radius, kDiscHeight);
  else
    showOutline(marker, shown.footprint);
  marker.header.frame_id = shown.base_frame;
  marker.header.stamp = ros::Time();
  marker.frame_locked = true;
  return marker;
}

Marker failureMarker(const ShownPlan& shown) {
  Marker marker = nothing(shown, "failure", kFailure);
  const geometry_msgs::PoseStamped& goal = shown.statistics.goal;
  if (shown.plan.found() || goal.header.frame_id.empty()) return marker;
  const double size = std::max({kTextSize, 6.0 * shown.cell_size, shown.map_side / kLinesOfText});
  show(marker, Marker::TEXT_VIEW_FACING, 0.0, 0.0, size);
  marker.header.frame_id = goal.header.frame_id;
  marker.text = wrappedText(shown.statistics.status + ": " + shown.statistics.message);
  marker.pose.position = goal.pose.position;
  const auto breaks = std::count(marker.text.begin(), marker.text.end(), '\n');
  marker.pose.position.y += kClearOfGoal + size * (1.0 + static_cast<double>(breaks)) / 2.0;
  marker.pose.position.z += size;
  return marker;
}

}  // namespace

MarkerArray planMarkers(const ShownPlan& shown) {
  MarkerArray array;
  array.markers = {expandedMarker(shown), waypointsMarker(shown), startMarker(shown),
                   goalMarker(shown),     vehicleMarker(shown),   failureMarker(shown)};
  return array;
}

}  // namespace grid_path_planner::nodes
