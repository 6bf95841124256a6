// From an image to the pose of the vehicle, or of the panel while nobody knows where it is.
//
//   const MarkerAnswer answer = answerOf(image, layout, transforms, stop);
//   if (answer.base) publish(*answer.base); else tell(answer.reason);
//
// The prediction is tf map_frame -> base_frame at the image's stamp. It is asked for, and waited for, only where
// the corners alone do not tell which pose it is, or the panel is to be learnt: before there is a localisation
// nothing waits for one.
#pragma once

#include <sensor_msgs/Image.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "localization/mounted_pose.h"
#include "ros/input/frame_lookup.h"
#include "ros/localization/marker_localizer_options.h"
#include "vision/marker_pose.h"
#include "vision/panel_learning.h"

namespace grid_path_planner::nodes {

// An image, and what was in force when it came.
struct MarkerImage {
  sensor_msgs::ImageConstPtr message;
  vision::CameraCalibration calibration;
  MarkerLocalizerOptions options;
  std::optional<vision::PanelPose> panel;
};

struct MarkerAnswer {
  std::vector<std::uint8_t> grey;  // the image
  std::vector<vision::DetectedMarker> markers;
  vision::MarkerFix fix;
  std::optional<localization::MountedPose> base;  // of base_frame in map_frame
  std::optional<vision::PanelSighting> sighting;  // while the panel's pose is not known
  std::string reason;                             // why there is no pose of the vehicle
};

// The image in grey, as long as the answer.
vision::GreyImage greyImageOf(const MarkerImage& image, const MarkerAnswer& answer);

// Throws InputError for an image that cannot be used, TransformError where tf does not know the camera, Stopped.
MarkerAnswer answerOf(const MarkerImage& image, const vision::MarkerLayout& layout,
                      const FrameTransforms& transforms, const base::StopToken& stop);

}  // namespace grid_path_planner::nodes
