// Steers a vehicle that can go in every direction: along the path and towards it at once, turning as it should look.
#pragma once

#include "following/velocity_controller.h"

namespace grid_path_planner::following {

class OmnidirectionalController : public VelocityController {
 public:
  // `vehicle`, checked, must outlive this; null: only the options limit the speed.
  OmnidirectionalController(const FollowerOptions& options, const vehicle::Description* vehicle)
      : VelocityController(options), vehicle_(vehicle) {}

  Steering follow(const RoutePosition& position, const path::Pose& vehicle, double seconds,
                  double pursuit) const override;
  Steering holdPose(const path::Pose& target, const path::Pose& vehicle,
                    double seconds) const override;

 private:
  Eigen::Vector3d wantedVelocity(const RoutePosition& position, const Eigen::Vector3d& vehicle,
                                 double pursuit) const;
  Steering limited(const path::Pose& vehicle, const Eigen::Vector3d& velocity, double yaw_error,
                   double seconds) const;
  double shareWithin(const Eigen::Vector3d& velocity, double yaw) const;

  const vehicle::Description* const vehicle_;
};

}  // namespace grid_path_planner::following
