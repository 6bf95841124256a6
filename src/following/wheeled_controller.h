// Steers a vehicle that cannot go sideways along arcs towards a point ahead on the path (pure pursuit, R. C. Coulter, 1992).
// One with differential drive turns on the spot first where that point lies aside or behind, and at the end; a car turns by
// its arcs, and backs off where it may and the point lies behind.
//
// It arrives at a stop in a straight line to it, wherever beside the path it is. A car arrives with the heading that the path
// brings it there with, and holds no pose.
#pragma once

#include "following/velocity_controller.h"
#include "vehicle/description.h"

namespace grid_path_planner::following {

class WheeledController : public VelocityController {
 public:
  // Precondition: the description was checked, and is not of an omnidirectional drive.
  WheeledController(const FollowerOptions& options, const vehicle::Description& vehicle)
      : VelocityController(options), vehicle_(vehicle) {}

  Steering follow(const RoutePosition& position, const path::Pose& vehicle, double seconds,
                  double pursuit) const override;
  Steering holdPose(const path::Pose& target, const path::Pose& vehicle,
                    double seconds) const override;

 private:
  // A point to drive to, and how fast at most.
  struct Aim {
    Eigen::Vector2d point;
    double speed;
    bool stop;       // it is where the vehicle stops
    bool backwards;  // the path wants it to arrive so
  };

  bool isThere(const path::Pose& stop, const path::Pose& vehicle) const;
  bool car() const { return vehicle_.drive == vehicle::Drive::CAR; }
  Steering driveTo(const Aim& aim, const path::Pose& vehicle, double seconds) const;
  Steering turnBy(double error, Steering before, double seconds) const;
  bool goesBackwards(const Aim& aim, double error, double distance, const Steering& before) const;
  double speedOn(double curvature, const Aim& aim, double distance, bool backwards) const;
  bool pathLeadsBackwards(const RoutePosition& position, const path::Pose& vehicle) const;

  const vehicle::Description vehicle_;
};

}  // namespace grid_path_planner::following
