// The report of a study of flights: report.html, tables as CSV, pictures, a page of results.
#pragma once

#include <string>
#include <vector>

#include "flights/report/flight_data.h"
#include "grid_path_planner/study/study_job.h"

namespace grid_path_planner::flights {

// Outlines of worlds, read when they are first drawn.
class WorldOutlines {
 public:
  explicit WorldOutlines(const FlightStudy& study)
      : study_(study), outlines_(study.worlds.size()) {}
  const std::vector<std::vector<Eigen::Vector2d>>& of(std::size_t world);

 private:
  const FlightStudy& study_;
  std::vector<std::vector<std::vector<Eigen::Vector2d>>> outlines_;
};

// Writes report.html, flights.csv, a CSV for each table and above_*.svg into `folder`, and, where
// target.results names one and none is missing, the page of results. `missing`: flights that were not flown.
void writeFlightReport(const FlightData& data, const std::vector<study::StudyFailure>& failures,
                       std::size_t missing, const study::StudyTarget& target);

}  // namespace grid_path_planner::flights
