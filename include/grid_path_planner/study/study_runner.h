// Has the units of a study done by workers, and keeps what they bring.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/study/study_folder.h"
#include "grid_path_planner/study/study_plan.h"
#include "grid_path_planner/study/worker_group.h"

namespace grid_path_planner::study {

class StudyWorker;

struct StudyFailure {
  std::string unit;    // StudyPlan::nameOf
  std::string reason;  // why its worker brought nothing
};

struct StudyResult {
  std::vector<StudyRun> runs;  // by unit, then variant: the same order for any number of workers
  std::vector<StudyFailure> failures;
  std::size_t resumed = 0;   // units that an earlier run had done
  bool interrupted = false;  // some units were not started
};

// What a worker does of unit number `task`: the lines of its runs.
std::string linesOfUnit(StudyWorker& worker, const StudyPlan& plan, std::size_t task);

// Hands the units that `folder` has no runs of to `workers`, until all are done or `stop` asks to
// end; then what was started is waited for. A unit that fails is named and the rest goes on; it is
// tried again when the study is resumed. `progress` hears of the units done, those of before
// included. Throws InputError where the folder cannot be written.
StudyResult runStudy(const StudyPlan& plan, StudyFolder& folder, WorkerGroup& workers,
                     const base::StopToken& stop,
                     const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace grid_path_planner::study
