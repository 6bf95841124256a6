// Runs units of a study, one after the other.
//
// Every variant plans the same query `repeats` times, the variants in turn, so that what slows the
// machine for a while slows all of them alike. The least cost by grid steps is found once more by
// Dijkstra, whether that is among the variants or not.
#pragma once

#include <memory>
#include <vector>

#include "grid_path_planner/planning/path_planner.h"
#include "study/study_plan.h"
#include "study/study_run.h"

namespace grid_path_planner::study {

class StudyWorker {
 public:
  // Of how many queries a map the paths are kept: a picture with more shows nothing.
  static constexpr std::size_t kDrawnQueries = 12;

  // `plan` outlives the worker.
  explicit StudyWorker(const StudyPlan& plan) : plan_(plan) {}

  // One run a variant, in the order of the variants.
  std::vector<StudyRun> run(const StudyUnit& unit);

 private:
  void prepare(std::size_t setting);
  planning::PathPlanner plannerFor(const StudySetting& setting, const StudyVariant& variant) const;

  const StudyPlan& plan_;
  std::size_t prepared_ = static_cast<std::size_t>(-1);  // the setting that the planners are for
  std::vector<planning::PathPlanner> planners_;          // one a variant
  std::unique_ptr<planning::PathPlanner> exact_;
};

}  // namespace grid_path_planner::study
