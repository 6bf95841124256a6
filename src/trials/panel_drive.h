// Where the vehicle is at any time of a trial: a drive along an arc before the panel.
//
//   const PanelDrive drive(study.drive, study.map_from_panel);
//   imu.measure(drive.stateAt(12.3), time_ns);
//
// Positions, yaw, roll and pitch are closed forms with continuous accelerations; velocities are their central
// differences over 0.2 ms, right to 1e-8 m/s.
#pragma once

#include "grid_path_planner/simulation/vehicle.h"
#include "trials/trial_study.h"

namespace grid_path_planner::trials {

class PanelDrive {
 public:
  PanelDrive(DriveOptions options, const Eigen::Isometry3d& map_from_panel);

  simulation::VehicleState stateAt(double t) const;
  bool looksAway(double t) const;

 private:
  struct Place {
    Eigen::Vector3d position;
    double yaw;
  };

  Place placeAt(double t) const;
  double turnedAway(double t) const;

  DriveOptions options_;
  Eigen::Isometry3d map_from_panel_;
  double panel_yaw_;
};

}  // namespace grid_path_planner::trials
