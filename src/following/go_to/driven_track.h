// Where a vehicle has been lately, to drive back.
//
//   DrivenTrack track;
//   track.add(pose);                                  // at any rate
//   const path::Path back = track.back(pose, 1.0);    // the last metre, driven astern
//
// Guaranteed: memory for the last kLongest metres, however long the drive; the poses to drive back along are poses that
// the vehicle had, so it is as free as it was then. Poses that are not finite are passed over.
#pragma once

#include <deque>

#include "grid_path_planner/path/path.h"

namespace grid_path_planner::following {

class DrivenTrack {
 public:
  static constexpr double kSpacing = 0.1;   // m, between kept poses
  static constexpr double kLongest = 50.0;  // m

  // One farther than kJump metres from the last begins anew: the vehicle was carried, or its localization jumped.
  static constexpr double kJump = 2.0;
  void add(const path::Pose& pose);
  void clear() { poses_.clear(); }

  // The poses of the last `length` metres, latest first, with the headings that they had; empty where less than kSpacing
  // is known. `from` is the vehicle's pose now.
  path::Path back(const path::Pose& from, double length) const;

 private:
  std::deque<path::Pose> poses_;  // oldest first
};

}  // namespace grid_path_planner::following
