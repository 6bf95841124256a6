// The result of one variant for one query on one setting, timed `repeats` times.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "grid_path_planner/base/status.h"
#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::study {

struct StudyRun {
  std::size_t setting = 0;
  std::size_t query = 0;
  std::size_t variant = 0;
  grid::Cell start;  // cells of the full map
  grid::Cell goal;
  std::string note;  // StudyQuery::note

  base::Status status = base::Status::NO_MAP;
  std::string message;
  double cost = 0.0;     // in cells x weight; with everything below only where FOUND
  double optimum = 0.0;  // the least cost by grid steps on the same setting; 0: there is no path
  double length_m = 0.0;
  double turning_rad = 0.0;
  double clearance_m = 0.0;  // to occupied cells of the full map; infinite where there are none
  double unknown_m = 0.0;    // metres of the path through unknown cells of the full map
  double occupied_m = 0.0;
  std::uint64_t cells = 0;         // of the path, on the map searched; the original's "explored"
  std::uint64_t border_cells = 0;  // of those in blocks that Border::UNFILLED leaves unfilled
  std::uint64_t expanded = 0;      // for every status, as the two below
  std::uint64_t generated = 0;
  std::uint64_t bytes = 0;
  // What the variant does for a new map before its first plan, without the costmap; measured once
  // for a setting, and in every run of it.
  double preparation_ms = 0.0;
  std::vector<double> times_ms;  // of each repeat, planning alone

  std::vector<float> path_xy;  // x, y in metres, for pictures
};

// One line of JSON, and back. Throws InputError for a line of another form.
std::string lineOf(const StudyRun& run);
StudyRun runFromLine(const std::string& line);

}  // namespace grid_path_planner::study
