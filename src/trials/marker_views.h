// What rendered images of the drive show: the poses that their markers give, by each method.
//
//   const ViewRenderer renderer(study, world);
//   const SeenFrame frame = renderer.look(17, Water::TURBID);
//   if (frame.solutions[0].joint) use(frame.solutions[0].joint->camera);
//
// Guaranteed: the same study, frame and water give the same poses, bit for bit.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/simulation/world.h"
#include "simulation/camera/image_camera.h"
#include "trials/panel_drive.h"
#include "trials/pose_errors.h"
#include "trials/trial_study.h"
#include "vision/marker_pose.h"

namespace grid_path_planner::trials {

enum class Water { CLEAR, TURBID };  // E0, E*

// A pose of the camera's optical frame in the panel's.
struct CameraPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
};

struct JointPose {
  CameraPose camera;
  vision::Matrix6 covariance = vision::Matrix6::Zero();  // as PoseEstimate's
};

// Of the panel in the map, with the vehicle's pose known.
struct PanelErrors {
  PoseError mean;        // positions averaged, eigenvector mean of the attitudes
  PoseError sequential;  // the same positions, attitudes by slerp one after another
  std::optional<PoseError> joint;
};

// By one error set's calibration and noise.
struct ViewSolution {
  int markers = 0;
  std::optional<CameraPose> mean;  // none: no marker was seen
  std::optional<JointPose> joint;  // none: ambiguous, or the markers do not fit together
  PanelErrors panel;
};

struct SeenFrame {
  int frame = 0;
  Water water = Water::TURBID;
  std::vector<ViewSolution> solutions;  // one for each error set
};

// How many images the drive has, and when.
int frameCount(const TrialStudy& study);
double frameTime(const TrialStudy& study, int frame);

// Slerp of the mean so far and the next, by 1/2, 1/3, ... Precondition: at least one.
Eigen::Quaterniond sequentialMean(const std::vector<Eigen::Quaterniond>& attitudes);

class ViewRenderer {
 public:
  // `study` outlives this.
  ViewRenderer(const TrialStudy& study, const simulation::World& world);

  SeenFrame look(int frame, Water water) const;

  // Where the camera truly is at the frame.
  Eigen::Isometry3d panelFromCamera(int frame) const;

 private:
  ViewSolution solve(const ErrorSet& set, std::vector<vision::DetectedMarker> markers, int frame,
                     Water water) const;
  PanelErrors panelErrors(const std::vector<CameraPose>& each, const ViewSolution& solution,
                          int frame) const;

  const TrialStudy& study_;
  PanelDrive drive_;
  vision::MarkerLayout layout_;
  vision::CameraCalibration calibration_;
  simulation::ImageCamera clear_, turbid_;
};

}  // namespace grid_path_planner::trials
