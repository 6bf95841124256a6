// A panel in the map, a vehicle before it and the camera on that, for rostests of marker_localizer.
//
//   node = Process("marker_localizer", kPanelKnown);
//   EXPECT_LT(distanceBetween(poseOf(message.pose.pose), mapFromBase()), 0.02);
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/TransformStamped.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "ros/simulation/transform_message.h"

namespace grid_path_planner::test {

// The camera looks along the vehicle's x axis, 0.3 m ahead of base_link.
inline Eigen::Isometry3d baseFromCamera() {
  Eigen::Isometry3d pose(Eigen::Translation3d(0.3, 0.0, 0.1));
  pose.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return pose;
}

// The panel of the launch arguments below: 5 m along x, upright, its front towards the map's origin.
inline Eigen::Isometry3d mapFromPanel() {
  Eigen::Isometry3d pose(Eigen::Translation3d(5.0, 1.0, 2.0));
  pose.rotate(Eigen::AngleAxisd(-M_PI / 2.0, Eigen::Vector3d::UnitZ()));
  return pose.rotate(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitX()));
}

inline const std::vector<std::string> kPanelKnown = {"_panel_known:=true",
                                                     "_panel_x:=5",
                                                     "_panel_y:=1",
                                                     "_panel_z:=2",
                                                     "_panel_yaw:=" + std::to_string(-M_PI / 2.0),
                                                     "_panel_roll:=" + std::to_string(M_PI / 2.0)};

// A metre before the panel and a little aside and turned, so that the two tags are seen from aside.
inline Eigen::Isometry3d mapFromBase() {
  Eigen::Isometry3d pose(Eigen::Translation3d(3.7, 1.25, 1.95));
  return pose.rotate(Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitZ()));
}

inline geometry_msgs::TransformStamped stampedTransform(const char* frame, const char* child,
                                                        const Eigen::Isometry3d& pose,
                                                        const ros::Time& stamp) {
  geometry_msgs::TransformStamped transform = nodes::transformOf(frame, child, pose);
  transform.header.stamp = stamp;
  return transform;
}

inline Eigen::Isometry3d poseOf(const geometry_msgs::Pose& pose) {
  Eigen::Isometry3d isometry(
      Eigen::Translation3d(pose.position.x, pose.position.y, pose.position.z));
  return isometry.rotate(Eigen::Quaterniond(pose.orientation.w, pose.orientation.x,
                                            pose.orientation.y, pose.orientation.z));
}

inline double distanceBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}

inline double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(a.linear().transpose() * b.linear())).angle();
}

}  // namespace grid_path_planner::test
