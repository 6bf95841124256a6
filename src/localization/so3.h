// Rotations as unit quaternions: exponential, logarithm and their Jacobians.
//
//   Eigen::Quaterniond turned = attitude * expSO3<double>(rotation_vector);
//   Eigen::Vector3d back = logSO3<double>(attitude.conjugate() * turned);
//
// Rotation vectors are in radians. Guaranteed: full precision at angles near 0; logSO3() is the
// shorter of the two turns, its norm at most pi, whatever the sign of the quaternion. T is double or
// a type of automatic differentiation.
// Source: J. Sola, J. Deray, D. Atchuthan, A micro Lie theory for state estimation in robotics, 2018.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace grid_path_planner::localization {

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

constexpr double kSmallAngleSquared = 1e-6;  // rad^2; below it series to the fourth power

// cross(v) * w is v x w.
template <class T>
Eigen::Matrix<T, 3, 3> cross(const Vector3<T>& v) {
  Eigen::Matrix<T, 3, 3> matrix;
  matrix << T(0.0), -v.z(), v.y(), v.z(), T(0.0), -v.x(), -v.y(), v.x(), T(0.0);
  return matrix;
}

inline Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  return cross<double>(v);
}

template <class T>
Eigen::Quaternion<T> expSO3(const Vector3<T>& rotation) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T squared = rotation.squaredNorm();
  if (squared < kSmallAngleSquared) {
    const T real = 1.0 - squared / 8.0 + squared * squared / 384.0;
    const T factor = 0.5 - squared / 48.0 + squared * squared / 3840.0;
    return {real, factor * rotation.x(), factor * rotation.y(), factor * rotation.z()};
  }
  const T angle = sqrt(squared);
  const T half = 0.5 * angle;
  const T real = cos(half);
  const T factor = sin(half) / angle;
  return {real, factor * rotation.x(), factor * rotation.y(), factor * rotation.z()};
}

template <class T>
Vector3<T> logSO3(const Eigen::Quaternion<T>& q) {
  using std::atan2;
  using std::sqrt;
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const T real = sign * q.w();
  const Vector3<T> imaginary(sign * q.x(), sign * q.y(), sign * q.z());
  const T squared = imaginary.squaredNorm();
  if (squared < kSmallAngleSquared) {
    const T ratio = squared / (real * real);
    const T factor = 2.0 / real * (1.0 - ratio / 3.0 + ratio * ratio / 5.0);
    return imaginary * factor;
  }
  const T norm = sqrt(squared);
  const T factor = 2.0 * atan2(norm, real) / norm;
  return imaginary * factor;
}

// exp(v + d) = exp(leftJacobian(v) d) exp(v) to first order in d; exp(v) w = w + leftJacobian(v) (v x w).
template <class T>
Eigen::Matrix<T, 3, 3> leftJacobian(const Vector3<T>& v) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T squared = v.squaredNorm();
  T first = 0.5 - squared / 24.0;
  T second = 1.0 / 6.0 - squared / 120.0;
  if (!(squared < kSmallAngleSquared)) {
    const T angle = sqrt(squared);
    first = (1.0 - cos(angle)) / squared;
    second = (angle - sin(angle)) / (squared * angle);
  }
  const Eigen::Matrix<T, 3, 3> hat = cross(v);
  return Eigen::Matrix<T, 3, 3>::Identity() + first * hat + second * hat * hat;
}

// Of the left Jacobian; exists for norms of v below 2 pi.
template <class T>
Eigen::Matrix<T, 3, 3> leftJacobianInverse(const Vector3<T>& v) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T squared = v.squaredNorm();
  T second = 1.0 / 12.0 + squared / 720.0;
  if (!(squared < kSmallAngleSquared)) {
    const T angle = sqrt(squared);
    const T half = 0.5 * angle;
    second = 1.0 / squared - cos(half) / (2.0 * angle * sin(half));
  }
  const Eigen::Matrix<T, 3, 3> hat = cross(v);
  return Eigen::Matrix<T, 3, 3>::Identity() - T(0.5) * hat + second * hat * hat;
}

// exp(v + d) = exp(v) exp(rightJacobian(v) d) to first order in d.
inline Eigen::Matrix3d rightJacobian(const Eigen::Vector3d& v) {
  return leftJacobian<double>(-v);
}

inline Eigen::Matrix3d rightJacobianInverse(const Eigen::Vector3d& v) {
  return leftJacobianInverse<double>(-v);
}

}  // namespace grid_path_planner::localization
