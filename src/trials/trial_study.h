// A study of localization: a vehicle before a panel with markers, its sensors, and the rows of a table, each
// the filter with other inputs.
//
//   const TrialStudy study = readTrialFile("config/localization_trial.yaml");
//
// An *error set* is what the sensors do that the filter is not told of. A *run* is one error set with one seed,
// which draws all noise; all rows of a run see the same measurements.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "localization/filter_options.h"
#include "simulation/camera/image_camera_options.h"
#include "simulation/sensors/navigation_sensor_options.h"
#include "vision/marker_pose_options.h"

namespace grid_path_planner::trials {

// Seconds since the begin of the drive.
struct TimeWindow {
  double from = 0.0;
  double to = 0.0;

  bool holds(double t) const { return from <= t && t < to; }
};

// Along an arc before the panel, facing it, but for windows in which the vehicle looks away.
struct DriveOptions {
  double seconds = 300.0;
  double arc = 0.8;                        // rad, to each side
  double nearest = 1.7, farthest = 3.3;    // m from the panel's middle
  double arc_period = 100.0;               // s, there and back
  double range_period = 70.0;              // s
  double rise = 0.25, rise_period = 40.0;  // m, s
  double rock = 0.03, rock_period = 6.0;   // rad, s: roll; pitch is half of it
  double away_turn = 2.1;                  // rad
  double away_ramp = 6.0;                  // s, of the turn within the window
  std::vector<TimeWindow> away = {{90.0, 122.0}, {200.0, 232.0}};
};

// What the filter is not told of.
struct ErrorSet {
  std::string name;
  simulation::NavigationSensorOptions sensors;
  double camera_offset = 0.0;  // m, of the camera from where it is said to be
  double camera_turn = 0.0;    // rad
  double focal_error = 0.0;    // share of the focal length
  double camera_clock = 0.0;   // s, by which images are stamped late
  double corner_noise = 0.0;   // pixels, added to each coordinate of a corner
};

// Standard deviations of a marker pose that are stated instead of its own.
struct StatedDeviation {
  double metres = 0.0;
  double radians = 0.0;
};

// Of one row; as published, mean and spread.
struct PublishedRow {
  double metres = 0.0, metres_spread = 0.0;
  double degrees = 0.0, degrees_spread = 0.0;
  double smoothness = 0.0;  // m_A
};

// What the rows of any trial are played with.
struct TrialSettings {
  localization::FilterOptions filter;
  double settle = 10.0;               // s, not measured
  TimeWindow fault = {130.0, 160.0};  // of the rows in which an input is lost
  double start_deviation = 0.05;      // m, of the pose that is set at the start
  StatedDeviation default_covariance = {0.02, 0.0174533};
  StatedDeviation published_covariance = {0.126, 0.0802851};
  std::string published_source;
  std::map<std::string, PublishedRow> published;  // by row
};

struct TrialStudy : TrialSettings {
  std::string file;
  std::string title;
  std::string world;   // SDF
  std::string layout;  // of the markers
  Eigen::Isometry3d map_from_panel = Eigen::Isometry3d::Identity();
  DriveOptions drive;
  int first_seed = 1;
  int seeds = 50;
  double outliers = 0.3;  // share of USBL, of the row with many
  double flips = 0.1;     // share of marker poses
  double current = 0.05;  // m/s, standard deviation of what the command does not tell, each axis
  simulation::ImageCameraOptions camera;
  vision::MarkerPoseOptions markers;
  std::vector<ErrorSet> sets;                       // the first as modelled
  std::map<std::string, double> published_figures;  // by name
};

// File names in it are relative to its folder. Throws InputError naming file and line.
TrialStudy readTrialFile(const std::string& file);

}  // namespace grid_path_planner::trials
