#include "ros/rviz/panel_markers.h"

#include <algorithm>

#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/ros/conversions.h"
#include "panel/planner_colours.h"
#include "panel/shown_text.h"
#include "ros/messages/wrapped_text.h"

namespace grid_path_planner::nodes {

using panel::Colour;
using panel::colourOf;
using panel::shownText;
using path::lengthOf;
using path::Path;
using path::Pose;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

namespace {

constexpr double kWidth = 0.08, kLowest = 0.04, kStep = 0.01;  // m
constexpr double kBetweenHeads = 2.0, kHead = 0.3;             // m
constexpr std::size_t kMostHeads = 200, kLongestLabel = 200;
constexpr Colour kPath{0, 114, 178}, kGap{213, 94, 0}, kNearest{0, 114, 178};

Marker markerOf(const std::string& frame, const std::string& name, int id, int type,
                const Colour& colour) {
  Marker marker;
  marker.header.frame_id = frame;
  marker.ns = name;
  marker.id = id;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.color.r = static_cast<float>(colour.red) / 255.0F;
  marker.color.g = static_cast<float>(colour.green) / 255.0F;
  marker.color.b = static_cast<float>(colour.blue) / 255.0F;
  marker.color.a = 1.0F;
  return marker;
}

Marker lineOf(const Path& path, const std::string& name, int id, const Colour& colour) {
  Marker line = markerOf(path.frame_id, name, id, Marker::LINE_STRIP, colour);
  for (const Pose& pose : path.poses) line.points.push_back(poseToMessage(pose).position);
  return line;
}

// Along the line between two poses, at its middle.
Marker arrowhead(const Path& path, std::size_t i, int id) {
  Marker head = markerOf(path.frame_id, "arrowheads", id, Marker::ARROW, kPath);
  const Eigen::Vector3d from = path.poses[i - 1].position, to = path.poses[i].position;
  const Eigen::Vector3d along = (to - from).normalized() * (kHead / 2.0);
  for (const double side : {-1.0, 1.0}) {
    Pose end;
    end.position = (from + to) / 2.0 + side * along + Eigen::Vector3d(0.0, 0.0, kLowest);
    head.points.push_back(poseToMessage(end).position);
  }
  head.scale.x = 0.01;
  head.scale.y = head.scale.z = kHead;
  return head;
}

void addArrowheads(const Path& path, MarkerArray& array) {
  const double apart = std::max(kBetweenHeads, lengthOf(path) / static_cast<double>(kMostHeads));
  double since = apart / 2.0;
  int id = 0;
  for (std::size_t i = 1; i < path.poses.size(); ++i) {
    const double length = (path.poses[i].position - path.poses[i - 1].position).norm();
    since += length;
    if (length == 0.0 || since < apart) continue;
    array.markers.push_back(arrowhead(path, i, ++id));
    since = 0.0;
  }
}

void addCompared(const std::vector<ComparedPath>& compared, MarkerArray& array) {
  for (std::size_t i = 0; i < compared.size(); ++i) {
    if (compared[i].path.poses.size() < 2) continue;
    Marker line =
        lineOf(compared[i].path, "compared", static_cast<int>(i), colourOf(compared[i].planner));
    line.pose.position.z = kLowest + kStep * static_cast<double>(i);
    line.scale.x = kWidth * (0.6 + 0.5 * static_cast<double>(compared.size() - i));
    array.markers.push_back(line);
  }
}

}  // namespace

MarkerArray panelMarkers(const Path& path, const std::vector<ComparedPath>& compared) {
  MarkerArray array;
  array.markers.resize(1);
  array.markers[0].action = Marker::DELETEALL;
  if (compared.empty() && path.poses.size() > 1) {
    array.markers.push_back(lineOf(path, "path", 0, kPath));
    array.markers.back().pose.position.z = kLowest;
    array.markers.back().scale.x = kWidth;
    addArrowheads(path, array);
  }
  addCompared(compared, array);
  return array;
}

MarkerArray explanationMarkers(const ExplainPlan::Response& explanation, const std::string& frame) {
  MarkerArray array;
  if (explanation.has_gap) {
    array.markers.push_back(markerOf(frame, "gap", 0, Marker::CYLINDER, kGap));
    array.markers.back().pose.position = explanation.gap;
    array.markers.back().scale.x = std::max(explanation.gap_width_m, 0.1);
  }
  if (explanation.has_nearest) {
    array.markers.push_back(markerOf(frame, "nearest", 0, Marker::CYLINDER, kNearest));
    array.markers.back().pose.position = explanation.nearest;
    array.markers.back().scale.x = 0.2;
  }
  if (array.markers.empty()) return array;
  for (Marker& marker : array.markers) {
    marker.scale.y = marker.scale.x;
    marker.scale.z = 0.05;
  }
  Marker text = markerOf(frame, "why", 0, Marker::TEXT_VIEW_FACING, kGap);
  text.pose.position = array.markers.front().pose.position;
  text.pose.position.z += 0.5;
  text.scale.z = 0.3;
  text.text = wrappedText(shownText(explanation.message, kLongestLabel));
  array.markers.push_back(text);
  return array;
}

}  // namespace grid_path_planner::nodes
