#include "ros/localization/fix_markers.h"

namespace grid_path_planner::nodes {

using localization::Verdict;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

namespace {

constexpr double kDiameter = 0.2;  // m

std::optional<Eigen::Vector3d> positionOf(const localization::Measurement& measurement) {
  if (const auto* fix = std::get_if<localization::PositionFix>(&measurement.data))
    return fix->position;
  if (const auto* fix = std::get_if<localization::PoseFix>(&measurement.data)) return fix->position;
  return {};
}

struct Kind {
  const char* name;
  float red, green, blue;
};
constexpr Kind kKinds[] = {
    {"accepted", 0.0f, 0.6f, 0.2f}, {"rejected", 0.9f, 0.1f, 0.1f}, {"unused", 0.6f, 0.6f, 0.6f}};

const Kind& kindOf(Verdict verdict) {
  if (verdict == Verdict::TAKEN || verdict == Verdict::RESET) return kKinds[0];
  return verdict == Verdict::GATED ? kKinds[1] : kKinds[2];
}

Marker emptyMarker(const Kind& kind, const std::string& map) {
  Marker marker;
  marker.header.frame_id = map;
  marker.ns = kind.name;
  marker.type = Marker::SPHERE_LIST;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = kDiameter;
  marker.color.r = kind.red;
  marker.color.g = kind.green;
  marker.color.b = kind.blue;
  marker.color.a = 0.8f;
  return marker;
}

}  // namespace

FixMarkers::FixMarkers(ros::NodeHandle& nh)
    : publisher_(nh.advertise<MarkerArray>("fix_markers", 1)) {}

void FixMarkers::add(const localization::Measurement& measurement, Verdict verdict,
                     const std::string& map) {
  const auto position = positionOf(measurement);
  if (!position) return;
  Fix fix{{}, verdict};
  fix.position.x = position->x();
  fix.position.y = position->y();
  fix.position.z = position->z();
  fixes_.push_back(fix);
  if (fixes_.size() > kKept) fixes_.pop_front();
  if (publisher_.getNumSubscribers() > 0) publisher_.publish(message(map));
}

void FixMarkers::clear() {
  fixes_.clear();
  if (publisher_.getNumSubscribers() > 0) publisher_.publish(message(""));
}

// A namespace without a fix is deleted: rviz warns of a list without points.
MarkerArray FixMarkers::message(const std::string& map) const {
  MarkerArray array;
  for (const Kind& kind : kKinds) {
    Marker marker = emptyMarker(kind, map);
    for (const Fix& fix : fixes_)
      if (&kindOf(fix.verdict) == &kind) marker.points.push_back(fix.position);
    if (marker.points.empty()) marker.action = Marker::DELETE;
    array.markers.push_back(marker);
  }
  return array;
}

}  // namespace grid_path_planner::nodes
