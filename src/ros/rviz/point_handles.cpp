#include "ros/rviz/point_handles.h"

#include <cmath>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/conversions.h"
#include "panel/planner_colours.h"

namespace grid_path_planner::nodes {

using base::InputError;
using panel::Colour;
using panel::RoutePoints;
using path::Pose;
using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::InteractiveMarkerFeedback;
using visualization_msgs::Marker;

namespace {

constexpr double kSize = 0.7;   // m, of a handle
constexpr double kLift = 0.25;  // m: above the paths, which the mouse would take hold of else

// As in the pictures of grid_path plan.
Colour colourOfKind(RoutePoints::Kind kind) {
  if (kind == RoutePoints::Kind::START) return {0, 158, 115};
  return kind == RoutePoints::Kind::GOAL ? Colour{213, 94, 0} : Colour{204, 121, 167};
}

Marker part(int type, const Colour& colour, double x, double y, double z) {
  Marker marker;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.pose.position.z = kLift;
  marker.scale.x = x;
  marker.scale.y = y;
  marker.scale.z = z;
  marker.color.r = static_cast<float>(colour.red) / 255.0F;
  marker.color.g = static_cast<float>(colour.green) / 255.0F;
  marker.color.b = static_cast<float>(colour.blue) / 255.0F;
  marker.color.a = 0.9F;
  return marker;
}

// Its x axis is upright: the normal of the plane, the axis to turn about.
InteractiveMarkerControl uprightControl(const char* name, unsigned char mode) {
  InteractiveMarkerControl control;
  control.name = name;
  control.orientation.w = std::sqrt(0.5);
  control.orientation.y = -std::sqrt(0.5);
  control.interaction_mode = mode;
  return control;
}

// A disc with an arrow where the vehicle looks.
InteractiveMarkerControl discOf(const Colour& colour) {
  InteractiveMarkerControl control = uprightControl("move", InteractiveMarkerControl::MOVE_PLANE);
  control.always_visible = 1;
  control.markers.push_back(part(Marker::CYLINDER, colour, 0.6 * kSize, 0.6 * kSize, 0.06));
  control.markers.push_back(part(Marker::ARROW, colour, kSize, 0.25 * kSize, 0.06));
  return control;
}

// "2" on the disc of the second via-point, as messages call it.
Marker numberOf(const RoutePoints::Id& id) {
  Marker number = part(Marker::TEXT_VIEW_FACING, {0, 0, 0}, 0.0, 0.0, kSize);
  number.pose.position.z = 0.2;
  number.text = std::to_string(id.index + 1);
  return number;
}

bool samePlace(const Pose& a, const Pose& b) {
  return a.position == b.position && a.yaw == b.yaw;
}

}  // namespace

PointHandles::PointHandles(const std::string& topic, Moved moved)
    : moved_(std::move(moved)), server_(topic) {}

PointHandles::Handles PointHandles::handlesOf(const RoutePoints& points) {
  Handles handles;
  const std::string& frame = points.frame();
  if (points.start()) handles["start"] = {{RoutePoints::Kind::START, 0}, frame, *points.start()};
  if (points.goal()) handles["goal"] = {{RoutePoints::Kind::GOAL, 0}, frame, *points.goal()};
  for (std::size_t i = 0; i < points.via().size(); ++i)
    handles["via " + std::to_string(i + 1)] = {{RoutePoints::Kind::VIA, i}, frame, points.via()[i]};
  return handles;
}

void PointHandles::show(const RoutePoints& points) {
  const Handles wanted = handlesOf(points);
  for (const auto& [name, handle] : shown_)
    if (wanted.count(name) == 0) server_.erase(name);
  for (const auto& [name, handle] : wanted) {
    const auto old = shown_.find(name);
    if (old == shown_.end() || old->second.frame != handle.frame)
      insert(name, handle);
    else if (!samePlace(old->second.pose, handle.pose))
      server_.setPose(name, poseToMessage(handle.pose));
  }
  shown_ = wanted;
  server_.applyChanges();
}

void PointHandles::insert(const std::string& name, const Handle& handle) {
  InteractiveMarker marker;
  marker.header.frame_id = handle.frame;
  marker.pose = poseToMessage(handle.pose);
  marker.name = name;
  marker.description = name;
  marker.scale = static_cast<float>(kSize);
  marker.controls.push_back(discOf(colourOfKind(handle.id.kind)));
  if (handle.id.kind == RoutePoints::Kind::VIA)
    marker.controls.back().markers.push_back(numberOf(handle.id));
  // rviz draws a ring about it.
  marker.controls.push_back(uprightControl("turn", InteractiveMarkerControl::ROTATE_AXIS));
  server_.insert(marker, [this](const InteractiveMarkerFeedback::ConstPtr& feedback) {
    onFeedback(*feedback);
  });
}

void PointHandles::onFeedback(const InteractiveMarkerFeedback& feedback) {
  const auto handle = shown_.find(feedback.marker_name);
  if (feedback.event_type != InteractiveMarkerFeedback::POSE_UPDATE || handle == shown_.end())
    return;
  try {
    handle->second.pose = poseFromMessage(feedback.pose);
    moved_(handle->second.id, feedback.header.frame_id, handle->second.pose);
  } catch (const InputError&) {
    insert(handle->first, handle->second);  // dragged to where no pose is: back to where it was
    server_.applyChanges();
  }
}

}  // namespace grid_path_planner::nodes
