// What searches that used up their nodes have learned about places: the least that a path to the goal costs
// from there. As in real-time adaptive A*, later searches take that for the estimate where it is more than the
// straight line's: else one that ends in a pocket leads to one end of it, and the next one back to the other.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <unordered_map>

namespace grid_path_planner::avoidance {

class LearnedCosts {
 public:
  // 0: nothing was learned about the place.
  double at(const Eigen::Vector3d& place) const {
    const auto found = costs_.find(keyOf(place));
    return found == costs_.end() ? 0.0 : found->second.cost;
  }
  // Keeps the larger of two costs.
  void learn(const Eigen::Vector3d& place, double cost, double time) {
    Learned& known = costs_[keyOf(place)];
    if (cost > known.cost) known = {cost, time};
  }
  void forget() { costs_.clear(); }
  void forgetBefore(double time) {
    for (auto each = costs_.begin(); each != costs_.end();)
      each = each->second.time < time ? costs_.erase(each) : std::next(each);
  }

 private:
  static constexpr double kSide = 0.4;  // m of the cubes that hold a cost each

  struct Learned {
    double cost = 0.0;
    double time = 0.0;  // s
  };

  static std::uint64_t keyOf(const Eigen::Vector3d& place) {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = key << 21 | (static_cast<std::uint64_t>(std::llround(place[axis] / kSide)) & 0x1FFFFF);
    return key;
  }

  std::unordered_map<std::uint64_t, Learned> costs_;
};

}  // namespace grid_path_planner::avoidance
