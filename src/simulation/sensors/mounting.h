// Where a sensor is on the vehicle: its lever arm and turn.
#pragma once

#include <Eigen/Geometry>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::simulation {

// Of the sensor's frame in base_link (REP 103).
struct Mounting {
  double x = 0.0;  // m
  double y = 0.0;
  double z = 0.0;
  double roll = 0.0;  // rad
  double pitch = 0.0;
  double yaw = 0.0;

  // The sensor's frame in base_link, turned by yaw, then pitch, then roll.
  Eigen::Isometry3d pose() const {
    Eigen::Isometry3d pose(Eigen::Translation3d(x, y, z));
    pose.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    pose.rotate(Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()));
    return pose.rotate(Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()));
  }
};

template <class Visitor>
void visitOptions(Mounting& o, Visitor&& visit) {
  visit("x", o.x, base::OptionInfo{"Where the sensor is, ahead of base_link", "m", -100.0, 100.0});
  visit("y", o.y, base::OptionInfo{"Where the sensor is, left of base_link", "m", -100.0, 100.0});
  visit("z", o.z, base::OptionInfo{"Where the sensor is, above base_link", "m", -100.0, 100.0});
  visit("roll", o.roll, base::OptionInfo{"Turn of the sensor about its x axis", "rad", -6.3, 6.3});
  visit("pitch", o.pitch,
        base::OptionInfo{"Turn of the sensor about its y axis, before the roll", "rad", -6.3, 6.3});
  visit("yaw", o.yaw,
        base::OptionInfo{"Turn of the sensor about its z axis, before both", "rad", -6.3, 6.3});
}

}  // namespace grid_path_planner::simulation
