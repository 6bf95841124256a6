// What navigation sensors said on a dive, as measurements of the filter, and the truth where somebody knows it.
//
//   for (const HeardMeasurement& heard : recording.measurements) use(heard.arrives, heard.measurement);
//
// The body frame is the IMU's.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "localization/measurement.h"

namespace grid_path_planner::localization {

// On which topics the sensors are, as vehicle_localizer names them.
struct NavigationTopics {
  std::string imu = "imu/data";
  std::string dvl = "dvl/twist";
  std::string depth = "depth";
  std::string pressure = "pressure";
  std::string usbl = "usbl/pose";
  std::string marker = "marker_pose";
  std::string truth = "ground_truth";
};

struct HeardMeasurement {
  Stamp arrives = 0;  // its stamp; of acoustic fixes, which are late: when they were received
  Measurement measurement;
};

// Of the body in the map.
struct TruePose {
  Stamp stamp = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
};

// Of one topic.
struct HeardInput {
  std::string topic;
  std::size_t heard = 0, refused = 0;
  std::string reason;  // why the last that was refused was, or why there is none

  std::size_t used() const { return heard - refused; }
};

struct NavigationRecording {
  std::vector<HeardMeasurement> measurements;  // by arrival
  Mounting base;                               // base_link in the body frame
  std::vector<TruePose> truth;                 // by stamp
  std::map<Source, HeardInput> inputs;
  HeardInput truth_input;
};

}  // namespace grid_path_planner::localization
