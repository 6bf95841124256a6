// The node `vehicle_localizer`: where the vehicle is, by its navigation sensors.
//
//   subscribes  imu/data     sensor_msgs/Imu; its frame is that of the filter
//               dvl/twist    geometry_msgs/TwistWithCovarianceStamped in the frame of the DVL
//               depth        geometry_msgs/PoseWithCovarianceStamped in map_frame, of which z counts
//               pressure     sensor_msgs/FluidPressure, instead of depth with ~use_pressure
//               usbl/pose    geometry_msgs/PoseWithCovarianceStamped in map_frame: a position
//               marker_pose  geometry_msgs/PoseWithCovarianceStamped of base_frame in map_frame
//               cmd_vel      geometry_msgs/Twist in base_frame; used while the DVL is lost
//               initialpose  geometry_msgs/PoseWithCovarianceStamped of base_frame in map_frame
//               tf           where the sensors are on the vehicle
//   publishes   odometry/filtered, odometry/local, tf      pose_publisher.h
//               localization_status   std_msgs/String, latched: "OK: the pose is known to ..."
//               fix_markers           fix_markers.h
//               /diagnostics
//   services    ~set_pose    grid_path_planner/SetPose
//               ~reset       std_srvs/Trigger: everything begins anew
//
// One that was killed and starts again under the same roscore begins with what it knew of the IMU's heading (kept_heading.h), kept
// below --save-folder (node_files.h).
//
// Guaranteed: map -> odom is published while the status is OK or DEGRADED only. A message that cannot be
// used changes nothing; its reason is in the log and in the diagnostics. ROS time that goes back begins
// everything anew, but what is known of the IMU's heading where somebody set the wall clock. From the first transform map -> odom or odom -> base_link of another node on, none
// is published, until ~reset. Where another node is to publish odom -> base_link (publish_odom_to_base) and does not,
// there is no map -> odom, and the status is DEGRADED. Poses are stamped as the measurements of the IMU, or as now while it is
// silent.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <std_msgs/String.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/SetPose.h"
#include "localization/vehicle_localizer.h"
#include "ros/guard/node_files.h"
#include "ros/guard/node_time.h"
#include "ros/input/input.h"
#include "ros/localization/fix_markers.h"
#include "ros/localization/kept_heading.h"
#include "ros/localization/pose_publisher.h"
#include "ros/localization/sensor_messages.h"
#include "ros/localization/transform_rivals.h"
#include "ros/localization/vehicle_localizer_options.h"

namespace grid_path_planner {
class VehicleLocalizerConfig;
}  // namespace grid_path_planner

namespace grid_path_planner::None {}  // namespace grid_path_planner::None

namespace grid_path_planner::nodes {

template <class Config, class Options>
class Reconfigurable;

class VehicleLocalizerNode {
 public:
  // Throws InputError for parameters that cannot be used. All callbacks are served by the queue of
  // `nh`, which must be one thread's.
  VehicleLocalizerNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                       const NodeFiles& files = {});
  ~VehicleLocalizerNode();

 private:
  Eigen::Isometry3d placeOnVehicle(const std::string& target, const std::string& source) const;
  template <class Message, class Use>
  Input<Message>& listen(localization::Source source, ros::NodeHandle& nh, const Use& use);
  void subscribe(ros::NodeHandle& nh);
  void offerServices(ros::NodeHandle& nh, ros::NodeHandle& private_nh);
  void startDiagnostics(ros::NodeHandle& nh);
  void use(VehicleLocalizerOptions options);
  void timeWentBack(double seconds);
  void beginAnew(const std::optional<localization::KnownHeading>& heading = {});
  void take(const localization::Measurement& measurement);
  void onImu(const sensor_msgs::Imu& message);
  void onCommand(const geometry_msgs::Twist& message);
  void onTimer();
  void publish(const ros::Time& stamp);
  std::string publishPoses(const ros::Time& stamp);
  void keepHeading(localization::Stamp time);
  void announce(const localization::LocalizationReport& report, bool is_withheld);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseInput(localization::Source source,
                     diagnostic_updater::DiagnosticStatusWrapper& status);

  VehicleLocalizerOptions options_;
  TransformRivals rivals_;
  FrameTransforms transforms_;  // tells the rivals
  localization::VehicleLocalizer localizer_;
  KeptHeading kept_;
  SensorMessages messages_;
  PosePublisher publisher_;
  FixMarkers fixes_;
  ros::Publisher status_publisher_;
  localization::LocalizationReport report_;
  struct Told {
    std::string what;  // status, rival and whether something is withheld
    std_msgs::String message;
  };
  Told told_;  // last

  // What calls is destroyed before what it calls.
  std::map<localization::Source, std::unique_ptr<InputBase>> inputs_;
  std::vector<ros::ServiceServer> services_;
  diagnostic_updater::Updater diagnostics_;
  ros::SteadyTimer publish_timer_, diagnostics_timer_;
  std::unique_ptr<Reconfigurable<VehicleLocalizerConfig, VehicleLocalizerOptions>> reconfigurable_;
  std::shared_ptr<void> on_jump_back_;
};

}  // namespace grid_path_planner::nodes
