// The findings of a study: questions, each with a table and sentences as an answer. Published figures
// stand beside the measured ones, and a sentence says whether the published conclusion holds.
//
// No sentence claims a difference whose 95 % interval includes none.
#pragma once

#include <string>
#include <vector>

#include "study/report/table.h"
#include "study/study_data.h"

namespace grid_path_planner::study {

struct Finding {
  std::string question;
  Table table;
  std::vector<std::string> answers;
};

Finding timeFinding(const StudyData& data);      // planning time, and against the baseline's
Finding kernelFinding(const StudyData& data);    // what larger kernels save, and cost in length
Finding effortFinding(const StudyData& data);    // cells expanded and cells of the path
Finding shortestFinding(const StudyData& data);  // which heuristic gives the shortest path
Finding optimalFinding(const StudyData& data);   // how far from the least cost
Finding weightsFinding(const StudyData& data);   // where weights send paths

// The findings for which the study has data.
std::vector<Finding> findingsOf(const StudyData& data);

// One row for each run.
Table runsTable(const StudyData& data);

}  // namespace grid_path_planner::study
