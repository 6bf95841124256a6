// The node `simulator`: a simulated vehicle that follows cmd_vel in a simulated world, for use of the
// other nodes without a real one.
//
//   subscribes  cmd_vel        geometry_msgs/Twist in base_link; zeroed cmd_vel_timeout after the
//                              last
//               projected_map  nav_msgs/OccupancyGrid; without ~world its occupied cells stop the
//                              vehicle
//   publishes   ground_truth   nav_msgs/Odometry in map: the true pose
//               odom           nav_msgs/Odometry: the pose by dead reckoning
//               tf             map -> odom (the identity) -> base_link -> camera_link
//                              -> camera_optical_frame, and base_link -> the sensors' frames
//               /clock         at real_time_factor; only with publish_clock
//               contacts, contact     collisions of the vehicle (contact_publisher.h)
//               depth_camera/points, depth_camera/camera_info     with ~world
//                              (depth_camera_publisher.h)
//               imu/data, dvl/..., pressure, depth, usbl/pose     with navigation sensors
//                              (sensor_publisher.h)
//               camera/image_raw, camera/camera_info     with an image camera (image_camera_publisher.h)
//
// With a real_time_factor above 1, simulated time waits up to 0.2 s of the wall clock for the next
// command where the last one would end: the vehicle does not drive on, nor stop, because it runs
// faster than its commands come.
//
// Guaranteed: the steps follow the wall clock, never /clock. Where the machine is too slow for the
// steps or for the depth images, simulated time goes slower; no step is left out, and no depth image
// that has a subscriber. Nothing waits for the image camera.
#pragma once

#include <geometry_msgs/Twist.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <ros/subscriber.h>

#include <memory>
#include <vector>

#include "grid_path_planner/simulation/dead_reckoning.h"
#include "grid_path_planner/simulation/vehicle.h"
#include "ros/guard/node_files.h"
#include "ros/input/foreign_rules.h"
#include "ros/simulation/contact_publisher.h"
#include "ros/simulation/depth_camera_publisher.h"
#include "ros/simulation/image_camera_publisher.h"
#include "ros/simulation/sensor_publisher.h"
#include "ros/simulation/simulator_clock.h"
#include "ros/simulation/simulator_options.h"
#include "ros/simulation/vehicle_publisher.h"

namespace grid_path_planner {
class SimulatorConfig;
}  // namespace grid_path_planner

namespace grid_path_planner::None {}  // namespace grid_path_planner::None

namespace grid_path_planner::nodes {

template <class Config, class Options>
class Reconfigurable;

class SimulatorNode {
 public:
  // A world that no argument names lies below the folder to load from. Throws InputError for
  // parameters and a world that cannot be used. All callbacks are served by
  // the queue of `nh`, which must be one thread's.
  SimulatorNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const NodeFiles& files = {});
  ~SimulatorNode();

 private:
  void listen(ros::NodeHandle& private_nh);
  void use(const SimulatorOptions& options);
  void updateCamera(const SimulatorOptions& options);
  void updateImageCamera(const simulation::ImageCameraOptions& options);
  void resetVehicle(const SimulatorOptions& options);
  void startTimer();

  void onCommand(const geometry_msgs::Twist& message);
  void onMap(const MapEvent& event);
  void onTimer();
  void step();
  bool mustWaitForCamera() const;
  bool mustWaitForCommand() const;
  // Tf of exactly the stamp that is returned, and what else is of it.
  ros::Time publishState();

  ros::NodeHandle nh_;
  SimulatorOptions options_;
  std::unique_ptr<simulation::Vehicle> vehicle_;
  simulation::DeadReckoning odometry_;
  ros::SteadyTime commanded_at_;
  bool has_map_ = false;

  // Advertised before the world is read, which takes a while: who listens has time to connect before the first tick.
  SimulatorClock clock_;
  VehiclePublisher vehicle_publisher_;
  ContactPublisher contact_publisher_;
  std::shared_ptr<const simulation::World> world_;      // none: only the map's obstacles
  std::vector<simulation::SensorFault> faults_;         // of sensors and image camera
  std::unique_ptr<DepthCameraPublisher> camera_;        // with a world
  std::unique_ptr<ImageCameraPublisher> image_camera_;  // where enabled
  SensorPublisher sensor_publisher_;
  ros::Subscriber command_subscriber_, map_subscriber_;
  ros::SteadyTimer timer_;  // destroyed before what it calls
  std::unique_ptr<Reconfigurable<SimulatorConfig, SimulatorOptions>> reconfigurable_;
};

}  // namespace grid_path_planner::nodes
