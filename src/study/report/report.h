// What a study leaves for people and programs: report.html, tables as CSV, everything as JSON.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/study/study_job.h"
#include "study/report/findings.h"
#include "study/study_data.h"

namespace grid_path_planner::study {

// One file that needs no other and no network: summary, findings with charts and tables that sort,
// and a picture a map and kernel with the paths of all variants over each other. `command` is what
// made it.
std::string reportHtml(const StudyData& data, const std::vector<Finding>& findings,
                       const std::vector<StudyFailure>& failures, const std::string& command);

// Comma-separated values (RFC 4180), the first line holding the columns. Numbers in full.
std::string csvOf(const Table& table);

// {"title", "maps", "variants", "settings", "findings", "failures", "runs"}.
std::string jsonReport(const StudyData& data, const std::vector<Finding>& findings,
                       const std::vector<StudyFailure>& failures);

// The command that makes `run` again, map and ends included; "" for what is in studies only.
std::string planCommand(const StudyData& data, const StudyRun& run);

}  // namespace grid_path_planner::study
