// Style and script of the report.
#pragma once

namespace grid_path_planner::study {

extern const char* const kReportStyle;
extern const char* const kReportScript;

}  // namespace grid_path_planner::study
