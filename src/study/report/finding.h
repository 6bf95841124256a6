// A question that a report answers: sentences and a table. Users include it through what makes findings.
#pragma once

#include <string>
#include <vector>

#include "study/report/table.h"

namespace grid_path_planner::study {

struct Finding {
  std::string question;
  Table table;
  std::vector<std::string> answers;
};

}  // namespace grid_path_planner::study
