#include "ros/planning/shown/explanation_publisher.h"

#include <visualization_msgs/MarkerArray.h>

#include <algorithm>

#include "ros/guard/outgoing/latched_message.h"
#include "ros/messages/wrapped_text.h"

namespace grid_path_planner::nodes {

using planning::Explanation;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

namespace {

constexpr double kHeight = 0.05;   // m, of discs
constexpr double kSmallest = 0.1;  // m, of what is to be seen

Marker markerAt(const Eigen::Vector2d& position, const char* name, int type, double size) {
  Marker marker;
  marker.ns = name;
  marker.type = type;
  marker.pose.position.x = position.x();
  marker.pose.position.y = position.y();
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = std::max(size, kSmallest);
  marker.scale.z = type == Marker::CYLINDER ? kHeight : kSmallest;
  marker.color.a = 0.8F;
  return marker;
}

MarkerArray markersOf(const Explanation& explanation) {
  MarkerArray array;
  if (explanation.gap) {
    Marker gap =
        markerAt(explanation.gap->position, "gap", Marker::CYLINDER, explanation.gap->width);
    gap.color.r = 0.84F;
    gap.color.g = 0.37F;
    array.markers.push_back(gap);
  }
  if (explanation.nearest) {
    Marker nearest = markerAt(*explanation.nearest, "nearest", Marker::SPHERE, kSmallest);
    nearest.color.g = 0.45F;
    nearest.color.b = 0.7F;
    array.markers.push_back(nearest);
  }
  if (array.markers.empty()) return array;
  Marker text = array.markers.front();
  text.ns = "why";
  text.type = Marker::TEXT_VIEW_FACING;
  text.scale.z = 0.25;
  text.pose.position.z = 0.5;
  text.text = wrappedText(explanation.text);
  array.markers.push_back(text);
  return array;
}

}  // namespace

ExplanationPublisher::ExplanationPublisher(ros::NodeHandle nh)
    : publisher_(nh.advertise<MarkerArray>("explanation_markers", 1, true)) {}

void ExplanationPublisher::publish(const Explanation& explanation, const std::string& frame) {
  MarkerArray array = markersOf(explanation);
  Marker others;
  others.action = Marker::DELETEALL;
  array.markers.insert(array.markers.begin(), others);
  for (Marker& marker : array.markers) {
    marker.header.frame_id = frame;
    marker.header.stamp = ros::Time::now();
  }
  shown_ = true;
  publishLatched(publisher_, array);
}

void ExplanationPublisher::clear() {
  if (!shown_.exchange(false)) return;
  MarkerArray array;
  array.markers.resize(1);
  array.markers[0].action = Marker::DELETEALL;
  publishLatched(publisher_, array);
}

}  // namespace grid_path_planner::nodes
