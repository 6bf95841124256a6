// Distributes the units of a study to workers and stores their runs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/study/study_job.h"
#include "grid_path_planner/study/worker_group.h"
#include "study/study_folder.h"
#include "study/study_plan.h"

namespace grid_path_planner::study {

class StudyWorker;

struct StudyResult {
  std::vector<StudyRun> runs;  // by unit, then variant: the same order for any number of workers
  std::vector<StudyFailure> failures;
  std::size_t resumed = 0;   // units that an earlier run had done
  bool interrupted = false;  // some units were not started
};

// Does unit number `task`; the lines of its runs.
std::string linesOfUnit(StudyWorker& worker, const StudyPlan& plan, std::size_t task);

// Starts the units of which `folder` has no runs on `workers`, until all are done or `stop` asks to
// end; then waits for the started ones. A unit that fails is named and the others go on; it is tried
// again when the study is resumed. `progress` is called with the number of units done, earlier ones
// included. Throws InputError where the folder cannot be written.
StudyResult runStudy(const StudyPlan& plan, StudyFolder& folder, WorkerGroup& workers,
                     const base::StopToken& stop,
                     const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace grid_path_planner::study
