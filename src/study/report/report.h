// The report of a study: report.html, tables as CSV, everything as JSON.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/study/study_job.h"
#include "study/findings/findings.h"
#include "study/study_data.h"

namespace grid_path_planner::study {

// One self-contained file: summary, findings with charts and sortable tables, and for each map and
// kernel a picture with the paths of all variants. `command` is the command line that made it.
std::string reportHtml(const StudyData& data, const std::vector<Finding>& findings,
                       const std::vector<StudyFailure>& failures, const std::string& command);

// {"title", "maps", "variants", "settings", "findings", "failures", "runs"}.
std::string jsonReport(const StudyData& data, const std::vector<Finding>& findings,
                       const std::vector<StudyFailure>& failures);

// The command that repeats `run`, with map and ends; "" for planners and borders that only
// studies have.
std::string planCommand(const StudyData& data, const StudyRun& run);

}  // namespace grid_path_planner::study
