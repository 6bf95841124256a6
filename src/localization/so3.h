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
inline Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
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

// exp(v + d) = exp(v) exp(rightJacobian(v) d) to first order in d.
inline Eigen::Matrix3d rightJacobian(const Eigen::Vector3d& v) {
  const double squared = v.squaredNorm();
  double first = 0.5 - squared / 24.0;
  double second = 1.0 / 6.0 - squared / 120.0;
  if (squared >= kSmallAngleSquared) {
    const double angle = std::sqrt(squared);
    first = (1.0 - std::cos(angle)) / squared;
    second = (angle - std::sin(angle)) / (squared * angle);
  }
  const Eigen::Matrix3d hat = cross(v);
  return Eigen::Matrix3d::Identity() - first * hat + second * hat * hat;
}

// Of the right Jacobian; exists for norms of v below 2 pi.
inline Eigen::Matrix3d rightJacobianInverse(const Eigen::Vector3d& v) {
  const double squared = v.squaredNorm();
  double second = 1.0 / 12.0 + squared / 720.0;
  if (squared >= kSmallAngleSquared) {
    const double angle = std::sqrt(squared);
    second = 1.0 / squared - 1.0 / (2.0 * angle * std::tan(0.5 * angle));
  }
  const Eigen::Matrix3d hat = cross(v);
  return Eigen::Matrix3d::Identity() + 0.5 * hat + second * hat * hat;
}

// The left Jacobian of v is the right one of -v.
inline Eigen::Matrix3d leftJacobianInverse(const Eigen::Vector3d& v) {
  return rightJacobianInverse(-v);
}

}  // namespace grid_path_planner::localization
