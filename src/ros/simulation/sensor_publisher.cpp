#include "ros/simulation/sensor_publisher.h"

#include <utility>

#include "ros/guard/outgoing/topic_changes.h"

namespace grid_path_planner::nodes {

using simulation::NavigationSensorOptions;
using simulation::SensorReadings;

namespace {

constexpr std::uint32_t kQueue = 1000;  // messages: many steps at once in time-lapse

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

void SensorPublisher::setOptions(const NavigationSensorOptions& options) {
  options_ = options;
  using geometry_msgs::PoseWithCovarianceStamped;
  using geometry_msgs::TwistWithCovarianceStamped;
  advertise<sensor_msgs::Imu>(nh_, "imu/data", options.imu.enabled, imu_);
  advertise<TwistWithCovarianceStamped>(nh_, "dvl/twist", options.dvl.enabled, twist_);
  advertise<sensor_msgs::Range>(nh_, "dvl/altitude", options.dvl.enabled, altitude_);
  advertise<sensor_msgs::FluidPressure>(nh_, "pressure", options.pressure.enabled, pressure_);
  advertise<PoseWithCovarianceStamped>(nh_, "depth", options.pressure.enabled, depth_);
  advertise<PoseWithCovarianceStamped>(nh_, "usbl/pose", options.usbl.enabled, fix_);
}

void SensorPublisher::publish(const SensorReadings& readings, const SensorFrameNames& frames,
                              const std::string& map_frame,
                              const std::function<ros::Time(std::int64_t)>& stamp_of) const {
  if (readings.imu)
    send(imu_, imuMessage(*readings.imu), frames.imu, stamp_of(readings.imu->time_ns));
  if (readings.dvl) {
    const ros::Time stamp = stamp_of(readings.dvl->time_ns);
    send(altitude_, altitudeMessage(*readings.dvl, options_.dvl), frames.dvl_altitude, stamp);
    if (readings.dvl->velocity)
      send(twist_, twistMessage(*readings.dvl->velocity), frames.dvl, stamp);
  }
  if (readings.pressure) {
    const ros::Time stamp = stamp_of(readings.pressure->time_ns);
    send(pressure_, pressureMessage(*readings.pressure), frames.pressure, stamp);
    send(depth_, depthMessage(*readings.pressure, options_.pressure), map_frame, stamp);
  }
  for (const simulation::UsblFix& fix : readings.usbl)
    send(fix_, fixMessage(fix), map_frame, stamp_of(fix.time_ns));
}

}  // namespace grid_path_planner::nodes
