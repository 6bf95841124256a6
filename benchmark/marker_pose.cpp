// What an image of the simulated camera costs, and the pose of the markers in it.
//
//   grid_path_planner_marker_pose [IMAGES [FOLDER]]
//
// Renders 640x480 images before the panel of worlds/panel_site.sdf along an arc of 92 degrees, in clear water (E0) and
// turbid (E*), and prints CPU times and errors. With a folder the images are written there as PNG.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "grid_path_planner/simulation/world.h"
#include "simulation/camera/image_camera.h"
#include "vision/marker_pose.h"

namespace {

using namespace grid_path_planner::simulation;
using namespace grid_path_planner::vision;
using Eigen::Isometry3d, Eigen::Vector3d;

struct Totals {
  double rendering = 0.0, solving = 0.0;  // s, CPU
  double metres = 0.0, degrees = 0.0;     // sums of errors
  int poses = 0;
};

double cpuSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// In the panel's frame, 1.7 to 3.3 m before it.
Isometry3d poseOnArc(double share) {
  const double side = 0.8 * (2.0 * share - 1.0), range = 2.5 + 0.8 * std::sin(7.0 * share);
  Isometry3d pose(Eigen::Translation3d(range * std::sin(side), -range * std::cos(side), 0.0));
  pose.linear() << std::cos(side), 0.0, -std::sin(side),  //
      std::sin(side), 0.0, std::cos(side),                //
      0.0, -1.0, 0.0;
  return pose;
}

void run(const ImageCamera& camera, int images, const std::string& files, Totals& totals) {
  const MarkerLayout layout = readMarkerLayout("config/panel_markers.yaml");
  const CameraIntrinsics k = camera.intrinsics();
  const CameraCalibration calibration = {
      camera.options().width, camera.options().height, k.fx, k.fy, k.cx, k.cy, {}};
  Isometry3d map_from_panel(Eigen::Translation3d(4.05, -0.55, 2.9));
  map_from_panel.rotate(Eigen::AngleAxisd(0.42, Vector3d::UnitZ()));
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < images; ++i) {
    const Isometry3d pose = poseOnArc((i + 0.5) / images);
    const double begin = cpuSeconds();
    camera.render(map_from_panel * pose, i, rgb);
    const double rendered = cpuSeconds();
    std::vector<std::uint8_t> grey(rgb.size() / 3);
    for (std::size_t p = 0; p < grey.size(); ++p)
      grey[p] =
          static_cast<std::uint8_t>((rgb[3 * p] + 2 * rgb[3 * p + 1] + rgb[3 * p + 2] + 2) / 4);
    const MarkerFix fix = markerFix({grey.data(), calibration.width, calibration.height,
                                     static_cast<std::size_t>(calibration.width)},
                                    layout, calibration, {});
    totals.rendering += rendered - begin;
    totals.solving += cpuSeconds() - rendered;
    if (fix.pose) {
      const auto error = differenceOf(fix.pose->panel_from_camera, pose);
      totals.metres += error.head<3>().norm();
      totals.degrees += error.tail<3>().norm() * 180.0 / M_PI;
      ++totals.poses;
    }
    if (files.empty()) continue;
    cv::Mat bgr(calibration.height, calibration.width, CV_8UC3);
    for (std::size_t p = 0; p < grey.size(); ++p)
      for (int c = 0; c < 3; ++c) bgr.data[3 * p + c] = rgb[3 * p + 2 - c];
    cv::imwrite(files + std::to_string(i) + ".png", bgr);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int images = argc > 1 ? std::atoi(argv[1]) : 50;
  const std::string folder = argc > 2 ? std::string(argv[2]) + "/" : "";
  const World world = readWorld("worlds/panel_site.sdf");
  for (const bool turbid : {false, true}) {
    ImageCameraOptions options;
    if (!turbid)
      options.attenuation_red = options.attenuation_green = options.attenuation_blue = 0.0;
    Totals t;
    run(ImageCamera(world, options), images,
        folder.empty() ? "" : folder + (turbid ? "turbid_" : "clear_"), t);
    std::printf("%s: %.1f ms an image, %.1f ms its pose; %d of %d poses, %.4f m and %.3f deg off\n",
                turbid ? "E*" : "E0", 1e3 * t.rendering / images, 1e3 * t.solving / images, t.poses,
                images, t.metres / std::max(t.poses, 1), t.degrees / std::max(t.poses, 1));
  }
  return 0;
}
