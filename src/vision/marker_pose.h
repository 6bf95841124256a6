// Where a camera is, by an image of a panel with markers.
//
//   const MarkerLayout layout = readMarkerLayout("config/panel_markers.yaml");
//   const MarkerFix fix = markerFix(image, layout, calibration, options, prediction);
//   if (fix.pose) use(fix.pose->panel_from_camera, fix.pose->covariance);
//   else tell(fix.reason);
//
// All corners of the layout's markers give one pose. Where they admit two that the noise does not tell apart,
// as one marker alone mostly does, both are kept, and the prediction chooses; without one, or where it fits both or
// neither, there is no pose. Ids that the layout does not have are counted and never used. Where three markers or
// more do not fit together, calibration or layout is off: there is no pose, and the reason names the marker
// without which the others fit.
//
// Guaranteed: the same image and prediction give the same fix. Not guaranteed: that a marker is where the layout
// has it, if fewer than three are seen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vision/camera_calibration.h"
#include "vision/marker_detection.h"
#include "vision/marker_pose_options.h"
#include "vision/pose_estimate.h"

namespace grid_path_planner::vision {

struct MarkerFix {
  std::optional<PoseEstimate> pose;
  std::string reason;                    // one sentence, where there is no pose
  std::vector<PoseEstimate> candidates;  // that the corners admit, the best fit first
  MarkerViews views;                     // the layout's markers that were seen
  int unknown = 0;                       // markers that the layout does not have
  bool fits = true;  // false: calibration or layout is off, three markers or more show it
};

// `prediction` is where the camera is expected, with its covariance; its squared error is not used. Throws
// InputError where the image has another size than the calibration's, and as checkCalibration does.
MarkerFix markerFix(const GreyImage& image, const MarkerLayout& layout,
                    const CameraCalibration& calibration, const MarkerPoseOptions& options,
                    const std::optional<PoseEstimate>& prediction = {});

// The same of markers that were found already, in pixels with distortion.
MarkerFix fixOf(const std::vector<DetectedMarker>& markers, const MarkerLayout& layout,
                const CameraCalibration& calibration, const MarkerPoseOptions& options,
                const std::optional<PoseEstimate>& prediction = {});

}  // namespace grid_path_planner::vision
