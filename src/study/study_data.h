// The runs of a study, indexed by unit and variant.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "study/confidence.h"
#include "study/study_plan.h"
#include "study/study_run.h"

namespace grid_path_planner::study {

double medianTime(const StudyRun& run);  // ms

// The runs of one query on one setting, by variant; a null pointer where there is none.
using UnitRow = std::vector<const StudyRun*>;

// Settings that differ only in weights are the same map to search.
struct ProblemSize {
  std::size_t map = 0;
  int kernel = 1;
  costmap::KernelRule rule = costmap::KernelRule::CONSERVATIVE;
  Border border = Border::FILLED;

  auto tied() const { return std::tie(map, kernel, rule, border); }
  friend bool operator<(const ProblemSize& a, const ProblemSize& b) { return a.tied() < b.tied(); }
  friend bool operator==(const ProblemSize& a, const ProblemSize& b) {
    return a.tied() == b.tied();
  }
  friend bool operator!=(const ProblemSize& a, const ProblemSize& b) { return !(a == b); }
};

// A query of a map: the unit of sampling.
using QueryKey = std::pair<std::size_t, std::size_t>;

// One ratio for each query: the geometric mean of the ratios added to it.
class RatiosByQuery {
 public:
  // No effect unless both are positive.
  void add(const QueryKey& query, double numerator, double denominator);
  std::vector<double> values() const;

 private:
  std::map<QueryKey, std::vector<double>> logarithms_;
};

class StudyData {
 public:
  // Both outlive the data.
  StudyData(const StudyPlan& plan, const std::vector<StudyRun>& runs);

  const StudyPlan& plan() const { return plan_; }
  const Study& study() const { return plan_.study(); }
  const std::vector<StudyRun>& runs() const { return runs_; }
  // All of them, in the order of the plan.
  const std::vector<UnitRow>& units() const { return units_; }

  const StudySetting& settingOf(const StudyRun& run) const { return study().settings[run.setting]; }
  QueryKey queryOf(const StudyRun& run) const { return {settingOf(run).map, run.query}; }
  std::size_t queries() const;  // of all maps
  ProblemSize sizeOf(std::size_t setting) const;
  std::vector<ProblemSize> sizes() const;  // in the order of the settings

  // The variant with which the others are compared: Dijkstra, or the first.
  std::size_t baseline() const;
  // The same among the programs whose times can be compared with those of `variant`: those of this
  // package, or the published programs of one name. A scan of all cells against an open list is a
  // comparison of programs, not of planners.
  std::size_t baselineOf(std::size_t variant) const;

  // value(a) / value(b) for every query on `size` (null: any), geometric means over the settings
  // where both variants found a path and both values are positive.
  std::vector<double> ratios(std::size_t a, std::size_t b, const ProblemSize* size,
                             const std::function<double(const StudyRun&)>& value) const;

 private:
  const StudyPlan& plan_;
  const std::vector<StudyRun>& runs_;
  std::vector<UnitRow> units_;
};

// Median times in ms of the runs of one variant on one size that found a path.
std::vector<double> mediansOf(const StudyData& data, const ProblemSize& size, std::size_t variant);

// Blocks of the map that such a setting searches.
double blocksOf(const StudyData& data, const ProblemSize& size);

}  // namespace grid_path_planner::study
