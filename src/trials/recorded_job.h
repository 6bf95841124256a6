// A recorded trial from its measurements to its report.
//
//   RecordedTrial trial;                          // readRecordedTrialFile
//   localization::NavigationRecording recording;  // of its bag
//   const RecordedJob job(trial, recording);
//   ProcessPool workers(2, job.work("out"));
//   const StudyOutcome outcome = job.run({"out", "what made it", "", ""}, workers, stop, progress);
//
// A unit of work is one row. Guaranteed: what TrialJob guarantees. A folder that another recording began is refused.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/study/study_job.h"
#include "grid_path_planner/study/worker_group.h"
#include "trials/recorded_trial.h"

namespace grid_path_planner::trials {

class RecordedJob {
 public:
  // Throws InputError where the recording allows no row.
  RecordedJob(RecordedTrial trial, localization::NavigationRecording recording);

  std::size_t units() const { return possible_.size(); }

  // Plays a row by its number and returns its line; trajectories are written into `folder`.
  std::function<std::string(std::size_t unit)> work(const std::string& folder) const;

  // As TrialJob::run; the report is written once all rows are done.
  study::StudyOutcome run(const study::StudyTarget& target, study::WorkerGroup& workers,
                          const base::StopToken& stop,
                          const std::function<void(std::size_t done)>& progress) const;

 private:
  std::string lineOfRow(std::size_t unit, const std::string& folder) const;
  // A hash of the file, of the sources, and of all measurements with sensors' places and truth.
  std::uint64_t fingerprint() const;

  RecordedTrial trial_;
  localization::NavigationRecording recording_;
  std::vector<RecordedRow> rows_;
  std::vector<TrialRow> possible_;
  SensorTape tape_;
};

}  // namespace grid_path_planner::trials
