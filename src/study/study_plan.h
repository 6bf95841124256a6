// A study with its maps and queries: the units that are to be run, in order (study_job.h).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "study/study.h"
#include "study/study_query.h"

namespace grid_path_planner::study {

struct StudyUnit {
  std::size_t setting = 0;
  std::size_t query = 0;
};

class StudyPlan {
 public:
  using MapReader = std::function<grid::OccupancyGrid(const std::string& file)>;

  // Throws InputError for a map or scenario that cannot be read and for queries outside a map.
  StudyPlan(Study study, const MapReader& read_map);

  const Study& study() const { return study_; }
  const std::shared_ptr<const grid::OccupancyGrid>& map(std::size_t i) const { return maps_[i]; }
  // The map that a setting searches: the file's, or the same without its unfilled border.
  std::shared_ptr<const grid::OccupancyGrid> mapOf(const StudySetting& setting) const;
  const std::vector<StudyQuery>& queries(std::size_t map) const { return queries_[map]; }
  const std::vector<StudyUnit>& units() const { return units_; }

  // "dexrov_site, kernel 3 filter2d, weights 1/50/100, (30, 30) to (360, 360)"
  std::string nameOf(const StudyUnit& unit) const;

  // A hash of the plan (options, maps, queries) and of the sources that run it.
  std::uint64_t fingerprint() const;

 private:
  Study study_;
  std::vector<std::shared_ptr<const grid::OccupancyGrid>> maps_;
  std::vector<std::vector<StudyQuery>> queries_;
  std::vector<StudyUnit> units_;
};

}  // namespace grid_path_planner::study
