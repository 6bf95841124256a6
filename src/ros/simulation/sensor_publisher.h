// The navigation sensors of a simulated vehicle as topics.
//
//   SensorPublisher publisher(nh);
//   publisher.setOptions(sensor_options);
//   publisher.publish(readings, frames, "map", stamp_of);     // after /clock of their time
//
//   imu/data      sensor_msgs/Imu, in imu_link (REP 145)
//   dvl/twist     geometry_msgs/TwistWithCovarianceStamped, in dvl_link; none without bottom lock
//   dvl/altitude  sensor_msgs/Range, in dvl_altitude_link, whose x axis looks down
//   pressure      sensor_msgs/FluidPressure (Pa), in pressure_link
//   depth         geometry_msgs/PoseWithCovarianceStamped in map: z of pressure_link
//   usbl/pose     geometry_msgs/PoseWithCovarianceStamped in map: position of usbl_link, stamped with the
//                 time at which it was there, which is earlier
//
// Only sensors that are enabled have topics.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>

#include <cstdint>
#include <functional>
#include <string>

#include "ros/simulation/sensor_messages.h"

namespace grid_path_planner::nodes {

class SensorPublisher {
 public:
  explicit SensorPublisher(ros::NodeHandle& nh) : nh_(nh) {}

  // Advertises the topics of the sensors that are enabled, and those only.
  void setOptions(const simulation::NavigationSensorOptions& options);

  // `stamp_of` is the ROS time of a simulated one in nanoseconds; what is stamped 0 is left out.
  void publish(const simulation::SensorReadings& readings, const SensorFrameNames& frames,
               const std::string& map_frame,
               const std::function<ros::Time(std::int64_t)>& stamp_of) const;

 private:
  ros::NodeHandle nh_;
  simulation::NavigationSensorOptions options_;
  ros::Publisher imu_;
  ros::Publisher twist_;
  ros::Publisher altitude_;
  ros::Publisher pressure_;
  ros::Publisher depth_;
  ros::Publisher fix_;
};

}  // namespace grid_path_planner::nodes
