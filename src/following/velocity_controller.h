// From a position on the route to the velocity that drives along it.
//
//   VelocityController controller(options);
//   BodyVelocity velocity = controller.follow({route, segment, share, at_stop}, pose, seconds);
//
// Guaranteed: the speeds of the options are never exceeded, and from one call to the next the
// velocity changes no faster than they say; stop() alone is immediate.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>

#include "following/driven_route.h"
#include "grid_path_planner/base/body_velocity.h"
#include "grid_path_planner/following/follower_options.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::following {

// The point of the route that is nearest to the vehicle.
struct RoutePosition {
  const DrivenRoute& route;
  std::size_t segment;
  double share;  // of the segment, 0 to 1
  bool at_stop;  // whether the vehicle has been at the segment's end, where it stops

  Eigen::Vector3d point() const { return route.point(segment, share); }
};

// The yaw that `vehicle` should have there.
double wantedYaw(const RoutePosition& position, const path::Pose& vehicle,
                 const FollowerOptions& options);

class VelocityController {
 public:
  // `options` must outlive the controller; changes count from the next call on.
  explicit VelocityController(const FollowerOptions& options) : options_(options) {}

  // `seconds`: since the last call.
  base::BodyVelocity follow(const RoutePosition& position, const path::Pose& vehicle,
                            double seconds);
  // Brings a vehicle that left the tolerances of `target` back to it; otherwise, and without
  // hold_pose, stops.
  base::BodyVelocity holdPose(const path::Pose& target, const path::Pose& vehicle, double seconds);
  // In the plane, m/s, beside the options; from the next call on.
  void limitSpeed(double most) { speed_limit_ = most; }
  void stop();
  // A new drive: nothing is held any longer.
  void release() { returning_ = false; }
  // From the next call on poses are in another frame; the vehicle has the velocity that it had.
  void changeFrame();

 private:
  Eigen::Vector3d wantedVelocity(const RoutePosition& position,
                                 const Eigen::Vector3d& vehicle) const;
  base::BodyVelocity limited(const path::Pose& vehicle, const Eigen::Vector3d& velocity,
                             double yaw_error, double seconds);

  const FollowerOptions& options_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // commanded last, path frame
  double yaw_rate_ = 0.0;
  double yaw_ = 0.0;          // of the vehicle then
  bool other_frame_ = false;  // than that of velocity_ and yaw_: the next call's
  double speed_limit_ = std::numeric_limits<double>::infinity();
  bool returning_ = false;  // to the pose that is held
};

}  // namespace grid_path_planner::following
