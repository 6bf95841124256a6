// Runs units of a study, one after the other.
//
// Every variant plans the same query `repeats` times, the variants in turn, so that a temporary load
// on the machine slows all of them alike. Dijkstra finds the least cost of grid steps in addition,
// whether it is among the variants or not.
#pragma once

#include <memory>
#include <vector>

#include "grid_path_planner/planning/path_planner.h"
#include "study/study_plan.h"
#include "study/study_run.h"

namespace grid_path_planner::study {

class StudyWorker {
 public:
  // For how many queries of a map paths are stored for the picture, which more would obscure.
  static constexpr std::size_t kDrawnQueries = 12;

  // `plan` outlives the worker.
  explicit StudyWorker(const StudyPlan& plan) : plan_(plan) {}

  // One run a variant, in the order of the variants.
  std::vector<StudyRun> run(const StudyUnit& unit);

 private:
  void prepare(std::size_t setting);
  planning::PathPlanner plannerFor(const StudySetting& setting, const StudyVariant& variant) const;
  static double preparationTime(planning::PathPlanner& planner);

  const StudyPlan& plan_;
  std::size_t prepared_ = static_cast<std::size_t>(-1);  // the setting that the planners are for
  std::shared_ptr<const grid::OccupancyGrid> searched_;  // the setting's map
  std::vector<planning::PathPlanner> planners_;          // one a variant
  std::vector<double> preparations_ms_;                  // of each
  std::unique_ptr<planning::PathPlanner> exact_;
};

}  // namespace grid_path_planner::study
