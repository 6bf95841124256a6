#include "ros/planning/requests/request_poses.h"

#include <cmath>
#include <functional>
#include <limits>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"

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

Placing placingInMap(const PathPlannerNodeOptions& options, const std::string& map_frame,
                     const base::StopToken& stop) {
  Placing by{map_frame, options.tf_timeout, Moving::WITH_VEHICLE, frameName(options.base_frame),
             options.zero_heading};
  if (options.tf_timeout <= 0.0) by.max_age = std::numeric_limits<double>::infinity();
  by.map_frame = options.map_frame;
  by.wait = options.tf_timeout;
  by.stop = stop;
  return by;
}

ViaRequest posesOf(const PlanningRequest& request, const PathPlannerNodeOptions& options,
                   const FrameLookup& transforms, const std::string& map_frame,
                   const base::StopToken& stop) {
  const Placing by = placingInMap(options, map_frame, stop);
  Placing start_by = by;
  start_by.zero_heading = ZeroHeading::REFUSED;
  ViaRequest poses;
  if (!request.order.empty())
    poses.order = base::choiceFromName<planning::ViaOrder>("order", request.order);
  if (!request.closed)
    poses.goal = named("goal", [&] { return transforms.place(request.goal, by); });
  poses.start = named("start", [&] {
    return request.start ? transforms.place(*request.start, start_by)
                         : transforms.placeVehicle(by).level();
  });
  if (request.closed) poses.goal = poses.start;
  poses.any_goal_heading = std::isnan(poses.goal.yaw);
  if (poses.any_goal_heading) poses.goal.yaw = poses.start.yaw;
  if (request.via_points.size() > planning::kMostVia)
    throw InputError("there are " + std::to_string(request.via_points.size()) +
                     " via-points, and at most " + std::to_string(planning::kMostVia) +
                     " can be visited");
  for (geometry_msgs::PoseStamped via : request.via_points) {
    via.pose.orientation = levelOrientation();
    const std::string name = "via-point " + std::to_string(poses.via.size() + 1);
    poses.via.push_back(named(name, [&] { return transforms.place(via, by); }).position);
  }
  if (options.goal_z_from == GoalZ::VEHICLE) {
    poses.goal.position.z() = poses.start.position.z();
    for (Eigen::Vector3d& via : poses.via) via.z() = poses.start.position.z();
  }
  return poses;
}

}  // namespace grid_path_planner::nodes
