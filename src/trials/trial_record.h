// What the units of a trial's study found, as lines of its folder.
#pragma once

#include <string>
#include <vector>

#include "trials/marker_views.h"
#include "trials/trial_run.h"

namespace grid_path_planner::trials {

// All rows of one run.
struct RunRecord {
  std::size_t set = 0;
  int seed = 0;  // kShownSeed: with the poses that the images showed
  std::vector<RowResult> rows;
};

constexpr int kShownSeed = 0;

// A row of a recording.
struct RowRecord {
  std::string row;  // its name
  RowResult result;
};

// One line of JSON, with numbers in full and null for a figure that nothing was seen of, and back. Throw InputError for a
// line of another form.
std::string lineOf(const SeenFrame& frame);
std::string lineOf(const RunRecord& run);
std::string lineOf(const RowRecord& row);
bool isFrameLine(const std::string& line);
SeenFrame frameFromLine(const std::string& line);
RunRecord runFromLine(const std::string& line);
RowRecord rowFromLine(const std::string& line);

}  // namespace grid_path_planner::trials
