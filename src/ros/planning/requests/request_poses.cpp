#include "ros/planning/requests/request_poses.h"

#include <functional>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::nodes {

using base::InputError;
using path::Pose;
using planning::ViaRequest;

namespace {

Pose named(const std::string& which, const std::function<Pose()>& pose) {
  try {
    return pose();
  } catch (const InputError& error) {
    throw InputError("the " + which + ": " + error.what());
  }
}

geometry_msgs::Quaternion levelOrientation() {
  geometry_msgs::Quaternion orientation;
  orientation.w = 1.0;
  return orientation;
}

}  // namespace

std::optional<double> oldestStart(const PathPlannerNodeOptions& options) {
  return options.tf_timeout > 0.0 ? std::make_optional(options.tf_timeout) : std::nullopt;
}

ViaRequest posesOf(const PlanningRequest& request, const PathPlannerNodeOptions& options,
                   const FrameLookup& transforms, const std::string& map_frame,
                   const base::StopToken& stop) {
  const auto inMap = [&](const geometry_msgs::PoseStamped& pose) {
    return transforms.poseIn(map_frame, pose, options.map_frame, options.tf_timeout, stop);
  };
  ViaRequest poses;
  if (!request.order.empty())
    poses.order = base::choiceFromName<planning::ViaOrder>("order", request.order);
  if (!request.closed) poses.goal = named("goal", [&] { return inMap(request.goal); });
  poses.start = named("start", [&] {
    if (request.start) return inMap(*request.start);
    return transforms.poseOf(options.base_frame, map_frame, options.tf_timeout, stop,
                             oldestStart(options));
  });
  if (request.closed) poses.goal = poses.start;
  if (request.via_points.size() > planning::kMostVia)
    throw InputError("there are " + std::to_string(request.via_points.size()) +
                     " via-points, and at most " + std::to_string(planning::kMostVia) +
                     " can be visited");
  for (geometry_msgs::PoseStamped via : request.via_points) {
    via.pose.orientation = levelOrientation();
    const std::string name = "via-point " + std::to_string(poses.via.size() + 1);
    poses.via.push_back(named(name, [&] { return inMap(via); }).position);
  }
  if (options.goal_z_from == GoalZ::VEHICLE) {
    poses.goal.position.z() = poses.start.position.z();
    for (Eigen::Vector3d& via : poses.via) via.z() = poses.start.position.z();
  }
  return poses;
}

}  // namespace grid_path_planner::nodes
