#include "panel/route_points.h"

#include <cmath>

namespace grid_path_planner::panel {

using path::Pose;

namespace {

constexpr double kFarthest = 1e6;  // m

bool usable(const Pose& pose) {
  return pose.position.array().isFinite().all() && std::isfinite(pose.yaw) &&
         pose.position.cwiseAbs().maxCoeff() <= kFarthest;
}

std::string complaintOf(const std::string& frame, const Pose& pose) {
  if (frame.empty())
    return "The point has no frame: set rviz's Fixed Frame to the map's, such as map";
  if (!usable(pose)) return "The point is not finite, or beyond 1e6 m: it is passed over";
  return "";
}

}  // namespace

std::string RoutePoints::set(Id id, const std::string& frame, const Pose& pose) {
  std::string complaint = complaintOf(frame, pose);
  if (!complaint.empty()) return complaint;
  if (id.kind == Kind::VIA && (frame != frame_ || id.index >= via_.size()))
    return "There is no such via-point any more";
  moveTo(frame);
  if (id.kind == Kind::START)
    start_ = pose;
  else if (id.kind == Kind::GOAL)
    goal_ = pose;
  else
    via_[id.index] = pose;
  return "";
}

std::string RoutePoints::addVia(const std::string& frame, const Pose& pose) {
  std::string complaint = complaintOf(frame, pose);
  if (!complaint.empty()) return complaint;
  if (via_.size() == kMostVia)
    return "A route has at most " + std::to_string(kMostVia) + " via-points";
  moveTo(frame);
  via_.push_back(pose);
  return "";
}

void RoutePoints::removeLastVia() {
  if (!via_.empty()) via_.pop_back();
}

void RoutePoints::clear() {
  *this = RoutePoints();
}

void RoutePoints::moveTo(const std::string& frame) {
  if (frame == frame_) return;
  clear();
  frame_ = frame;
}

}  // namespace grid_path_planner::panel
