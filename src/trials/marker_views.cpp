#include "trials/marker_views.h"

#include <cmath>

#include "trials/noise.h"
#include "vision/grey_conversion.h"
#include "vision/mean_pose.h"
#include "vision/pose_candidates.h"

namespace grid_path_planner::trials {

using Eigen::Isometry3d, Eigen::Quaterniond, Eigen::Vector3d;
using simulation::ImageCamera, simulation::ImageCameraOptions, simulation::World;
using vision::CameraCalibration, vision::DetectedMarker, vision::MarkerFix, vision::MarkerView;

namespace {

ImageCameraOptions optionsIn(ImageCameraOptions options, Water water) {
  if (water == Water::CLEAR)
    options.attenuation_red = options.attenuation_green = options.attenuation_blue = 0.0;
  return options;
}

CameraCalibration calibrationOf(const ImageCamera& camera) {
  const simulation::CameraIntrinsics k = camera.intrinsics();
  return {camera.options().width, camera.options().height, k.fx, k.fy, k.cx, k.cy, {}};
}

CameraPose poseOf(const Isometry3d& pose) {
  return {pose.translation(), Quaterniond(pose.linear())};
}

Isometry3d isometryOf(const CameraPose& pose) {
  return Eigen::Translation3d(pose.position) * pose.attitude;
}

std::vector<CameraPose> posesOfEach(const MarkerFix& fix, const vision::MarkerLayout& layout,
                                    const CameraCalibration& calibration, double pixel_noise) {
  std::vector<CameraPose> poses;
  for (const MarkerView& view : fix.views) {
    const auto found = jointPoses({view}, layout, calibration, pixel_noise);
    if (!found.empty()) poses.push_back(poseOf(found.front().panel_from_camera));
  }
  return poses;
}

Vector3d meanPosition(const std::vector<CameraPose>& poses) {
  Vector3d sum = Vector3d::Zero();
  for (const CameraPose& pose : poses) sum += pose.position;
  return sum / static_cast<double>(poses.size());
}

std::vector<Quaterniond> attitudesOf(const std::vector<CameraPose>& poses) {
  std::vector<Quaterniond> attitudes;
  for (const CameraPose& pose : poses) attitudes.push_back(pose.attitude);
  return attitudes;
}

}  // namespace

int frameCount(const TrialStudy& study) {
  return static_cast<int>(std::floor(study.drive.seconds * study.camera.rate + 1e-9)) + 1;
}

double frameTime(const TrialStudy& study, int frame) {
  return frame / study.camera.rate;
}

Quaterniond sequentialMean(const std::vector<Quaterniond>& attitudes) {
  Quaterniond mean = attitudes.front();
  for (std::size_t i = 1; i < attitudes.size(); ++i)
    mean = mean.slerp(1.0 / static_cast<double>(i + 1), attitudes[i]);
  return mean;
}

ViewRenderer::ViewRenderer(const TrialStudy& study, const World& world)
    : study_(study),
      drive_(study.drive, study.map_from_panel),
      layout_(vision::readMarkerLayout(study.layout)),
      clear_(world, optionsIn(study.camera, Water::CLEAR)),
      turbid_(world, study.camera) {
  calibration_ = calibrationOf(turbid_);
}

Isometry3d ViewRenderer::panelFromCamera(int frame) const {
  return study_.map_from_panel.inverse() * mapFromBase(drive_.stateAt(frameTime(study_, frame))) *
         turbid_.baseFromOptical();
}

SeenFrame ViewRenderer::look(int frame, Water water) const {
  const ImageCamera& camera = water == Water::CLEAR ? clear_ : turbid_;
  std::vector<std::uint8_t> rgb;
  camera.render(study_.map_from_panel * panelFromCamera(frame), static_cast<std::uint64_t>(frame),
                rgb);
  const auto width = static_cast<std::uint32_t>(calibration_.width);
  const auto height = static_cast<std::uint32_t>(calibration_.height);
  const auto grey =
      vision::greyPixels({"rgb8", width, height, 3 * width, false, rgb.data(), rgb.size()});
  const auto markers =
      detectMarkers({grey.data(), calibration_.width, calibration_.height, width}, study_.markers);
  SeenFrame seen{frame, water, {}};
  for (const ErrorSet& set : study_.sets)
    seen.solutions.push_back(solve(set, markers, frame, water));
  return seen;
}

ViewSolution ViewRenderer::solve(const ErrorSet& set, std::vector<DetectedMarker> markers,
                                 int frame, Water water) const {
  Noise noise(frame, water == Water::CLEAR ? Purpose::CORNERS_CLEAR : Purpose::CORNERS_TURBID);
  for (DetectedMarker& marker : markers)
    for (Eigen::Vector2d& corner : marker.corners)
      corner += set.corner_noise * noise.normals().head<2>();
  CameraCalibration calibration = calibration_;
  calibration.fx *= 1.0 + set.focal_error;
  calibration.fy *= 1.0 + set.focal_error;
  const MarkerFix fix = fixOf(markers, layout_, calibration, study_.markers);
  const auto each = posesOfEach(fix, layout_, calibration, study_.markers.pixel_noise);
  ViewSolution solution;
  solution.markers = static_cast<int>(each.size());
  if (each.empty()) return solution;
  solution.mean = CameraPose{meanPosition(each), vision::meanAttitude(attitudesOf(each))};
  if (fix.pose)
    solution.joint = JointPose{poseOf(fix.pose->panel_from_camera), fix.pose->covariance};
  solution.panel = panelErrors(each, solution, frame);
  return solution;
}

// The panel in the map, by the vehicle's true pose and the camera's before the panel.
PanelErrors ViewRenderer::panelErrors(const std::vector<CameraPose>& each,
                                      const ViewSolution& solution, int frame) const {
  const Isometry3d map_from_camera = study_.map_from_panel * panelFromCamera(frame);
  const auto panelBy = [&](const CameraPose& camera) {
    return poseOf(map_from_camera * isometryOf(camera).inverse());
  };
  const CameraPose truth = poseOf(study_.map_from_panel);
  const auto error = [&](const Vector3d& position, const Quaterniond& attitude) {
    return errorOf(position, attitude, truth.position, truth.attitude);
  };
  std::vector<CameraPose> panels;
  for (const CameraPose& camera : each) panels.push_back(panelBy(camera));
  const Vector3d position = meanPosition(panels);
  const auto attitudes = attitudesOf(panels);
  PanelErrors errors{error(position, vision::meanAttitude(attitudes)),
                     error(position, sequentialMean(attitudes)),
                     {}};
  if (solution.joint) {
    const CameraPose panel = panelBy(solution.joint->camera);
    errors.joint = error(panel.position, panel.attitude);
  }
  return errors;
}

}  // namespace grid_path_planner::trials
