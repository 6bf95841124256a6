// What simulated navigation sensors measured, as messages without stamps.
//
// Covariances are those that the noise was drawn with. A number that a sensor does not measure, but its
// message has, is 0 with the variance kNotMeasured.
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>

#include <string>
#include <vector>

#include "ros/simulation/sensor_frames.h"
#include "simulation/sensors/navigation_sensors.h"

namespace grid_path_planner::nodes {

constexpr double kNotMeasured = 1e6;  // m^2, rad^2, (rad/s)^2

// `base` -> the frames of those sensors that are enabled, without stamps. That of the DVL's altitude has
// its x axis down, along which a sensor_msgs/Range is measured.
std::vector<geometry_msgs::TransformStamped> sensorTransforms(
    const simulation::NavigationSensorOptions& options, const std::string& base,
    const SensorFrameNames& frames);

// Axes and orientation of the unit (REP 145).
sensor_msgs::Imu imuMessage(const simulation::ImuReading& reading);

// Of the sensor's own place in its own axes.
geometry_msgs::TwistWithCovarianceStamped twistMessage(const simulation::DvlVelocity& velocity);

// +-infinity without bottom lock (REP 117).
sensor_msgs::Range altitudeMessage(const simulation::DvlReading& reading,
                                   const simulation::DvlOptions& options);

sensor_msgs::FluidPressure pressureMessage(const simulation::PressureReading& reading);

// z of the pressure sensor in the map.
geometry_msgs::PoseWithCovarianceStamped depthMessage(const simulation::PressureReading& reading,
                                                      const simulation::PressureOptions& options);

// Without a time between its rays, which are of one instant.
sensor_msgs::LaserScan scanMessage(const simulation::LaserReading& reading,
                                   const simulation::LaserOptions& options);

// The transponder's position in the map.
geometry_msgs::PoseWithCovarianceStamped fixMessage(const simulation::UsblFix& fix);

}  // namespace grid_path_planner::nodes
