#include "avoidance/log/log_bytes.h"

#include <algorithm>

namespace grid_path_planner::avoidance {

using base::BodyVelocity;
using base::InputError;
using Eigen::Vector3d;

void LogWriter::text(const std::string& text) {
  number<std::uint64_t>(text.size());
  bytes_.insert(bytes_.end(), text.begin(), text.end());
}

void LogWriter::points(const std::vector<Vector3d>& points) {
  number<std::uint64_t>(points.size());
  for (const Vector3d& point : points)
    for (int axis = 0; axis < 3; ++axis) number(point[axis]);
}

void LogWriter::velocity(const BodyVelocity& velocity) {
  number(velocity.surge);
  number(velocity.sway);
  number(velocity.heave);
  number(velocity.yaw_rate);
}

void LogWriter::frame(const Frame& frame) {
  number(frame.time);
  const Eigen::Matrix4d pose = frame.map_from_sensor.matrix();
  for (int i = 0; i < 16; ++i) number(pose.data()[i]);
  number<std::int32_t>(frame.width);
  number<std::int32_t>(frame.height);
  const Pinhole pinhole = frame.pinhole.value_or(Pinhole{});
  number<std::uint8_t>(frame.pinhole.has_value());
  for (const double value : {pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy}) number(value);
  number<std::uint64_t>(frame.points.size());
  const auto* from = reinterpret_cast<const char*>(frame.points.data());
  bytes_.insert(bytes_.end(), from, from + frame.points.size() * sizeof(float));
}

void LogWriter::input(const PilotInput& input) {
  number(input.time);
  number<std::uint8_t>(input.pose.has_value());
  const VehiclePose pose = input.pose.value_or(VehiclePose{});
  points({pose.position});
  number(pose.yaw);
  velocity(input.velocity);
  text(input.pose_problem);
  text(input.hold);
  text(input.cloud_problem);
  number<std::uint8_t>(input.frame != nullptr);
  if (input.frame != nullptr) frame(*input.frame);
}

void LogWriter::answer(const PilotAnswer& answer) {
  velocity(answer.velocity);
  number(static_cast<std::int32_t>(answer.status));
  text(answer.sentence);
  for (const double value : {answer.clearance, answer.clear_path, answer.frame_age}) number(value);
  number<std::int32_t>(answer.waypoint);
  number<std::uint8_t>(answer.new_path);
}

void LogReader::require(std::uint64_t size) const {
  if (size > bytes_.size() - at_) throw InputError("a record ends too early");
}

std::string LogReader::text() {
  const auto size = number<std::uint64_t>();
  require(size);
  const std::string text(bytes_.begin() + static_cast<long>(at_),
                         bytes_.begin() + static_cast<long>(at_ + size));
  at_ += size;
  return text;
}

std::vector<Vector3d> LogReader::points() {
  const auto count = number<std::uint64_t>();
  require(std::min<std::uint64_t>(count, bytes_.size()) * 3 * sizeof(double));
  std::vector<Vector3d> points(count);
  for (Vector3d& point : points)
    for (int axis = 0; axis < 3; ++axis) point[axis] = number<double>();
  return points;
}

BodyVelocity LogReader::velocity() {
  BodyVelocity velocity;
  velocity.surge = number<double>();
  velocity.sway = number<double>();
  velocity.heave = number<double>();
  velocity.yaw_rate = number<double>();
  return velocity;
}

Frame LogReader::frame() {
  Frame frame;
  frame.time = number<double>();
  for (int i = 0; i < 16; ++i) frame.map_from_sensor.matrix().data()[i] = number<double>();
  frame.width = number<std::int32_t>();
  frame.height = number<std::int32_t>();
  const bool has_pinhole = number<std::uint8_t>() != 0;
  Pinhole pinhole;
  for (double* value : {&pinhole.fx, &pinhole.fy, &pinhole.cx, &pinhole.cy})
    *value = number<double>();
  if (has_pinhole) frame.pinhole = pinhole;
  const auto count = number<std::uint64_t>();
  require(std::min<std::uint64_t>(count, bytes_.size()) * sizeof(float));
  frame.points.resize(count);
  if (count > 0) std::memcpy(frame.points.data(), &bytes_[at_], count * sizeof(float));
  at_ += count * sizeof(float);
  return frame;
}

PilotInput LogReader::input(Frame& frame_of_input) {
  PilotInput input;
  input.time = number<double>();
  const bool has_pose = number<std::uint8_t>() != 0;
  const std::vector<Vector3d> position = points();
  if (position.size() != 1) throw InputError("a record has no position");
  const auto yaw = number<double>();
  if (has_pose) input.pose = VehiclePose{position.front(), yaw};
  input.velocity = velocity();
  input.pose_problem = text();
  input.hold = text();
  input.cloud_problem = text();
  if (number<std::uint8_t>() == 0) return input;
  frame_of_input = frame();
  input.frame = &frame_of_input;
  return input;
}

}  // namespace grid_path_planner::avoidance
