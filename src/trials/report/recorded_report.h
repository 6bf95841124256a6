// The report of a recorded trial: report.html, tables as CSV.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "grid_path_planner/study/study_job.h"
#include "trials/recorded_trial.h"
#include "trials/trial_run.h"

namespace grid_path_planner::trials {

struct RecordedResults {
  const RecordedTrial& trial;
  const localization::NavigationRecording& recording;
  const std::vector<RecordedRow>& rows;
  std::map<std::string, RowResult> played;  // by row
};

// Throws InputError where a file cannot be written.
void writeRecordedReport(const RecordedResults& results, const study::StudyTarget& target);

}  // namespace grid_path_planner::trials
