// What navigation sensors said in a bag, as vehicle_localizer understands it.
//
//   NavigationQuestion question;
//   question.topics.imu = "rexrov/imu";
//   const localization::NavigationRecording recording = readNavigationBag("dive.bag", question, longReading());
//
// Guaranteed: a message that vehicle_localizer would refuse when the bag is played with --clock is refused, counted,
// and its reason kept. Where sensors are is told by the bag's transforms, or by the question.
#pragma once

#include <map>
#include <string>

#include "grid_path_planner/base/read_limits.h"
#include "localization/recording/navigation_recording.h"
#include "ros/localization/vehicle_localizer_options.h"

namespace grid_path_planner::nodes {

struct NavigationQuestion {
  localization::NavigationTopics topics;
  std::string truth_frame;                               // of a truth that is in tf, "" for none
  std::map<std::string, localization::Mounting> frames;  // in base_frame
  VehicleLocalizerOptions options;
};

// Throws InputError naming the file where it is no bag or damaged, needs more than `limits`, has other types on these
// topics, or goes back in time.
localization::NavigationRecording readNavigationBag(const std::string& file,
                                                    const NavigationQuestion& question,
                                                    const base::ReadLimits& limits);

}  // namespace grid_path_planner::nodes
