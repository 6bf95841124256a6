// A panel with markers as a camera sees it, projected by OpenCV and not by the room that is tested.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>
#include <random>
#include <vector>

#include "vision/marker_pose.h"

namespace grid_path_planner::vision {

inline CameraCalibration camera640() {
  return {640, 480, 467.73, 467.73, 319.5, 239.5, {}};
}

// The layout that is shipped, or some markers of it.
inline MarkerLayout shippedLayout(const std::vector<int>& ids = {}) {
  MarkerLayout layout = readMarkerLayout("config/panel_markers.yaml");
  if (ids.empty()) return layout;
  MarkerLayout some{layout.tag_size, {}};
  for (const int id : ids) some.panel_from_tag.emplace(id, layout.panel_from_tag.at(id));
  return some;
}

// A camera at `position` in the panel's frame that looks at `target`, upright but for `roll` (rad).
inline Eigen::Isometry3d lookingAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target,
                                   double roll = 0.0) {
  const Eigen::Vector3d ahead = (target - position).normalized();
  const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d pose(Eigen::Translation3d{position});
  pose.linear() << right, ahead.cross(right), ahead;
  pose.rotate(Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()));
  return pose;
}

// In front of the panel, 1.5 to 4 m away, looking at it.
inline Eigen::Isometry3d randomPose(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const double side = between(-0.8, 0.8), range = between(1.5, 4.0);
  const Eigen::Vector3d position(range * std::sin(side), -range * std::cos(side),
                                 between(-0.6, 0.6));
  return lookingAt(position, {between(-0.3, 0.3), 0.0, between(-0.2, 0.2)}, between(-0.2, 0.2));
}

// The markers of `ids` as seen by OpenCV's projection, with noise of `sigma` pixels.
inline std::vector<DetectedMarker> seenFrom(const Eigen::Isometry3d& panel_from_camera,
                                            const MarkerLayout& layout, const CameraCalibration& c,
                                            double sigma, std::mt19937& random) {
  const Eigen::Isometry3d camera_from_panel = panel_from_camera.inverse();
  const Eigen::AngleAxisd turn(camera_from_panel.rotation());
  const Eigen::Vector3d r = turn.angle() * turn.axis(), t = camera_from_panel.translation();
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<DetectedMarker> markers;
  for (const auto& [id, unused] : layout.panel_from_tag) {
    std::vector<cv::Point3d> points;
    for (const Eigen::Vector3d& p : layout.cornersOf(id)) points.emplace_back(p.x(), p.y(), p.z());
    std::vector<cv::Point2d> pixels;
    cv::projectPoints(points, cv::Vec3d(r.x(), r.y(), r.z()), cv::Vec3d(t.x(), t.y(), t.z()),
                      cv::Matx33d(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1), c.distortion, pixels);
    DetectedMarker marker{id, {}};
    for (int i = 0; i < 4; ++i)
      marker.corners[i] = {pixels[i].x + sigma * noise(random),
                           pixels[i].y + sigma * noise(random)};
    markers.push_back(marker);
  }
  return markers;
}

}  // namespace grid_path_planner::vision
