// The findings of a study: questions, each with a table and sentences as an answer. Published figures
// stand beside the measured ones, and a sentence says whether the published conclusion holds.
//
// No sentence claims a difference whose 95 % interval includes none.
#pragma once

#include <string>
#include <vector>

#include "study/report/finding.h"
#include "study/study_data.h"

namespace grid_path_planner::study {

Finding timeFinding(const StudyData& data);      // planning time, and against the baseline's
Finding kernelFinding(const StudyData& data);    // what larger kernels save, and cost in length
Finding effortFinding(const StudyData& data);    // cells expanded and cells of the path
Finding shortestFinding(const StudyData& data);  // which heuristic gives the shortest path
Finding optimalFinding(const StudyData& data);   // how far from the least cost
Finding weightsFinding(const StudyData& data);   // where weights send paths

Finding countsFinding(const StudyData& data);  // the same, counted as the original study counted
Finding cellsFinding(const StudyData& data);   // cells of the published paths, and of ours
Finding otherCellsFinding(const StudyData& data);   // of Dijkstra's, on its own queries
Finding preparationFinding(const StudyData& data);  // what it costs, and when it pays
Finding mapsFinding(const StudyData& data);         // what the maps hold

// The least number of queries from which `preparation` and so many `plan`s take less than another's;
// infinity where they never do.
double queriesUntilCheaper(double preparation, double plan, double other_preparation,
                           double other_plan);

struct ClassShares {
  double free = 0.0;
  double unknown = 0.0;
  double occupied = 0.0;
};
ClassShares classSharesOf(const grid::OccupancyGrid& map,
                          const grid::OccupancyThresholds& thresholds);

// The findings for which the study has data.
std::vector<Finding> findingsOf(const StudyData& data);

// One row for each run.
Table runsTable(const StudyData& data);

}  // namespace grid_path_planner::study
