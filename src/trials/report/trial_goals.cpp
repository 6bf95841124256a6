#include <algorithm>

#include "localization/chi_squared.h"
#include "trials/report/trial_findings.h"

namespace grid_path_planner::trials {
namespace {

using Figure = double (*)(const RowResult&);

constexpr Figure kMetresInView = [](const RowResult& row) { return row.in_view.metres; };
constexpr Figure kDegreesInView = [](const RowResult& row) { return row.in_view.degrees; };
constexpr Figure kMetres = [](const RowResult& row) { return row.all.metres; };
constexpr Figure kDegrees = [](const RowResult& row) { return row.all.degrees; };
constexpr Figure kFaultMetres = [](const RowResult& row) { return row.fault_end.metres; };
constexpr Figure kNees = [](const RowResult& row) { return meanOf(row.nees).mean; };
constexpr Figure kPoseNees = [](const RowResult& row) { return meanOf(row.pose_nees).mean; };
constexpr Figure kFaultNees = [](const RowResult& row) { return row.fault_nees; };

class GoalList {
 public:
  explicit GoalList(const TrialData& data) : data_(data) {}

  double mean(const std::string& set, const char* row, Figure figure) const {
    return data_.mean(data_.setNamed(set), rowNumber(row), figure).mean;
  }
  void atMost(const std::string& name, double limit, const std::string& unit, double found) {
    goals_.push_back({name, "≤ " + study::shownNumber(limit), unit, found, {}, found <= limit});
  }
  // Of means of NEES.
  void within(const std::string& name, double low, double high, const MeanAndSpread& found) {
    goals_.push_back({name, study::shownNumber(low) + " to " + study::shownNumber(high), "",
                      found.mean, found.standard_error, low <= found.mean && found.mean <= high});
  }
  void atLeast(const std::string& name, double limit, double found) {
    goals_.push_back({name, "≥ " + study::shownNumber(limit), "", found, {}, found >= limit});
  }
  std::vector<Goal> goals() const { return goals_; }

 private:
  const TrialData& data_;
  std::vector<Goal> goals_;
};

void addPanel(const TrialData& data, GoalList& list) {
  const ErrorSpread mean = panelError(data, 0, Water::TURBID, PanelMethod::MEAN);
  const ErrorSpread joint = panelError(data, 0, Water::TURBID, PanelMethod::JOINT);
  list.atMost("T_P under E*, joint", 0.03, "m", joint.metres);
  list.atMost("T_P under E*, joint", 0.6, "°", joint.degrees);
  list.atMost("T_P under E*, joint over the mean over markers, m", 0.25, "",
              joint.metres / mean.metres);
  list.atMost("T_P under E*, joint over the mean over markers, °", 0.25, "",
              joint.degrees / mean.degrees);
}

void addAgainstTruth(const TrialData& data, GoalList& list) {
  for (const char* row : {"L1", "L1 joint"}) {
    const std::string name = std::string(row) + " while markers are in view";
    list.atMost(name, 0.1, "m", list.mean("nominal", row, kMetresInView));
    list.atMost(name, 1.0, "°", list.mean("nominal", row, kDegreesInView));
  }
  list.atMost("L5 joint against truth, nominal", 0.03, "m",
              list.mean("nominal", "L5 joint", kMetres));
  list.atMost("L5 joint against truth, nominal", 0.4, "°",
              list.mean("nominal", "L5 joint", kDegrees));
  if (!data.hasSet("field")) return;
  list.atMost("L5 joint against truth, field", 0.10, "m", list.mean("field", "L5 joint", kMetres));
  list.atMost("L5 joint against truth, field", 1.5, "°", list.mean("field", "L5 joint", kDegrees));
}

void addAnees(const TrialData& data, std::size_t set, const char* row, GoalList& list) {
  const std::size_t number = rowNumber(row);
  const std::string name = std::string("ANEES of ") + row + ", " + data.study.sets[set].name;
  list.within(name + ", 15 states", 13.5, 16.6, data.mean(set, number, kNees));
  list.within(name + ", pose", 5.1, 7.0, data.mean(set, number, kPoseNees));
  list.atLeast(name + ", seconds inside", 0.9, consistencyOf(data, set, number).inside);
}

void addConsistency(const TrialData& data, GoalList& list) {
  addAnees(data, 0, "all", list);
  addAnees(data, 0, "USBL clean", list);
  if (data.hasSet("coarse")) addAnees(data, data.setNamed("coarse"), "all", list);
}

void addFaults(const TrialData& data, GoalList& list) {
  const auto ratio = [&list](const char* row, const char* without) {
    return list.mean("nominal", row, kMetres) / list.mean("nominal", without, kMetres);
  };
  list.atMost("USBL outliers over the same without", 1.2, "", ratio("USBL outliers", "USBL clean"));
  list.atMost("flipped poses over the same without", 1.2, "", ratio("joint flipped", "joint"));
  const auto after = [&list](const char* row) { return list.mean("nominal", row, kFaultMetres); };
  list.atMost("camera black, at its end", 0.1, "m", after("camera black"));
  list.atMost("DVL out, USBL, at its end", 0.6, "m", after("DVL out, USBL"));
  list.atMost("DVL out, cmd_vel, at its end", 2.5, "m", after("DVL out, cmd_vel"));
  for (const char* row : {"DVL out, USBL", "DVL out, nothing", "DVL out, cmd_vel"}) {
    const auto nees = data.figures(data.setNamed("nominal"), rowNumber(row), kFaultNees);
    const int runs = std::max(1, static_cast<int>(nees.size()));
    const auto bounds = localization::meanBounds(15, runs, 0.95);
    list.within(std::string("NEES at its end, ") + row, bounds.low, bounds.high, meanOf(nees));
  }
}

}  // namespace

std::vector<Goal> goalsOf(const TrialData& data) {
  GoalList list(data);
  addPanel(data, list);
  addAgainstTruth(data, list);
  addConsistency(data, list);
  addFaults(data, list);
  return list.goals();
}

}  // namespace grid_path_planner::trials
