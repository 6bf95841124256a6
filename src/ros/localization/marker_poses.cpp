#include "ros/localization/marker_poses.h"

#include <cmath>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "localization/measurement_check.h"
#include "ros/guard/network_text.h"
#include "ros/localization/camera_messages.h"
#include "ros/localization/inputs/vehicle_frames.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::StopToken;
using Eigen::Isometry3d;
using localization::PoseCovariance;
using vision::GreyImage;
using vision::MarkerFix;
using vision::PoseEstimate;

namespace {

constexpr double kFarthest = 1e6;  // m

// The optical frame of the image in the vehicle's, of which tf says the newest that it knows: it is fixed.
Isometry3d baseFromCamera(const MarkerImage& image, const FrameTransforms& transforms,
                          const StopToken& stop) {
  const MarkerLocalizerOptions& o = image.options;
  checkNetworkText("its frame", image.message->header.frame_id);
  const std::string frame = frameName(image.message->header.frame_id);
  if (frame.empty()) throw InputError("it names no frame");
  if (frame == o.base_frame) return Isometry3d::Identity();
  const Isometry3d mounting = mountingIn(transforms, o.base_frame, frame, o.prediction_wait, stop);
  localization::checkMounting({mounting.translation(), Eigen::Quaterniond(mounting.linear())});
  // Through the map it would be where tf has the vehicle, and confirm whatever that is.
  checkOnVehicle(transforms, o.base_frame, frame, {o.map_frame, o.odom_frame});
  return mounting;
}

// tf at the image's stamp. Throws TransformError, InputError for a place out of this world.
Isometry3d mapFromBase(const MarkerImage& image, const FrameTransforms& transforms,
                       const StopToken& stop) {
  const MarkerLocalizerOptions& o = image.options;
  std_msgs::Header vehicle;
  vehicle.frame_id = o.base_frame;
  vehicle.stamp = image.message->header.stamp;
  Placing by{o.map_frame, 0.0, Moving::AT_STAMP};
  by.wait = o.prediction_wait;
  by.stop = stop;
  const Isometry3d pose = transforms.place(vehicle, by).pose;
  if (!(pose.translation().cwiseAbs().maxCoeff() <= kFarthest))
    throw InputError("tf has the vehicle farther than 1e6 m from the map's origin");
  return pose;
}

PoseEstimate predictionOf(const MarkerLocalizerOptions& o, const Isometry3d& panel_from_camera) {
  const double angle = o.prediction_angle * M_PI / 180.0;
  PoseEstimate prediction;
  prediction.panel_from_camera = panel_from_camera;
  prediction.covariance.diagonal().head<3>().setConstant(o.prediction_deviation *
                                                         o.prediction_deviation);
  prediction.covariance.diagonal().tail<3>().setConstant(angle * angle);
  return prediction;
}

// The vehicle's pose in the map by the camera's before the panel.
localization::MountedPose baseInMap(const Isometry3d& map_from_panel, const PoseEstimate& pose,
                                    const Isometry3d& base_from_camera) {
  const Isometry3d map_from_camera = map_from_panel * pose.panel_from_camera;
  PoseCovariance turn = PoseCovariance::Identity();
  turn.topLeftCorner<3, 3>() = map_from_panel.linear();
  const localization::MountedPose camera{map_from_camera.translation(),
                                         Eigen::Quaterniond(map_from_camera.linear()),
                                         turn * pose.covariance * turn.transpose()};
  const Isometry3d camera_from_base = base_from_camera.inverse();
  return localization::carried(
      camera, {camera_from_base.translation(), Eigen::Quaterniond(camera_from_base.linear())});
}

// Asks the prediction where the corners admit several poses.
void chooseByPrediction(const MarkerImage& image, const vision::MarkerLayout& layout,
                        const FrameTransforms& transforms, const Isometry3d& base_from_camera,
                        const StopToken& stop, MarkerAnswer& answer) {
  try {
    const Isometry3d map_from_camera = mapFromBase(image, transforms, stop) * base_from_camera;
    const PoseEstimate prediction =
        predictionOf(image.options, image.panel->map_from_panel.inverse() * map_from_camera);
    answer.fix =
        fixOf(answer.markers, layout, image.calibration, image.options.markers, prediction);
  } catch (const std::runtime_error& error) {
    answer.fix.reason += ": " + std::string(error.what());
  }
}

// What the image says of the panel, where tf says where the vehicle is.
void sight(const MarkerImage& image, const FrameTransforms& transforms,
           const Isometry3d& base_from_camera, const StopToken& stop, MarkerAnswer& answer) {
  answer.reason = "nobody knows where the panel is yet: see panel_known and ~learn_panel";
  try {
    answer.sighting = vision::sightingOf(image.message->header.stamp.toSec(),
                                         mapFromBase(image, transforms, stop), base_from_camera,
                                         *answer.fix.pose);
  } catch (const std::runtime_error& error) {
    answer.reason += "; " + std::string(error.what());
  }
}

}  // namespace

GreyImage greyImageOf(const MarkerImage& image, const MarkerAnswer& answer) {
  return {answer.grey.data(), static_cast<int>(image.message->width),
          static_cast<int>(image.message->height), image.message->width};
}

MarkerAnswer answerOf(const MarkerImage& image, const vision::MarkerLayout& layout,
                      const FrameTransforms& transforms, const StopToken& stop) {
  MarkerAnswer answer;
  answer.grey = vision::greyPixels(encodedImageOf(*image.message));
  const GreyImage grey = greyImageOf(image, answer);
  vision::checkSameSize(grey.width, grey.height, image.calibration);
  const Isometry3d base_from_camera = baseFromCamera(image, transforms, stop);
  answer.markers = detectMarkers(grey, image.options.markers);
  answer.fix = fixOf(answer.markers, layout, image.calibration, image.options.markers);
  if (!answer.fix.pose && answer.fix.fits && answer.fix.candidates.size() > 1 && image.panel)
    chooseByPrediction(image, layout, transforms, base_from_camera, stop, answer);
  if (!answer.fix.pose)
    answer.reason = answer.fix.reason;
  else if (image.panel)
    answer.base = baseInMap(image.panel->map_from_panel, *answer.fix.pose, base_from_camera);
  else
    sight(image, transforms, base_from_camera, stop, answer);
  return answer;
}

}  // namespace grid_path_planner::nodes
