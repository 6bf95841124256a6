// What a study of localization found, by error set and row.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "trials/trial_record.h"
#include "trials/trial_rows.h"
#include "trials/trial_study.h"

namespace grid_path_planner::trials {

struct MeanAndSpread {
  double mean = NAN;
  double deviation = NAN;       // of the runs about their mean
  double standard_error = NAN;  // of the mean; of one run it is not known, and 0
};

// NaN of no values.
MeanAndSpread meanOf(const std::vector<double>& values);

struct TrialData {
  const TrialStudy& study;
  std::vector<SeenFrame> frames;
  std::vector<RunRecord> runs;
  std::size_t missing = 0;  // units that were not done

  // Whether each error set has the run with the images' own poses, and two others.
  bool canBeReported() const;
  // A figure of a row, of each seed in which there is one (no NaN); the run with the images' own poses is none of them.
  std::vector<double> figures(std::size_t set, std::size_t row,
                              const std::function<double(const RowResult&)>& figure) const;
  MeanAndSpread mean(std::size_t set, std::size_t row,
                     const std::function<double(const RowResult&)>& figure) const;
  // That with the images' own poses.
  const RowResult& shown(std::size_t set, std::size_t row) const;
  // The error set of this name, or the first.
  std::size_t setNamed(const std::string& name) const;
  bool hasSet(const std::string& name) const;
};

// Mean NEES of the runs at each second, and the share of seconds in which it is inside its 95 % bounds. NaN where
// there is no second that all runs with any have.
struct Consistency {
  double mean = NAN, pose_mean = NAN;
  double inside = NAN, pose_inside = NAN;  // shares
};
Consistency consistencyOf(const TrialData& data, std::size_t set, std::size_t row);

}  // namespace grid_path_planner::trials
