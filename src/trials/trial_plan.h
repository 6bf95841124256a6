// The work of a trial's study in order, by number: first the images, some at a time, then the runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/fingerprint.h"
#include "trials/marker_views.h"
#include "trials/trial_study.h"

namespace grid_path_planner::trials {

struct TrialUnit {
  bool renders = false;
  Water water = Water::TURBID;  // of one that renders
  int first_frame = 0, frames = 0;
  std::size_t set = 0;  // of a run
  int seed = 0;         // kShownSeed: with the poses that the images showed
};

// Of a trial's file and of the sources of this room and those below, to which more may be added. Throws InputError
// where the file cannot be read.
study::Fingerprint fingerprintOf(const std::string& file);

class TrialPlan {
 public:
  explicit TrialPlan(TrialStudy study);

  const TrialStudy& study() const { return study_; }
  const std::vector<TrialUnit>& units() const { return units_; }
  std::size_t renderingUnits() const { return rendering_; }  // come first

  // "images 25 to 49 in turbid water", "field/7".
  std::string nameOf(const TrialUnit& unit) const;

  // A hash of the study, its world as it is read and its layout included, and of the sources that run it. Throws
  // InputError for a file that cannot be read.
  std::uint64_t fingerprint() const;

 private:
  TrialStudy study_;
  std::vector<TrialUnit> units_;
  std::size_t rendering_ = 0;
};

}  // namespace grid_path_planner::trials
