#include "panel/drive_progress.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::panel {
namespace {

constexpr double kWindow = 10.0;           // s, over which the speed is taken
constexpr double kAnotherDrive = 1.0;      // m, that the distance grows by
constexpr double kLeastTime = 1.0;         // s
constexpr double kLeastDistance = 0.01;    // m
constexpr std::size_t kMostSamples = 500;  // also where time stands still

}  // namespace

void DriveProgress::clear() {
  *this = DriveProgress();
}

void DriveProgress::add(double time, double remaining) {
  if (!std::isfinite(time) || !std::isfinite(remaining) || remaining < 0.0) {
    clear();
    return;
  }
  const bool goes_on = !samples_.empty() && time >= samples_.back().time &&
                       remaining <= samples_.back().remaining + kAnotherDrive;
  if (!goes_on) clear();
  samples_.push_back({time, remaining});
  longest_ = std::max(longest_, remaining);
  while (samples_.size() > kMostSamples || time - samples_.front().time > kWindow)
    samples_.pop_front();
}

std::optional<double> DriveProgress::share() const {
  if (samples_.empty()) return std::nullopt;
  return longest_ > 0.0 ? 1.0 - samples_.back().remaining / longest_ : 1.0;
}

std::optional<double> DriveProgress::secondsLeft() const {
  if (samples_.empty()) return std::nullopt;
  const double time = samples_.back().time - samples_.front().time;
  const double distance = samples_.front().remaining - samples_.back().remaining;
  if (time < kLeastTime || distance < kLeastDistance) return std::nullopt;
  return samples_.back().remaining * time / distance;
}

}  // namespace grid_path_planner::panel
