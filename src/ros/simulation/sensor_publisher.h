// The navigation sensors of a simulated vehicle as topics.
//
//   SensorPublisher sensors(nh, sensor_options, world, faults);
//   sensors.advance(vehicle.state(), vehicle.timeNs());  // after each step
//   sensors.publish(frames, "map", stamp_of);            // after /clock of their time
//
//   imu/data      sensor_msgs/Imu, in imu_link (REP 145)
//   dvl/twist     geometry_msgs/TwistWithCovarianceStamped, in dvl_link; none without bottom lock
//   dvl/altitude  sensor_msgs/Range, in dvl_altitude_link, whose x axis looks down
//   pressure      sensor_msgs/FluidPressure (Pa), in pressure_link
//   depth         geometry_msgs/PoseWithCovarianceStamped in map: z of pressure_link
//   usbl/pose     geometry_msgs/PoseWithCovarianceStamped in map: position of usbl_link, stamped with the
//                 time at which it was there, which is earlier
//   scan          sensor_msgs/LaserScan, in laser_link
//
// Only sensors that are enabled have topics.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ros/simulation/sensor_messages.h"
#include "simulation/sensors/navigation_sensors.h"

namespace grid_path_planner::nodes {

class SensorPublisher {
 public:
  using StampOf = std::function<ros::Time(std::int64_t)>;

  // As NavigationSensors.
  SensorPublisher(ros::NodeHandle& nh, const simulation::NavigationSensorOptions& options,
                  std::shared_ptr<const simulation::World> world,
                  const std::vector<simulation::SensorFault>& faults);

  // Throws as NavigationSensors does. Advertises the topics of the sensors that are enabled, and those only.
  void setOptions(const simulation::NavigationSensorOptions& options);

  // What they read waits to be published.
  void advance(const simulation::VehicleState& state, std::int64_t time_ns);
  // The vehicle was put elsewhere, which is no motion.
  void jump() { sensors_.jump(); }
  // `stamp_of` is the ROS time of a simulated one in nanoseconds; what is stamped 0 is left out.
  void publish(const SensorFrameNames& frames, const std::string& map_frame,
               const StampOf& stamp_of);
  // While ROS time stands at `stamp`: what is read waits for its next time, the newest of it; before its first it has none.
  void dropOld(const ros::Time& stamp);

 private:
  void publish(const simulation::SensorReadings& readings, const SensorFrameNames& frames,
               const std::string& map_frame, const StampOf& stamp_of) const;

  ros::NodeHandle nh_;
  simulation::NavigationSensors sensors_;
  std::deque<simulation::SensorReadings> readings_;  // not yet published
  ros::Publisher imu_, twist_, altitude_, pressure_, depth_, fix_, scan_;
};

}  // namespace grid_path_planner::nodes
