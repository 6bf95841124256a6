// How long the vehicle has made no progress.
//
// It moves where it comes a metre away from where it was; it gains where it comes a metre nearer to its
// goal than it ever was. A path around something moves without gaining.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace grid_path_planner::avoidance {

class ProgressWatch {
 public:
  void restart(double time, const Eigen::Vector3d& position, const Eigen::Vector3d& goal) {
    anchor_ = position;
    moved_at_ = gained_at_ = time;
    nearest_ = counted_ = (goal - position).norm();
  }
  // Whether it gained.
  bool update(double time, const Eigen::Vector3d& position, const Eigen::Vector3d& goal) {
    if ((position - anchor_).norm() >= kMetre) {
      anchor_ = position;
      moved_at_ = time;
    }
    nearest_ = std::min(nearest_, (goal - position).norm());
    if (nearest_ > counted_ - kMetre) return false;
    counted_ = nearest_;
    gained_at_ = time;
    return true;
  }
  // As if it had moved and gained just now.
  void excuse(double time) { moved_at_ = gained_at_ = time; }
  // The last `seconds` do not count.
  void hold(double seconds) {
    moved_at_ += seconds;
    gained_at_ += seconds;
  }
  // Seconds.
  double sinceMoved(double time) const { return time - moved_at_; }
  double sinceGained(double time) const { return time - gained_at_; }
  // m, of all distances to the goal since the restart.
  double nearest() const { return nearest_; }

 private:
  static constexpr double kMetre = 1.0;

  Eigen::Vector3d anchor_ = Eigen::Vector3d::Zero();
  double moved_at_ = 0.0, gained_at_ = 0.0;
  double nearest_ = 0.0, counted_ = 0.0;
};

}  // namespace grid_path_planner::avoidance
