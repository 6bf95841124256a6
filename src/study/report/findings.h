// What a study found, as questions with a table and sentences for an answer. Where figures were
// published they stand beside what was found, and a sentence says whether the conclusion holds.
//
// No sentence claims a difference whose 95 % interval leaves room for none.
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

// Those that the study has something to say about.
std::vector<Finding> findingsOf(const StudyData& data);

// Every run as a row.
Table runsTable(const StudyData& data);

}  // namespace grid_path_planner::study
