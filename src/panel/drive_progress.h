// How far a drive is, and how long it will still take: by the speed of the last seconds.
#pragma once

#include <deque>
#include <optional>

namespace grid_path_planner::panel {

class DriveProgress {
 public:
  // `remaining` metres at `time`, in seconds of one clock. A time that goes back, a distance that
  // grows by more than a metre, and what is not finite or negative begins anew.
  void add(double time, double remaining);
  void clear();

  // 0...1 of the longest distance seen; none before the first.
  std::optional<double> share() const;
  // None while less than a second or a centimetre was seen, as for a vehicle that stands.
  std::optional<double> secondsLeft() const;

 private:
  struct Sample {
    double time, remaining;
  };
  std::deque<Sample> samples_;  // of the last kWindow seconds
  double longest_ = 0.0;        // m
};

}  // namespace grid_path_planner::panel
