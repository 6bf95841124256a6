#include "ros/localization/sensor_messages.h"

#include <boost/array.hpp>
#include <cmath>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "localization/measurement_check.h"
#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

using base::InputError;
using localization::Measurement;
using localization::Mounting;
using localization::PoseCovariance;
using localization::Source;
using localization::Stamp;

namespace {

constexpr double kSurfacePressure = 101325.0;  // Pa
constexpr double kLeastPressure = 30000.0;     // Pa: of the air on the highest mountains

// The message's frame without a leading slash; a name of the network.
std::string nameOf(const std_msgs::Header& header) {
  checkNetworkText("its frame", header.frame_id);
  if (header.frame_id.empty()) throw InputError("it names no frame");
  return frameName(header.frame_id);
}

Stamp stampOf(const std_msgs::Header& header) {
  if (header.stamp.isZero()) throw InputError("it has no stamp");
  return nodes::stampOf(header.stamp);
}

Eigen::Vector3d vectorOf(const geometry_msgs::Vector3& v) {
  return {v.x, v.y, v.z};
}
Eigen::Vector3d vectorOf(const geometry_msgs::Point& v) {
  return {v.x, v.y, v.z};
}
Eigen::Quaterniond rotationOf(const geometry_msgs::Quaternion& q) {
  return {q.w, q.x, q.y, q.z};
}

PoseCovariance matrixOf(const boost::array<double, 36>& covariance) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(covariance.data());
}

// Nothing was filled in, or the first element says that there is nothing.
template <class Matrix>
bool isAbsent(const Matrix& covariance) {
  return covariance(0, 0) == -1.0 || covariance.isZero(0.0);
}

Eigen::Matrix3d covarianceOr(const Eigen::Matrix3d& covariance, double deviation) {
  if (deviation > 0.0 && isAbsent(covariance))
    return deviation * deviation * Eigen::Matrix3d::Identity();
  return covariance;
}

// A length that is nearly 1, as checkMeasurement wants it, becomes 1.
Eigen::Quaterniond unitOf(const Eigen::Quaterniond& q) {
  if (!(std::abs(q.norm() - 1.0) <= 0.01))
    throw InputError("the length of the orientation must be 1, got " + std::to_string(q.norm()));
  return q.normalized();
}

bool hasOrientation(const sensor_msgs::Imu& message) {
  return message.orientation_covariance[0] != -1.0 &&
         rotationOf(message.orientation).squaredNorm() > 0.0;
}

}  // namespace

Stamp stampOf(const ros::Time& time) {
  return static_cast<Stamp>(time.sec) * 1'000'000'000 + static_cast<Stamp>(time.nsec);
}

ros::Time timeOf(Stamp stamp) {
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(stamp));
  return time;
}

SensorMessages::SensorMessages(Lookup lookup, const VehicleLocalizerOptions& options)
    : lookup_(std::move(lookup)), options_(options) {}

Mounting SensorMessages::mountingOf(const std::string& frame) const {
  if (body_frame_.empty()) throw InputError("no IMU has said where it is yet");
  if (frame == body_frame_) return {};
  const Eigen::Isometry3d in_body = lookup_(body_frame_, frame);
  const Mounting mounting{in_body.translation(), Eigen::Quaterniond(in_body.linear())};
  localization::checkMounting(mounting);
  return mounting;
}

void SensorMessages::checkMapFrame(const std_msgs::Header& header) const {
  checkNetworkText("its frame", header.frame_id);
  const std::string frame = frameInMap(header.frame_id, options_.map_frame);
  if (frame != options_.map_frame)
    throw InputError("its frame must be " + options_.map_frame + ", got " + frame);
}

Measurement SensorMessages::imu(const sensor_msgs::Imu& message) const {
  const std::string frame = nameOf(message.header);
  if (!body_frame_.empty() && frame != body_frame_)
    throw InputError("its frame is " + frame + ", that of the IMU before " + body_frame_);
  if (message.angular_velocity_covariance[0] == -1.0 ||
      message.linear_acceleration_covariance[0] == -1.0)
    throw InputError("it has no angular velocity or no acceleration (a first variance of -1)");
  localization::ImuMeasurement imu;
  imu.inertial = {vectorOf(message.angular_velocity), vectorOf(message.linear_acceleration)};
  if (hasOrientation(message)) imu.attitude = unitOf(rotationOf(message.orientation));
  if (body_frame_.empty()) lookup_(frame, options_.base_frame);  // throws where tf does not know it
  return {stampOf(message.header), Source::IMU, imu};
}

void SensorMessages::keep(const sensor_msgs::Imu& message) {
  body_frame_ = nameOf(message.header);
}

std::optional<Measurement> SensorMessages::heading(const sensor_msgs::Imu& message) const {
  if (!options_.use_heading || !hasOrientation(message)) return {};
  const double yaw = localization::yawOf(unitOf(rotationOf(message.orientation)));
  const double variance = options_.heading_deviation * options_.heading_deviation;
  return Measurement{stampOf(message.header), Source::HEADING,
                     localization::HeadingFix{yaw, variance}};
}

Measurement SensorMessages::dvl(const geometry_msgs::TwistWithCovarianceStamped& message) const {
  const PoseCovariance covariance = matrixOf(message.twist.covariance);
  localization::DvlVelocity dvl{
      vectorOf(message.twist.twist.linear),
      covarianceOr(covariance.topLeftCorner<3, 3>(), options_.default_dvl_deviation),
      mountingOf(nameOf(message.header))};
  return {stampOf(message.header), Source::DVL, dvl};
}

Measurement SensorMessages::depth(const geometry_msgs::PoseWithCovarianceStamped& message) const {
  checkMapFrame(message.header);
  double variance = message.pose.covariance[14];
  const double deviation = options_.default_depth_deviation;
  if ((variance == 0.0 || message.pose.covariance[0] == -1.0) && deviation > 0.0)
    variance = deviation * deviation;
  return {stampOf(message.header), Source::DEPTH,
          localization::DepthFix{message.pose.pose.position.z, variance,
                                 mountingOf(options_.depth_frame).position}};
}

// uuv_simulator's are in kPa and those of mavros' HIGHRES_IMU in hPa, which would be 10 m above the water.
Measurement SensorMessages::pressure(const sensor_msgs::FluidPressure& message) const {
  if (message.fluid_pressure < kLeastPressure)
    throw InputError("a pressure must be in Pa, got " + std::to_string(message.fluid_pressure) +
                     ", which no air or water has: kPa or hPa?");
  const double weight = options_.water_density * options_.localizer.filter.gravity;
  const double z = options_.surface_z - (message.fluid_pressure - kSurfacePressure) / weight;
  const double variance = message.variance == 0.0
                              ? options_.pressure_deviation * options_.pressure_deviation
                              : message.variance;
  return {stampOf(message.header), Source::DEPTH,
          localization::DepthFix{z, variance / (weight * weight),
                                 mountingOf(nameOf(message.header)).position}};
}

Measurement SensorMessages::usbl(const geometry_msgs::PoseWithCovarianceStamped& message) const {
  checkMapFrame(message.header);
  const PoseCovariance covariance = matrixOf(message.pose.covariance);
  return {stampOf(message.header), Source::USBL,
          localization::PositionFix{
              vectorOf(message.pose.pose.position),
              covarianceOr(covariance.topLeftCorner<3, 3>(), options_.default_usbl_deviation),
              mountingOf(options_.usbl_frame).position}};
}

Measurement SensorMessages::marker(const geometry_msgs::PoseWithCovarianceStamped& message) const {
  checkMapFrame(message.header);
  const Eigen::Quaterniond attitude = unitOf(rotationOf(message.pose.pose.orientation));
  PoseCovariance covariance = matrixOf(message.pose.covariance);
  if (isAbsent(covariance) && options_.default_marker_deviation > 0.0) {
    const double angle = options_.default_marker_angle * M_PI / 180.0;
    covariance.setZero();
    covariance.diagonal().head<3>().setConstant(options_.default_marker_deviation *
                                                options_.default_marker_deviation);
    covariance.diagonal().tail<3>().setConstant(angle * angle);
  }
  return {stampOf(message.header), Source::MARKER,
          localization::PoseFix{vectorOf(message.pose.pose.position), attitude,
                                localization::ownCovariance(covariance, attitude), base()}};
}

Measurement SensorMessages::setPose(const geometry_msgs::PoseWithCovarianceStamped& message,
                                    const ros::Time& now) const {
  checkMapFrame(message.header);
  const Eigen::Quaterniond attitude = unitOf(rotationOf(message.pose.pose.orientation));
  PoseCovariance covariance = matrixOf(message.pose.covariance);
  const double angle = options_.set_pose_angle * M_PI / 180.0;
  for (int i = 0; i < 6; ++i) {
    const double deviation = i < 3 ? options_.set_pose_deviation : angle;
    if (covariance(i, i) == 0.0) covariance(i, i) = deviation * deviation;
  }
  const ros::Time stamp = message.header.stamp.isZero() ? now : message.header.stamp;
  return {nodes::stampOf(stamp), Source::SET_POSE,
          localization::PoseFix{vectorOf(message.pose.pose.position), attitude,
                                localization::ownCovariance(covariance, attitude), base()}};
}

Measurement SensorMessages::command(const geometry_msgs::Twist& message,
                                    const ros::Time& now) const {
  return {nodes::stampOf(now), Source::COMMAND,
          localization::CommandedVelocity{vectorOf(message.linear), base()}};
}

}  // namespace grid_path_planner::nodes
