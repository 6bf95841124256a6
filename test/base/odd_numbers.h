// Numbers of all sizes, the odd ones more often than they deserve: for laws about what comes from a network.
#pragma once

#include <cmath>
#include <limits>
#include <random>

namespace grid_path_planner::test {

class OddNumbers {
 public:
  explicit OddNumbers(unsigned seed) : random_(seed) {}

  double any() { return random_() % 3 == 0 ? odd() : near(); }
  double odd() {
    switch (random_() % 4) {
      case 0:
        return 0.0;
      case 1:
        return std::ldexp(sign(), static_cast<int>(random_() % 2200) - 1100);
      case 2:
        return random_() % 8 == 0 ? std::numeric_limits<double>::infinity() : 1e160 * sign();
      default:
        return random_() % 8 == 0 ? std::nan("") : 1e6 * sign();
    }
  }
  double near() { return std::uniform_real_distribution<double>(-5.0, 5.0)(random_); }
  double sign() { return random_() % 2 == 0 ? 1.0 : -1.0; }
  unsigned below(unsigned end) { return static_cast<unsigned>(random_() % end); }

 private:
  std::mt19937_64 random_;
};

}  // namespace grid_path_planner::test
