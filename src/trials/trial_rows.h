// The rows of the table: what the filter is given in each, and what it is told of that.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "localization/measurement.h"
#include "trials/marker_errors.h"
#include "trials/trial_study.h"

namespace grid_path_planner::trials {

// Which of the simulated acoustic fixes.
enum class UsblKind { NONE, CLEAN, USUAL, MANY_OUTLIERS };

// What is stated of a marker pose.
enum class MarkerCovariance { OWN, DEFAULT, PUBLISHED };

struct TrialRow {
  std::string name;                             // "L4"
  std::string inputs;                           // a few words
  std::set<localization::Source> sources = {};  // of IMU, DVL, DEPTH, HEADING, COMMAND
  UsblKind usbl = UsblKind::NONE;
  std::optional<Method> markers = {};
  MarkerCovariance covariance = MarkerCovariance::OWN;
  localization::Gate gate = localization::Gate::CHI_SQUARED;
  bool flips = false;
  std::set<localization::Source> lost = {};  // in the study's window of faults
};

const std::vector<TrialRow>& trialRows();
// Those for which a recording may have what they need; its marker poses are of one method.
const std::vector<TrialRow>& recordedRows();
// By name; throws std::out_of_range.
std::size_t rowNumber(const std::string& name);

}  // namespace grid_path_planner::trials
