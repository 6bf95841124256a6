// Numbers that carry a derivative along: automatic differentiation by one variable.
//
//   const Dual x(2.0, 1.0);                    // d x / d x is 1
//   sin(x * x).derivative;                     // cos(4) 4
//
// A scalar of Eigen. Written for these tests: Eigen's own AutoDiffScalar is compiled for half a minute.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace grid_path_planner::localization {

struct Dual {
  double value = 0.0, derivative = 0.0;

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT(google-explicit-constructor): as of any number
  Dual(double v, double d) : value(v), derivative(d) {}

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend Dual operator-(const Dual& a) { return {-a.value, -a.derivative}; }
  friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.derivative + b.derivative};
  }
  friend Dual operator-(const Dual& a, const Dual& b) { return a + -b; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.derivative * b.value + a.value * b.derivative};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double ratio = a.value / b.value;
    return {ratio, (a.derivative - ratio * b.derivative) / b.value};
  }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return b < a; }
};

inline Dual sin(const Dual& a) {
  return {std::sin(a.value), std::cos(a.value) * a.derivative};
}
inline Dual cos(const Dual& a) {
  return {std::cos(a.value), -std::sin(a.value) * a.derivative};
}
inline Dual sqrt(const Dual& a) {
  const double root = std::sqrt(a.value);
  return {root, 0.5 * a.derivative / root};
}
inline Dual atan2(const Dual& y, const Dual& x) {
  const double squared = x.value * x.value + y.value * y.value;
  return {std::atan2(y.value, x.value),
          (x.value * y.derivative - y.value * x.derivative) / squared};
}

}  // namespace grid_path_planner::localization

namespace Eigen {

template <>
struct NumTraits<grid_path_planner::localization::Dual> : NumTraits<double> {
  using Real = grid_path_planner::localization::Dual;
  using NonInteger = Real;
  using Nested = Real;
  enum { RequireInitialization = 1 };
};

}  // namespace Eigen
