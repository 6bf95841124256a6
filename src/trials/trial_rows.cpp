#include "trials/trial_rows.h"

#include <stdexcept>

namespace grid_path_planner::trials {

using localization::Gate, localization::Source;

namespace {

using Sources = std::set<Source>;

const Sources kInsDvl = {Source::IMU, Source::DVL};
const Sources kInsDepth = {Source::IMU, Source::DVL, Source::DEPTH};

// As published, and variations of that.
std::vector<TrialRow> publishedRows() {
  constexpr auto kMean = Method::MEAN;
  constexpr auto kStated = MarkerCovariance::PUBLISHED;
  return {
      {"L1", "markers alone", {}, UsblKind::NONE, kMean, kStated, Gate::NONE},
      {"L1 joint",
       "markers alone, joint poses",
       {},
       UsblKind::NONE,
       Method::JOINT,
       MarkerCovariance::OWN,
       Gate::NONE},
      {"L2", "IMU, DVL", kInsDvl},
      {"L3", "L2, markers with the default covariance", kInsDvl, UsblKind::NONE, kMean,
       MarkerCovariance::DEFAULT, Gate::NONE},
      {"L4", "L2, markers with the published covariance", kInsDvl, UsblKind::NONE, kMean, kStated,
       Gate::NONE},
      {"L5", "L4, gate: either", kInsDvl, UsblKind::NONE, kMean, kStated, Gate::EITHER},
      {"L5 both", "L4, gate: both", kInsDvl, UsblKind::NONE, kMean, kStated, Gate::BOTH},
      {"L5 joint", "L5, joint poses with their own covariance", kInsDvl, UsblKind::NONE,
       Method::JOINT, MarkerCovariance::OWN, Gate::EITHER},
      {"L5 USBL", "L5 and USBL", kInsDvl, UsblKind::USUAL, kMean, kStated, Gate::EITHER},
      {"L5 heading",
       "L5 and the heading of the INS",
       {Source::IMU, Source::DVL, Source::HEADING},
       UsblKind::NONE,
       kMean,
       kStated,
       Gate::EITHER},
  };
}

// For the goals: the filter as it is shipped, gated by chi squared unless said.
std::vector<TrialRow> goalRows() {
  constexpr auto kJoint = Method::JOINT;
  constexpr auto kOwn = MarkerCovariance::OWN;
  constexpr auto kGate = Gate::CHI_SQUARED;
  return {
      {"all", "IMU, DVL, depth, USBL, joint poses", kInsDepth, UsblKind::USUAL, kJoint},
      {"USBL clean", "IMU, DVL, depth, USBL without outliers", kInsDepth, UsblKind::CLEAN},
      {"USBL outliers", "the same with outliers", kInsDepth, UsblKind::MANY_OUTLIERS},
      {"USBL ungated",
       "the same, no gate",
       kInsDepth,
       UsblKind::MANY_OUTLIERS,
       {},
       kOwn,
       Gate::NONE},
      {"joint", "IMU, DVL, depth, joint poses", kInsDepth, UsblKind::NONE, kJoint},
      {"joint flipped", "the same, some flipped", kInsDepth, UsblKind::NONE, kJoint, kOwn, kGate,
       true},
      {"joint flipped ungated", "the same, no gate", kInsDepth, UsblKind::NONE, kJoint, kOwn,
       Gate::NONE, true},
      {"camera black",
       "joint, no images for a while",
       kInsDepth,
       UsblKind::NONE,
       kJoint,
       kOwn,
       kGate,
       false,
       {Source::MARKER}},
      {"DVL out, USBL",
       "USBL clean, no DVL for a while",
       kInsDepth,
       UsblKind::CLEAN,
       {},
       kOwn,
       kGate,
       false,
       {Source::DVL}},
      {"DVL out, nothing",
       "the same, nor USBL",
       kInsDepth,
       UsblKind::CLEAN,
       {},
       kOwn,
       kGate,
       false,
       {Source::DVL, Source::USBL}},
      {"DVL out, cmd_vel",
       "the same with cmd_vel",
       {Source::IMU, Source::DVL, Source::DEPTH, Source::COMMAND},
       UsblKind::CLEAN,
       {},
       kOwn,
       kGate,
       false,
       {Source::DVL, Source::USBL}},
  };
}

}  // namespace

const std::vector<TrialRow>& trialRows() {
  static const std::vector<TrialRow> rows = [] {
    std::vector<TrialRow> all = publishedRows();
    for (const TrialRow& row : goalRows()) all.push_back(row);
    return all;
  }();
  return rows;
}

const std::vector<TrialRow>& recordedRows() {
  static const std::vector<TrialRow> rows = [] {
    std::vector<TrialRow> all = publishedRows();
    all.push_back({"joint", "IMU, DVL, depth, markers", kInsDepth, UsblKind::NONE, Method::JOINT});
    all.push_back({"USBL", "IMU, DVL, depth, USBL", kInsDepth, UsblKind::USUAL});
    all.push_back(
        {"all", "IMU, DVL, depth, USBL, markers", kInsDepth, UsblKind::USUAL, Method::JOINT});
    for (TrialRow& row : all)
      if (row.markers) row.markers = Method::MEAN;
    return all;
  }();
  return rows;
}

std::size_t rowNumber(const std::string& name) {
  for (std::size_t i = 0; i < trialRows().size(); ++i)
    if (trialRows()[i].name == name) return i;
  throw std::out_of_range("there is no row '" + name + "'");
}

}  // namespace grid_path_planner::trials
