// A study of localization from its file to its report: images rendered, sensors simulated, the filter run.
//
//   const TrialJob job("config/localization_trial.yaml");
//   ProcessPool workers(2, job.work("out"));
//   const StudyOutcome outcome = job.run({"out", "what made it", "", ""}, workers, stop, progress);
//
// A unit of work is some images or one run. It is lost with its worker, and an interrupted study resumes after it.
// Guaranteed: the same file gives the same report and tables, byte for byte, for any number of workers.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/study/study_job.h"
#include "grid_path_planner/study/worker_group.h"

namespace grid_path_planner::trials {

class TrialPlan;
class DoneUnits;

class TrialJob {
 public:
  // Throws InputError for a file that cannot be read.
  explicit TrialJob(const std::string& file);
  ~TrialJob();

  std::size_t units() const;

  // Does a unit by its number and returns its lines; trajectories of the first seed are written into `folder`.
  // For one thread, and forks of it; the job must outlive it.
  std::function<std::string(std::size_t unit)> work(const std::string& folder) const;

  // Has `workers` do what the folder does not hold, and writes the report there once every error set has the run
  // with its images' poses and two seeds, and the page of results where no unit is missing. When `stop` asks to end,
  // units that were begun are completed. Throws InputError where a file cannot be written.
  study::StudyOutcome run(const study::StudyTarget& target, study::WorkerGroup& workers,
                          const base::StopToken& stop,
                          const std::function<void(std::size_t done)>& progress) const;

 private:
  bool runStage(const std::vector<std::size_t>& waiting, study::WorkerGroup& workers,
                const base::StopToken& stop, const std::function<void(std::size_t done)>& progress,
                DoneUnits& done, study::StudyOutcome& outcome) const;

  std::unique_ptr<const TrialPlan> plan_;
};

}  // namespace grid_path_planner::trials
