// How far the heading of the IMU was off, kept for a vehicle_localizer that was ended and starts again.
//
//   KeptHeading kept(folder, private_nh.getNamespace());
//   if (const auto heading = kept.begin()) localizer.beginWith(*heading);
//   if (kept.isDue()) kept.keep(known);
//
// The heading of a plain IMU drifts by radians in minutes. A pose that begins with positions alone takes its heading
// from it, which is right at the start of a mission only.
//
// A file of one line below the folder, with the run (the roscore's /run_id), is written by a thread of its own every
// two seconds at most. One of another run is not begun with.
#pragma once

#include <ros/time.h>

#include <optional>
#include <string>

#include "grid_path_planner/base/task_queue.h"
#include "localization/measurement.h"
#include "ros/guard/guarded_queue.h"

namespace grid_path_planner::nodes {

// The line of a file, and what such a line says; none for one of another run, or with numbers that cannot be.
std::string lineOf(const localization::KnownHeading& heading, const std::string& run);
std::optional<localization::KnownHeading> headingIn(const std::string& line,
                                                    const std::string& run);

// What is still known when ROS time went back by `back` s to `now`. A step of the wall clock leaves the vehicle and its IMU as
// they were: the same, as old as before. With /clock (`is_simulated`) a bag begins anew: nothing.
std::optional<localization::KnownHeading> headingAfterStep(
    const std::optional<localization::KnownHeading>& heading, double back, localization::Stamp now,
    bool is_simulated);

class KeptHeading {
 public:
  // Asks the master for the run. `folder` need not exist; `node` is the node's full name.
  KeptHeading(const std::string& folder, const std::string& node);

  // That of this run; none where there is no file of it. Says what was found.
  std::optional<localization::KnownHeading> begin() const;
  // Whether the last one was written long enough ago, under a known run.
  bool isDue() const;
  // Has it written, under a known run.
  void keep(const localization::KnownHeading& heading);
  // The file is gone when this returns.
  void forget();

 private:
  void write(const std::string& line) const;

  std::string run_;  // "": unknown, then nothing is written
  std::string folder_, file_;
  ros::SteadyTime kept_;
  base::TaskQueue writer_{
      [](const std::string& error) { tellGivenUp("Keeping the heading", error); }};
};

}  // namespace grid_path_planner::nodes
