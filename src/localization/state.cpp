#include "localization/state.h"

#include <cmath>

namespace grid_path_planner::localization {

Mounting inverse(const Mounting& mounting) {
  const Eigen::Quaterniond back = mounting.rotation.conjugate();
  return {-(back * mounting.position), back};
}

Mounting operator*(const Mounting& outer, const Mounting& inner) {
  return {outer.position + outer.rotation * inner.position, outer.rotation * inner.rotation};
}

double yawOf(const Eigen::Quaterniond& attitude) {
  const Eigen::Vector3d forward = attitude * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

}  // namespace grid_path_planner::localization
