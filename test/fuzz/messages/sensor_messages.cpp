// What vehicle_localizer hears, one message after the other, as far as its filters.
#include "ros/localization/sensor_messages.h"

#include <cmath>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/SetPose.h"
#include "localization/measurement_check.h"
#include "localization/vehicle_localizer.h"
#include "ros/input/frame_lookup.h"

namespace grid_path_planner::fuzz {
namespace {

using geometry_msgs::PoseWithCovarianceStamped;
using localization::Measurement;
using nodes::SensorMessages;

constexpr int kMostSensorMessages = 16;
constexpr std::uint32_t kBegin = 1000;         // s
constexpr std::uint32_t kPeriod = 10'000'000;  // ns, between two messages
enum SensorKind { IMU, DVL, DEPTH, PRESSURE, USBL, MARKER, SET_POSE, COMMAND, kKinds };

ros::Time timeOfMessage(int number) {
  return {kBegin, kPeriod * static_cast<std::uint32_t>(number)};
}

// A bag of all kinds, as the sensors of a vehicle that stands send them.
class SensorScript {
 public:
  std::string imu() {
    sensor_msgs::Imu imu;
    imu.header = header("imu");
    imu.orientation.w = 1.0;
    imu.linear_acceleration.z = 9.81;
    return add(IMU, bytesOf(imu));
  }
  std::string dvl() {
    geometry_msgs::TwistWithCovarianceStamped dvl;
    dvl.header = header("dvl");
    for (std::size_t i = 0; i < 36; i += 7) dvl.twist.covariance[i] = 0.01;
    return add(DVL, bytesOf(dvl));
  }
  std::string pose(SensorKind kind) {
    PoseWithCovarianceStamped pose;
    pose.header = header("map");
    pose.pose.pose.position.z = -2.0;
    pose.pose.pose.orientation.w = 1.0;
    for (std::size_t i = 0; i < 36; i += 7) pose.pose.covariance[i] = 0.01;
    return add(kind, bytesOf(pose));
  }
  std::string pressure() {
    sensor_msgs::FluidPressure pressure;
    pressure.header = header("imu");
    pressure.fluid_pressure = 121000.0;
    return add(PRESSURE, bytesOf(pressure));
  }
  std::string command() { return add(COMMAND, bytesOf(geometry_msgs::Twist())); }

 private:
  std_msgs::Header header(const std::string& frame) const {
    std_msgs::Header header;
    header.stamp = timeOfMessage(number_);
    header.frame_id = frame;
    return header;
  }
  std::string add(SensorKind kind, const std::string& message) {
    ++number_;
    return static_cast<char>(kind) + message;
  }

  int number_ = 0;
};

std::vector<std::string> seedsOfSensors() {
  const std::string place = bytesOf([] {
    geometry_msgs::Transform transform;
    transform.translation.x = 0.3;
    transform.rotation.w = 1.0;
    return transform;
  }());
  std::vector<std::string> seeds(3, std::string(1, '\0') + place);
  SensorScript fixes, speeds, depths;
  seeds[0] += fixes.imu() + fixes.pose(SET_POSE) + fixes.imu() + fixes.pose(USBL);
  seeds[0] += fixes.pose(MARKER) + fixes.imu();
  seeds[1] += speeds.imu() + speeds.pose(SET_POSE) + speeds.imu() + speeds.dvl();
  seeds[1] += speeds.imu() + speeds.command() + speeds.imu() + speeds.dvl();
  seeds[2] += depths.imu() + depths.pose(MARKER) + depths.imu() + depths.pose(DEPTH);
  seeds[2] += depths.imu() + depths.pressure();
  seeds.push_back('\x03' + seeds[0].substr(1));
  return seeds;
}

// What messages without variances are given, and headings.
nodes::VehicleLocalizerOptions optionsOf(std::uint8_t choices) {
  nodes::VehicleLocalizerOptions options;
  options.use_heading = (choices & 1) != 0;
  if ((choices & 2) == 0) return options;
  options.default_dvl_deviation = options.default_depth_deviation = 0.1;
  options.default_usbl_deviation = options.default_marker_deviation = 0.1;
  options.default_marker_angle = 1.0;
  return options;
}

class HearingVehicle {
 public:
  HearingVehicle(const nodes::VehicleLocalizerOptions& options,
                 const geometry_msgs::Transform& place)
      : history_(options.localizer.filter.history),
        messages_(
            [place](const std::string&, const std::string& source) {
              if (source == "nowhere") throw nodes::TransformError("tf does not know it");
              return nodes::isometryOf(place);
            },
            options),
        localizer_(options.localizer) {}

  // As VehicleLocalizerNode does it.
  template <class Message, class Convert>
  void hear(const std::optional<Message>& message, const Convert& convert) {
    if (message) take([&] { return convert(*message); });
  }
  void hearImu(const std::optional<sensor_msgs::Imu>& imu) {
    if (!imu || !take([&] { return messages_.imu(*imu); })) return;
    messages_.keep(*imu);
    if (const auto heading = messages_.heading(*imu)) take([&] { return *heading; });
  }
  void passTime() { now_ = timeOfMessage(++number_); }

  const SensorMessages& messages() const { return messages_; }
  const ros::Time& now() const { return now_; }

  void check() const {
    const auto report = localizer_.report(nodes::stampOf(now_));
    mustHold(!std::isnan(report.deviation) && !std::isnan(report.angle_deviation),
             "what is not known is told as a number");
    for (const auto& at :
         {localizer_.mapAt(nodes::stampOf(now_)), localizer_.odometryAt(nodes::stampOf(now_))})
      mustHold(!at || (at->estimate.state.position.allFinite() &&
                       at->estimate.state.attitude.coeffs().allFinite()),
               "the vehicle is somewhere");
  }

 private:
  template <class Convert>
  bool take(const Convert& convert) {
    try {
      const Measurement measurement = convert();
      localization::checkStamp(measurement.stamp, nodes::stampOf(now_), history_);
      localizer_.add(measurement);
      return true;
    } catch (const std::runtime_error&) {  // as the node
      return false;
    }
  }

  const double history_;
  SensorMessages messages_;
  localization::VehicleLocalizer localizer_;
  int number_ = 0;
  ros::Time now_ = timeOfMessage(0);
};

void hearNextSensor(Messages& input, HearingVehicle& vehicle) {
  const SensorMessages& messages = vehicle.messages();
  const auto fix = [&](auto convert) {
    vehicle.hear(input.next<PoseWithCovarianceStamped>(),
                 [&](const PoseWithCovarianceStamped& m) { return (messages.*convert)(m); });
  };
  switch (input.byte() % kKinds) {
    case IMU:
      return vehicle.hearImu(input.next<sensor_msgs::Imu>());
    case DVL:
      return vehicle.hear(input.next<geometry_msgs::TwistWithCovarianceStamped>(),
                          [&](const auto& m) { return messages.dvl(m); });
    case DEPTH:
      return fix(&SensorMessages::depth);
    case PRESSURE:
      return vehicle.hear(input.next<sensor_msgs::FluidPressure>(),
                          [&](const auto& m) { return messages.pressure(m); });
    case USBL:
      return fix(&SensorMessages::usbl);
    case MARKER:
      return fix(&SensorMessages::marker);
    case SET_POSE:  // of the service, which is that of the topic initialpose, too
      return vehicle.hear(input.next<SetPose::Request>(), [&](const SetPose::Request& request) {
        return messages.setPose(request.pose, vehicle.now());
      });
    case COMMAND:
      return vehicle.hear(input.next<geometry_msgs::Twist>(), [&](const geometry_msgs::Twist& m) {
        return messages.command(m, vehicle.now());
      });
  }
}

FUZZ_TARGET(sensor_messages, seedsOfSensors) {
  Messages messages(input);
  const auto options = optionsOf(messages.byte());
  const auto place = messages.next<geometry_msgs::Transform>();
  if (!place) return;
  HearingVehicle vehicle(options, *place);
  for (int i = 0; i < kMostSensorMessages && !messages.atEnd(); ++i) {
    hearNextSensor(messages, vehicle);
    vehicle.passTime();
  }
  vehicle.check();
}

}  // namespace
}  // namespace grid_path_planner::fuzz
