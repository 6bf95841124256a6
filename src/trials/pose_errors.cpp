#include "trials/pose_errors.h"

#include <cmath>
#include <cstdio>

#include "localization/so3.h"

namespace grid_path_planner::trials {

using Eigen::Quaterniond, Eigen::Vector3d;

namespace {

constexpr double kDegree = M_PI / 180.0;

// `pose` in the frame of `from`.
TimedPose seenFrom(const TimedPose& from, const TimedPose& pose) {
  const Quaterniond turn = from.attitude.conjugate();
  return {pose.time, turn * (pose.position - from.position), turn * pose.attitude};
}

std::vector<double> lengthsAlong(const PoseTrack& track) {
  std::vector<double> lengths = {0.0};
  for (std::size_t i = 1; i < track.size(); ++i)
    lengths.push_back(lengths.back() + (track[i].position - track[i - 1].position).norm());
  return lengths;
}

}  // namespace

PoseError errorOf(const Vector3d& position, const Quaterniond& attitude,
                  const Vector3d& true_position, const Quaterniond& true_attitude) {
  const Quaterniond turn = true_attitude.conjugate() * attitude;
  return {(position - true_position).norm(), localization::logSO3<double>(turn).norm() / kDegree};
}

double autocorrelationOf(const std::vector<Vector3d>& vectors) {
  if (vectors.size() < 2) return NAN;
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& vector : vectors) mean += vector / static_cast<double>(vectors.size());
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    square += (vectors[i] - mean).squaredNorm();
    if (i > 0) product += (vectors[i] - mean).dot(vectors[i - 1] - mean);
  }
  return square > 0.0 ? product / square : 0.0;
}

double smoothnessOf(const std::vector<Vector3d>& positions) {
  std::vector<Vector3d> increments;
  for (std::size_t i = 1; i < positions.size(); ++i)
    increments.push_back(positions[i] - positions[i - 1]);
  return autocorrelationOf(increments);
}

double absoluteError(const PoseTrack& estimate, const PoseTrack& truth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sum += (estimate[i].position - truth[i].position).squaredNorm();
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

std::optional<PoseError> relativeError(const PoseTrack& estimate, const PoseTrack& truth,
                                       double metres) {
  const std::vector<double> lengths = lengthsAlong(truth);
  double square_metres = 0.0, square_degrees = 0.0;
  std::size_t count = 0, to = 0;
  for (std::size_t from = 0; from < truth.size(); ++from) {
    while (to < truth.size() && lengths[to] - lengths[from] < metres) ++to;
    if (to == truth.size()) break;
    const TimedPose moved = seenFrom(estimate[from], estimate[to]);
    const TimedPose truly = seenFrom(truth[from], truth[to]);
    const PoseError error = errorOf(moved.position, moved.attitude, truly.position, truly.attitude);
    square_metres += error.metres * error.metres;
    square_degrees += error.degrees * error.degrees;
    ++count;
  }
  if (count == 0) return {};
  const auto root = [count](double sum) { return std::sqrt(sum / static_cast<double>(count)); };
  return PoseError{root(square_metres), root(square_degrees)};
}

std::string tumText(const PoseTrack& track) {
  std::string text;
  char line[256];
  for (const TimedPose& pose : track) {
    const Quaterniond& q = pose.attitude;
    std::snprintf(line, sizeof line, "%.6f %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", pose.time,
                  pose.position.x(), pose.position.y(), pose.position.z(), q.x(), q.y(), q.z(),
                  q.w());
    text += line;
  }
  return text;
}

}  // namespace grid_path_planner::trials
