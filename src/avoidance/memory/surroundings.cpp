#include "avoidance/memory/surroundings.h"

#include <algorithm>
#include <cmath>

#include "avoidance/sentence.h"

namespace grid_path_planner::avoidance {
namespace {

constexpr double kSkirts = 2.0;       // m about the vehicle, in which nothing ages
constexpr double kFuture = 0.5;       // s, of stamps
constexpr double kOldest = 10.0;      // s, of frames; the longest cloud_timeout
constexpr double kFarthest = 1e6;     // m
constexpr double kSkew = 1e-3;        // of a rotation's axes
constexpr double kLongestTime = 2e6;  // s, that milliseconds can count

HeightBand bandAbout(double height, const PilotOptions& options) {
  return {height - options.band_below, height + options.band_above};
}

bool isUsable(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix3d turned = pose.linear() * pose.linear().transpose();
  return pose.matrix().allFinite() && pose.translation().cwiseAbs().maxCoeff() < kFarthest &&
         (turned - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kSkew;
}

}  // namespace

bool isBlind(const Frame& frame, const PilotOptions& options) {
  if (frame.organised() && options.no_return_clears > 0.0) return false;
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel)
    if (const double range = Eigen::Vector3f(&frame.points[3 * pixel]).norm();
        range >= options.range_min && range <= options.range_max)
      return false;
  return true;
}

std::string Surroundings::refusal(const Frame& frame, double now,
                                  const PilotOptions& options) const {
  if (!std::isfinite(frame.time)) return "the cloud's stamp is not a number";
  if (frame.width < 0 || frame.height < 0 || frame.points.size() != 3 * frame.pixels())
    return "the cloud has " + std::to_string(frame.points.size() / 3) + " points instead of " +
           std::to_string(frame.width) + " x " + std::to_string(frame.height);
  if (frame.pixels() > kMostPixels)
    return "the cloud has " + std::to_string(frame.pixels()) + " pixels, more than " +
           std::to_string(kMostPixels);
  if (!isUsable(frame.map_from_sensor)) return "the pose of the cloud is no pose";
  if (frame.time > now + kFuture)
    return "the cloud is stamped " + shortNumber(frame.time - now) + " s in the future";
  if (frame.time < now - kOldest) return "the cloud is " + shortNumber(now - frame.time) + " s old";
  if (frame_time_ && frame.time < *frame_time_ - options.cloud_timeout)
    return "the cloud is " + shortNumber(*frame_time_ - frame.time) +
           " s older than the one before";
  return "";
}

std::int32_t Surroundings::milliseconds(double time) const {
  return static_cast<std::int32_t>(std::llround((time - *origin_) * 1e3));
}

// A cloud without points that no rays of a picture stand for is a sensor that is lost. One that is stamped
// ahead is taken as of now, so that it ages.
void Surroundings::see(const Frame& frame, double now, const PilotOptions& options) {
  problem_ = refusal(frame, now, options);
  if (!problem_.empty()) return;
  const double time = std::min(frame.time, now);
  if (origin_ && time - *origin_ > kLongestTime) forget();
  if (!origin_) origin_ = time;
  const Eigen::Vector3d sensor = frame.map_from_sensor.translation();
  memory_.moveTo(sensor);
  memory_.beginFrame(milliseconds(time));
  sight_.see(frame, options, bandAbout(band_middle_.value_or(sensor.z()), options), memory_);
  new_ = true;
  if (isBlind(frame, options))
    problem_ = "the cloud holds no point";
  else
    frame_time_ = std::max(time, frame_time_.value_or(time));
  if (sight_.pinholeDisagrees())
    problem_ = "camera_info does not agree with the cloud, so only measured rays tell what is free";
}

bool Surroundings::refresh(const Eigen::Vector3d& position, const PilotOptions& options) {
  band_middle_ = position.z();
  if (!new_ || !frame_time_) return false;
  if (!started_) memory_.clearBall(position, options.start_clear);
  started_ = true;
  if (options.rules == Rules::SAFE) memory_.keepBall(position, kSkirts);
  const double oldest = std::max(*frame_time_ - options.memory, *origin_);
  memory_.forget(milliseconds(oldest));
  space_.refresh(memory_, options.d_safe, bandAbout(position.z(), options));
  new_ = false;
  return true;
}

std::vector<RememberedPoint> Surroundings::points() const {
  std::vector<RememberedPoint> points;
  const std::vector<std::uint64_t>& words = memory_.occupiedBits().words();
  for (int word = 0; word < kSlots / 64; ++word)
    for (std::uint64_t bits = words[word]; bits != 0; bits &= bits - 1) {
      const int slot = word * 64 + __builtin_ctzll(bits);
      points.push_back(
          {memory_.point(memory_.window().voxelOf(slot)), *origin_ + 1e-3 * memory_.seenAt(slot)});
    }
  return points;
}

void Surroundings::forget() {
  memory_.clear();
  origin_.reset();
  frame_time_.reset();
  band_middle_.reset();
  new_ = started_ = false;
}

void Surroundings::forgetTheFuture(double now) {
  if (origin_ && std::max(*origin_, frame_time_.value_or(*origin_)) > now) forget();
}

}  // namespace grid_path_planner::avoidance
