#include "vision/panel_learning.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "vision/mean_pose.h"

namespace grid_path_planner::vision {

using base::decimalText, base::InputError;
using Eigen::Isometry3d, Eigen::Matrix3d, Eigen::Vector3d;

namespace {

constexpr double kLongestGap = 2.0;  // s

// How far something moved from where it was first.
class Motion {
 public:
  explicit Motion(const Isometry3d& first) : first_(first) {}

  void add(const Isometry3d& pose) {
    const Vector6 difference = differenceOf(pose, first_);
    distance_ = std::max(distance_, difference.head<3>().norm());
    angle_ = std::max(angle_, difference.tail<3>().norm() * 180.0 / M_PI);
  }
  void check(const std::string& what, const PanelLearningOptions& limits) const {
    if (distance_ > limits.distance || angle_ > limits.angle)
      throw InputError(what + " moved by " + decimalText(std::round(1e4 * distance_) / 1e4) +
                       " m and " + decimalText(std::round(100.0 * angle_) / 100.0) +
                       " degrees during the last images");
  }

 private:
  Isometry3d first_;
  double distance_ = 0.0, angle_ = 0.0;
};

}  // namespace

PanelSighting sightingOf(double time, const Isometry3d& map_from_base,
                         const Isometry3d& base_from_camera, const PoseEstimate& pose) {
  const Isometry3d camera_from_panel = pose.panel_from_camera.inverse();
  const Isometry3d map_from_camera = map_from_base * base_from_camera;
  // Of the panel's position and right error by the camera's, each as in PoseEstimate::covariance.
  Matrix6 jacobian;
  jacobian << -map_from_camera.linear() * camera_from_panel.linear(),
      map_from_camera.linear() * crossMatrix(camera_from_panel.translation()), Matrix3d::Zero(),
      -pose.panel_from_camera.linear();
  return {time,
          map_from_base,
          {map_from_camera * camera_from_panel, jacobian * pose.covariance * jacobian.transpose()}};
}

void PanelSightings::add(const PanelSighting& sighting) {
  if (!sightings_.empty() && sighting.time - sightings_.back().time > kLongestGap) clear();
  sightings_.push_back(sighting);
  while (sightings_.size() > static_cast<std::size_t>(options_.images)) sightings_.pop_front();
}

void PanelSightings::check() const {
  if (sightings_.size() < static_cast<std::size_t>(options_.images))
    throw InputError("it takes " + std::to_string(options_.images) +
                     " images with a pose, so far there are " + std::to_string(sightings_.size()));
  Motion of_vehicle(sightings_.front().map_from_base);
  Motion of_panel(sightings_.front().panel.map_from_panel);
  for (const PanelSighting& sighting : sightings_) {
    of_vehicle.add(sighting.map_from_base);
    of_panel.add(sighting.panel.map_from_panel);
  }
  of_vehicle.check("the vehicle", options_);
  of_panel.check("the panel", options_);
}

PanelPose PanelSightings::learnt() const {
  check();
  const double share = 1.0 / static_cast<double>(sightings_.size());
  Vector3d position = Vector3d::Zero();
  std::vector<Eigen::Quaterniond> attitudes;
  PanelPose mean;
  for (const PanelSighting& sighting : sightings_) {
    position += share * sighting.panel.map_from_panel.translation();
    mean.covariance += share * sighting.panel.covariance;
    attitudes.emplace_back(sighting.panel.map_from_panel.linear());
  }
  mean.map_from_panel = Eigen::Translation3d(position) * meanAttitude(attitudes);
  return mean;
}

}  // namespace grid_path_planner::vision
