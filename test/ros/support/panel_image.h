// Images of markers as messages of a camera: the panel of test/data/two_markers.yaml, and with a third marker above.
//
//   const sensor_msgs::Image image = panelImage(panel_from_camera, stamp);
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>

namespace grid_path_planner::test {

constexpr int kPanelColumns = 240, kPanelRows = 160;
constexpr double kPanelFocal = 200.0;  // pixels

struct PanelTag {
  std::uint64_t bits;  // row by row from the upper left, 1 is white
  double x, y;         // of its centre, m
};

// The first tags of the family 36h11.
constexpr std::array<PanelTag, 3> kPanelTags = {
    {{0x21a146bab, -0.2, 0.0}, {0x92d18fe9b, 0.2, 0.0}, {0x7089014bb, 0.0, 0.22}}};

// Of the panel's plane at x to the right, y up (m), with so many tags; all around them is white.
inline bool isWhite(double x, double y, std::size_t tags) {
  constexpr double kCell = 0.2 / 8.0;
  for (std::size_t tag = 0; tag < tags; ++tag) {
    const auto& [bits, centre_x, centre_y] = kPanelTags[tag];
    const auto column = static_cast<int>(std::floor((x - (centre_x - 0.1)) / kCell));
    const auto row = static_cast<int>(std::floor((centre_y + 0.1 - y) / kCell));
    if (column < 0 || column > 7 || row < 0 || row > 7) continue;
    const bool inside = column > 0 && column < 7 && row > 0 && row < 7;
    return inside && (bits >> (35 - 6 * (row - 1) - (column - 1)) & 1) == 1;
  }
  return true;
}

// The camera's optical frame in the panel's, before its front; sixteen samples a pixel.
inline sensor_msgs::Image panelImage(const Eigen::Isometry3d& panel_from_camera,
                                     const ros::Time& stamp, double focal = kPanelFocal,
                                     std::size_t tags = 2) {
  sensor_msgs::Image image;
  image.header.frame_id = "camera";
  image.header.stamp = stamp;
  image.width = kPanelColumns;
  image.height = kPanelRows;
  image.encoding = "mono8";
  image.step = kPanelColumns;
  for (int row = 0; row < kPanelRows; ++row)
    for (int column = 0; column < kPanelColumns; ++column) {
      int white = 0;
      for (int i = 0; i < 16; ++i) {
        const Eigen::Vector3d ray(
            (column + 0.25 * (i % 4) - 0.375 - 0.5 * (kPanelColumns - 1)) / focal,
            (row + 0.25 * (i / 4) - 0.375 - 0.5 * (kPanelRows - 1)) / focal, 1.0);
        const Eigen::Vector3d at = panel_from_camera.translation(),
                              along = panel_from_camera.linear() * ray;
        const double range = -at.z() / along.z();
        white += isWhite(at.x() + range * along.x(), at.y() + range * along.y(), tags);
      }
      image.data.push_back(static_cast<std::uint8_t>(40 + 10 * white));
    }
  return image;
}

inline sensor_msgs::CameraInfo panelCamera(double focal = kPanelFocal) {
  sensor_msgs::CameraInfo info;
  info.width = kPanelColumns;
  info.height = kPanelRows;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {focal, 0.0, 0.5 * (kPanelColumns - 1), 0.0, focal, 0.5 * (kPanelRows - 1), 0.0,
            0.0,   1.0};
  return info;
}

}  // namespace grid_path_planner::test
