#include "vision/marker_pose.h"

#include <algorithm>
#include <cmath>

#include "base/cholesky.h"
#include "grid_path_planner/base/decimal_text.h"
#include "vision/mean_pose.h"
#include "vision/pose_candidates.h"
#include "vision/pose_refinement.h"

namespace grid_path_planner::vision {

namespace {

constexpr std::size_t kEnoughToJudge = 3;  // markers

std::string pixels(double distance) {
  return base::decimalText(std::round(10.0 * distance) / 10.0) + " px";
}

void addViews(const std::vector<DetectedMarker>& markers, const MarkerLayout& layout,
              const CameraCalibration& calibration, MarkerFix& fix) {
  for (const DetectedMarker& marker : markers) {
    if (!layout.has(marker.id)) {
      ++fix.unknown;
      continue;
    }
    MarkerView view{marker.id, layout.cornersOf(marker.id), {}};
    for (int i = 0; i < 4; ++i) view.corners[i] = calibration.undistorted(marker.corners[i]);
    fix.views.push_back(view);
  }
}

double rootMeanSquare(const PoseEstimate& pose, std::size_t markers) {
  return std::sqrt(pose.squared_error / (4.0 * static_cast<double>(markers)));
}

// The marker without which the others fit, and how well; none where they do not fit without any single one.
std::optional<std::pair<int, double>> outlierOf(const MarkerViews& views,
                                                const MarkerLayout& layout,
                                                const CameraCalibration& calibration,
                                                const MarkerPoseOptions& options) {
  std::optional<std::pair<int, double>> outlier;
  for (std::size_t i = 0; i < views.size(); ++i) {
    MarkerViews others = views;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const auto poses = jointPoses(others, layout, calibration, options.pixel_noise);
    if (poses.empty()) continue;
    const double residual = rootMeanSquare(poses.front(), others.size());
    if (residual <= options.max_residual && !(outlier && outlier->second <= residual))
      outlier = {views[i].id, residual};
  }
  return outlier;
}

// What does not fit together, or "".
std::string misfit(const MarkerFix& fix, const MarkerLayout& layout,
                   const CameraCalibration& calibration, const MarkerPoseOptions& options) {
  if (fix.views.size() < kEnoughToJudge || options.method == PoseMethod::MEAN) return "";
  const double residual = rootMeanSquare(fix.candidates.front(), fix.views.size());
  if (residual <= options.max_residual) return "";
  const std::string text = "calibration or layout is off: " + std::to_string(fix.views.size()) +
                           " markers lie " + pixels(residual) + " from where one pose has them";
  const auto outlier = outlierOf(fix.views, layout, calibration, options);
  if (!outlier) return text;
  return text + ", without marker " + std::to_string(outlier->first) + " " +
         pixels(outlier->second);
}

double distance(const PoseEstimate& pose, const PoseEstimate& prediction) {
  const Vector6 difference = differenceOf(pose.panel_from_camera, prediction.panel_from_camera);
  const Matrix6 covariance = pose.covariance + prediction.covariance;
  return base::Cholesky<6>(covariance).squaredMahalanobis(difference);
}

// The one candidate that is left, with what the prediction says. Deviations are in variances: of the corners from
// each pose, and of each pose from the prediction.
void choose(const std::vector<double>& misfits, const std::vector<double>& distances, double limit,
            MarkerFix& fix) {
  const auto best =
      static_cast<std::size_t>(std::min_element(misfits.begin(), misfits.end()) - misfits.begin());
  for (std::size_t i = 0; i < misfits.size(); ++i)
    if (i != best && misfits[i] - misfits[best] < limit) {
      fix.reason = "the corners admit two poses, and the prediction fits both";
      return;
    }
  if (!distances.empty() && distances[best] > kPoseGate)
    fix.reason = "the corners admit two poses, and the prediction fits neither";
  else
    fix.pose = fix.candidates[best];
}

void decide(const MarkerLayout& layout, const CameraCalibration& calibration,
            const MarkerPoseOptions& options, const std::optional<PoseEstimate>& prediction,
            MarkerFix& fix) {
  std::vector<PoseEstimate>& candidates = fix.candidates;
  const double variance = varianceOf(candidates.front(), fix.views.size(), options.pixel_noise);
  const double ruled_out = candidates.front().squared_error + options.ambiguity_limit * variance;
  candidates.erase(
      std::remove_if(candidates.begin(), candidates.end(),
                     [&](const PoseEstimate& pose) { return pose.squared_error > ruled_out; }),
      candidates.end());
  if (options.method == PoseMethod::JOINT &&
      admitPosesBetween(fix.views, layout, calibration, candidates, variance,
                        options.ambiguity_limit)) {
    fix.reason = "the corners admit all poses between two";
    return;
  }
  if (candidates.size() > 1 && !prediction) {
    fix.reason = "the corners admit two poses, and there is no prediction";
    return;
  }
  std::vector<double> misfits, distances;
  for (const PoseEstimate& pose : candidates) {
    misfits.push_back(pose.squared_error / variance);
    if (candidates.size() == 1) continue;
    distances.push_back(distance(pose, *prediction));
    misfits.back() += distances.back();
  }
  choose(misfits, distances, options.ambiguity_limit, fix);
}

}  // namespace

MarkerFix markerFix(const GreyImage& image, const MarkerLayout& layout,
                    const CameraCalibration& calibration, const MarkerPoseOptions& options,
                    const std::optional<PoseEstimate>& prediction) {
  checkCalibration(calibration);
  checkSameSize(image.width, image.height, calibration);
  return fixOf(detectMarkers(image, options), layout, calibration, options, prediction);
}

MarkerFix fixOf(const std::vector<DetectedMarker>& markers, const MarkerLayout& layout,
                const CameraCalibration& calibration, const MarkerPoseOptions& options,
                const std::optional<PoseEstimate>& prediction) {
  MarkerFix fix;
  addViews(markers, layout, calibration, fix);
  if (fix.views.empty()) {
    fix.reason = "no marker of the layout is seen";
    return fix;
  }
  fix.candidates = options.method == PoseMethod::JOINT
                       ? jointPoses(fix.views, layout, calibration, options.pixel_noise)
                       : meanPose(fix.views, layout, calibration, options);
  if (fix.candidates.empty())
    fix.reason = "the markers' corners are those of no squares";
  else if (fix.reason = misfit(fix, layout, calibration, options); !fix.reason.empty())
    fix.fits = false;
  else
    decide(layout, calibration, options, prediction, fix);
  return fix;
}

}  // namespace grid_path_planner::vision
