// The results of a study as a page of Markdown with two pictures, to be kept in a repository.
#pragma once

#include <string>
#include <vector>

#include "study/findings/findings.h"
#include "study/study_data.h"

namespace grid_path_planner::study {

// What made the page.
struct ResultsOrigin {
  std::string command;
  std::string commit;  // of the runs, "" where it was not told
  std::string date;    // "2026-11-22"
};

// The page: origin, then each finding with its sentences and its table. Tables of more rows than
// people read are named only. Pictures are linked where they are not empty, by these names.
std::string resultsPage(const StudyData& data, const std::vector<Finding>& findings,
                        const ResultsOrigin& origin, const std::string& times_picture,
                        const std::string& paths_picture);

// SVG of its own: planning time over the number of cells searched, one line for each program, on the
// last map. "" without runs.
std::string timesPicture(const StudyData& data);

// SVG of its own: of the queries whose paths are kept, the one whose path of the published program
// runs through the most blocks that stayed unfilled, with these blocks filled and unfilled. "" where
// there is none.
std::string pathsPicture(const StudyData& data);

}  // namespace grid_path_planner::study
