// A study from its file to its report: runs of planners on maps, and what they show.
//
//   const StudyJob job("config/study_thesis.yaml", read_map);
//   ProcessPool workers(4, job.work());
//   const StudyOutcome outcome = job.run({"out", "what made it", "", ""}, workers, stop, progress);
//
// The work is cut into units: one query on one setting, by every variant. A unit is done by one
// worker, is lost with its worker, and is what an interrupted study resumes after.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/study/worker_group.h"

namespace grid_path_planner::study {

class StudyPlan;

struct StudyFailure {
  std::string unit;    // StudyPlan::nameOf
  std::string reason;  // why its worker returned nothing
};

struct StudyOutcome {
  std::size_t runs = 0;     // one for each unit and variant
  std::size_t resumed = 0;  // units that an earlier run had done
  std::vector<StudyFailure> failures;
  bool interrupted = false;  // some units were not started
};

// What a study writes besides its folder, and what is told there of how it was made.
struct StudyTarget {
  std::string folder;
  std::string command;  // shown in the report
  std::string results;  // page.md, with page_times.svg and page_paths.svg beside it; "" for none
  std::string commit;   // of the runs, shown there; "" where it is not known
};

class StudyJob {
 public:
  using MapReader = std::function<grid::OccupancyGrid(const std::string& file)>;

  // Throws InputError for a study file, map or scenario that cannot be read and for queries outside
  // a map.
  StudyJob(const std::string& study_file, const MapReader& read_map);
  ~StudyJob();

  std::size_t units() const;

  // Does a unit by its number and returns the lines of its runs. For one thread, and forks of it;
  // the job must outlive it.
  std::function<std::string(std::size_t unit)> work() const;

  // Has `workers` do the units of which the folder has no runs, and writes report.html, the tables as
  // CSV and study.json there. When `stop` asks to end, the units that were started are completed. A
  // unit that fails is named and tried again when the study is resumed. `progress` is called with the
  // number of units done, earlier ones included. The page of results is written where no unit is
  // missing. Throws InputError where a file cannot be written.
  StudyOutcome run(const StudyTarget& target, WorkerGroup& workers, const base::StopToken& stop,
                   const std::function<void(std::size_t done)>& progress) const;

 private:
  std::unique_ptr<const StudyPlan> plan_;
};

}  // namespace grid_path_planner::study
