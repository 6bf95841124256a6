// One row of one run: the filter played a tape, and how far it was off.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "trials/pose_errors.h"
#include "trials/sensor_tape.h"
#include "trials/trial_rows.h"
#include "trials/trial_study.h"

namespace grid_path_planner::trials {

// Over time. NaN where there was nothing to compare.
struct ErrorSpread {
  double metres = NAN, metres_deviation = NAN;
  double degrees = NAN, degrees_deviation = NAN;
  int count = 0;
};

// Normalised innovations squared of a source.
struct NisMean {
  double mean = 0.0;
  int count = 0;
};

constexpr std::array<double, 3> kRpeLengths = {1.0, 5.0, 10.0};  // m
constexpr std::array<localization::Source, 4> kNisSources = {
    localization::Source::DVL, localization::Source::DEPTH, localization::Source::USBL,
    localization::Source::MARKER};

// A figure that nothing was seen of is NaN.
struct RowResult {
  ErrorSpread markers;               // while an image gives a pose: against that pose
  ErrorSpread in_view;               // at the same times, against the truth
  ErrorSpread all;                   // at all times, against the truth
  double smoothness = NAN;           // m_A
  double position_smoothness = NAN;  // the same of the positions themselves
  double ate = NAN;                  // m
  std::array<std::optional<PoseError>, kRpeLengths.size()> rpe;
  std::vector<double> nees, pose_nees;  // each second, of 15 and of 6
  std::array<NisMean, kNisSources.size()> nis;
  int gated = 0, resets = 0;         // of fixes
  PoseError fault_end = {NAN, NAN};  // at the end of the window of faults
  double fault_nees = NAN;           // then, of 15
};

// Where the truth is not known, there is none of it.
struct RunTracks {
  PoseTrack estimate, truth;
};

// `tracks`: filled unless null.
RowResult played(const TrialSettings& study, const TrialRow& row, const SensorTape& tape,
                 RunTracks* tracks = nullptr);

// Normalised estimation errors squared, of all 15 and of the pose's 6.
struct Nees {
  double all = 0.0;
  double pose = 0.0;
};
Nees neesOf(const localization::Estimate& estimate, const localization::State& truth);

}  // namespace grid_path_planner::trials
