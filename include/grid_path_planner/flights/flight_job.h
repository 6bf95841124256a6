// A study of flights from its file to its report: the local planner in a simulated vehicle, in lock-step.
//
//   const FlightJob job("config/flights_rescue.yaml");
//   ProcessPool workers(2, job.work());
//   const StudyOutcome outcome = job.run({"out", "what made it", "", ""}, workers, stop, progress);
//
// A unit of work is a flight. It is lost with its worker, and an interrupted study resumes after it.
// Guaranteed: the same file gives the same flights, bit for bit, for any number of workers.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/study/study_job.h"
#include "grid_path_planner/study/worker_group.h"

namespace grid_path_planner::flights {

class FlightPlan;

// One flight that was flown again.
struct FlownAgain {
  std::string name;     // "LHLM/7/safe"
  std::string outcome;  // a sentence
  std::string log;      // file of the pilot's log; "" for a pilot that is a program
  std::string picture;  // file
  bool came_home = false;
};

class FlightJob {
 public:
  // Throws InputError for a file that cannot be read.
  explicit FlightJob(const std::string& file);
  ~FlightJob();

  std::size_t units() const;

  // Flies a flight by its number and returns its line. For one thread, and forks of it; the job must
  // outlive it.
  std::function<std::string(std::size_t unit)> work() const;

  // Has `workers` fly what the folder does not hold, and writes the report there. When `stop` asks to end,
  // flights in the air are completed. The page of results is written where no flight is missing. Throws
  // InputError where a world cannot be read or a file cannot be written.
  study::StudyOutcome run(const study::StudyTarget& target, study::WorkerGroup& workers,
                          const base::StopToken& stop,
                          const std::function<void(std::size_t done)>& progress) const;

  // Flies one of them, by the beginning of its name ("LHLM/7"), with a log and a picture in `folder`.
  // Throws InputError where there is none.
  FlownAgain flyOne(const std::string& name, const std::string& folder) const;

 private:
  std::unique_ptr<const FlightPlan> plan_;
};

}  // namespace grid_path_planner::flights
