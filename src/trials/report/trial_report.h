// The report of a study of localization: report.html, tables as CSV, summary.yaml, a page of results.
#pragma once

#include "grid_path_planner/study/study_job.h"
#include "trials/report/trial_data.h"

namespace grid_path_planner::trials {

// The page of results is written where no unit is missing. Throws InputError where a file cannot be written.
void writeTrialReport(const TrialData& data, const study::StudyTarget& target);

}  // namespace grid_path_planner::trials
