#include "ros/simulation/sensor_publisher.h"

#include <utility>

#include "ros/guard/outgoing/topic_changes.h"

namespace grid_path_planner::nodes {

using simulation::NavigationSensorOptions;
using simulation::SensorReadings;

namespace {

constexpr std::uint32_t kQueue = 1000;  // messages: many steps at once in time-lapse

// Steps with readings that wait while ROS time stands: 10 s of them at the default time step.
constexpr std::size_t kMostReadings = 1000;

template <class Message>
void advertise(ros::NodeHandle& nh, const char* topic, bool enabled, ros::Publisher& publisher) {
  if (enabled == static_cast<bool>(publisher)) return;
  const auto alone = lockTopicsOfRunningNode();
  publisher = enabled ? nh.advertise<Message>(topic, kQueue) : ros::Publisher();
}

template <class Message>
void send(const ros::Publisher& publisher, Message message, const std::string& frame,
          const ros::Time& stamp) {
  if (stamp.isZero()) return;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  publisher.publish(message);
}

}  // namespace

SensorPublisher::SensorPublisher(ros::NodeHandle& nh, const NavigationSensorOptions& options,
                                 std::shared_ptr<const simulation::World> world,
                                 const std::vector<simulation::SensorFault>& faults)
    : nh_(nh), sensors_(options, std::move(world), faults) {
  setOptions(options);
}

void SensorPublisher::setOptions(const NavigationSensorOptions& options) {
  sensors_.setOptions(options);
  using geometry_msgs::PoseWithCovarianceStamped;
  using geometry_msgs::TwistWithCovarianceStamped;
  advertise<sensor_msgs::Imu>(nh_, "imu/data", options.imu.enabled, imu_);
  advertise<TwistWithCovarianceStamped>(nh_, "dvl/twist", options.dvl.enabled, twist_);
  advertise<sensor_msgs::Range>(nh_, "dvl/altitude", options.dvl.enabled, altitude_);
  advertise<sensor_msgs::FluidPressure>(nh_, "pressure", options.pressure.enabled, pressure_);
  advertise<PoseWithCovarianceStamped>(nh_, "depth", options.pressure.enabled, depth_);
  advertise<PoseWithCovarianceStamped>(nh_, "usbl/pose", options.usbl.enabled, fix_);
  advertise<sensor_msgs::LaserScan>(nh_, "scan", options.laser.enabled, scan_);
}

void SensorPublisher::advance(const simulation::VehicleState& state, std::int64_t time_ns) {
  SensorReadings readings = sensors_.advance(state, time_ns);
  if (!readings.empty()) readings_.push_back(std::move(readings));
}

void SensorPublisher::publish(const SensorFrameNames& frames, const std::string& map_frame,
                              const StampOf& stamp_of) {
  for (const SensorReadings& readings : readings_) publish(readings, frames, map_frame, stamp_of);
  readings_.clear();
}

void SensorPublisher::dropOld(const ros::Time& stamp) {
  if (stamp.isZero()) readings_.clear();
  while (readings_.size() > kMostReadings) readings_.pop_front();
}

void SensorPublisher::publish(const SensorReadings& readings, const SensorFrameNames& frames,
                              const std::string& map_frame, const StampOf& stamp_of) const {
  if (readings.imu)
    send(imu_, imuMessage(*readings.imu), frames.imu, stamp_of(readings.imu->time_ns));
  if (readings.dvl) {
    const ros::Time stamp = stamp_of(readings.dvl->time_ns);
    send(altitude_, altitudeMessage(*readings.dvl, sensors_.options().dvl), frames.dvl_altitude,
         stamp);
    if (readings.dvl->velocity)
      send(twist_, twistMessage(*readings.dvl->velocity), frames.dvl, stamp);
  }
  if (readings.pressure) {
    const ros::Time stamp = stamp_of(readings.pressure->time_ns);
    send(pressure_, pressureMessage(*readings.pressure), frames.pressure, stamp);
    send(depth_, depthMessage(*readings.pressure, sensors_.options().pressure), map_frame, stamp);
  }
  for (const simulation::UsblFix& fix : readings.usbl)
    send(fix_, fixMessage(fix), map_frame, stamp_of(fix.time_ns));
  if (readings.laser)
    send(scan_, scanMessage(*readings.laser, sensors_.options().laser), frames.laser,
         stamp_of(readings.laser->time_ns));
}

}  // namespace grid_path_planner::nodes
