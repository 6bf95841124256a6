#include "grid_path_planner/costmap/exact_cost.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace grid_path_planner::costmap {
namespace {

// sign of a + b sqrt 2
int signOf(std::int64_t a, std::int64_t b) {
  if (a >= 0 && b >= 0) return a > 0 || b > 0;
  if (a <= 0 && b <= 0) return -1;
  using Wide = boost::multiprecision::int128_t;
  const Wide difference = Wide(a) * a - Wide(b) * b * 2;  // never 0: sqrt 2 is irrational
  return (a > 0) == (difference > 0) ? 1 : -1;
}

}  // namespace

double ExactCost::toDouble() const {
  if (diagonal == 0) return static_cast<double>(straight);
  using Quad = boost::multiprecision::cpp_bin_float_quad;
  static const Quad root = sqrt(Quad(2));
  return static_cast<double>(Quad(straight) + Quad(diagonal) * root);
}

bool operator<(const ExactCost& a, const ExactCost& b) {
  return signOf(a.straight - b.straight, a.diagonal - b.diagonal) < 0;
}

}  // namespace grid_path_planner::costmap
