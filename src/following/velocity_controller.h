// From a position on the route to the velocity that drives along it, one class a kind of drive.
//
//   const auto controller = makeController(options, vehicle);
//   const Steering steering = controller->follow({route, segment, share, at_stop}, pose, seconds, 1.0);
//   controller->take(steering);                       // it is sent
//
// Guaranteed: the speeds of the options are never exceeded, and from one that was taken to the next the
// velocity changes no faster than they say; stop() alone is immediate. Asking changes nothing: several steerings may be
// asked for, and one be taken.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>

#include "following/driven_route.h"
#include "grid_path_planner/base/body_velocity.h"
#include "grid_path_planner/following/follower_options.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::vehicle {
struct Description;
}  // namespace grid_path_planner::vehicle

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

// A command, and what a controller remembers once it is sent.
struct Steering {
  base::BodyVelocity command = {};
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, path frame
  double yaw = 0.0;                                    // of the vehicle then
  bool returning = false;                              // to the pose that is held
  bool turning = false;                                // on the spot, towards the path
  bool backwards = false;

  // The same arc, slower.
  Steering slowed(double factor) const;
  // The turn of it alone, on the spot, and the rest of it.
  Steering turnAlone() const;
  Steering withoutTurn() const;
};

class VelocityController {
 public:
  // `options` must outlive the controller; changes count from the next call on.
  explicit VelocityController(const FollowerOptions& options) : options_(options) {}
  virtual ~VelocityController() = default;
  VelocityController(const VelocityController&) = delete;
  VelocityController& operator=(const VelocityController&) = delete;

  // `seconds`: since the last one was taken. `pursuit`, above 0 to 1: the share of the pursuit distance that it steers with;
  // with less it follows the route more exactly, and slower.
  virtual Steering follow(const RoutePosition& position, const path::Pose& vehicle, double seconds,
                          double pursuit) const = 0;
  // Brings a vehicle that left the tolerances of `target` back to it; otherwise, and without hold_pose, a zero.
  virtual Steering holdPose(const path::Pose& target, const path::Pose& vehicle,
                            double seconds) const = 0;

  void take(const Steering& steering) {
    last_ = steering;
    other_frame_ = false;
  }
  // In the plane, m/s, beside the options; from the next call on.
  void limitSpeed(double most) { speed_limit_ = most; }
  void stop();
  // A new drive: nothing is held any longer.
  void release() { last_.returning = false; }
  // From the next call on poses are in another frame; the vehicle has the velocity that it had.
  void changeFrame() { other_frame_ = true; }

 protected:
  const FollowerOptions& options() const { return options_; }
  double speedLimit() const { return speed_limit_; }
  // What was taken last, in the frame of `vehicle`.
  Steering last(const path::Pose& vehicle) const;

 private:
  const FollowerOptions& options_;
  Steering last_;
  bool other_frame_ = false;  // than that of last_: the next call's
  double speed_limit_ = std::numeric_limits<double>::infinity();
};

// What both kinds share: a value that changes by at most so much, and the yaw rate that turns by `error` (rad).
double towards(double from, double to, double largest);
double yawRateFor(double error, const FollowerOptions& options);

// None: a vehicle that can go in every direction.
std::unique_ptr<VelocityController> makeController(const FollowerOptions& options,
                                                   const vehicle::Description* vehicle);

}  // namespace grid_path_planner::following
