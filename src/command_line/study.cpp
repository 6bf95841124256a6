// grid_path study: a study file run by worker processes, and its report.
#include <iostream>
#include <memory>

#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "command_line/study_command.h"
#include "grid_path_planner/ros/bag.h"
#include "grid_path_planner/study/process_pool.h"
#include "grid_path_planner/study/study_job.h"

#ifdef GPP_HAVE_MPI
#include "command_line/mpi_workers.h"
#endif

namespace grid_path_planner::command_line {

using grid::MapFileOptions, grid::OccupancyGrid;
using nodes::readAnyMapFile;
using study::ProcessPool, study::StudyJob, study::StudyTarget, study::WorkerGroup;

namespace {

namespace po = boost::program_options;

po::options_description studyOptions() {
  po::options_description known("Options");
  known.add_options()("study", po::value<std::string>()->required(), "study file (YAML)");
  describeStudyOutput(known, false);
  return known;
}

OccupancyGrid readMap(const std::string& file) {
  MapFileOptions reading;
  reading.warn = [](const std::string& warning) { std::cerr << "warning: " << warning << '\n'; };
  return readAnyMapFile(file, reading);
}

int runStudyWith(const StudyJob& job, const StudyTarget& target, WorkerGroup& workers) {
  return runAndReport(job.units(), target.folder, [&](const auto& stop, const auto& progress) {
    return job.run(target, workers, stop, progress);
  });
}

}  // namespace

int runStudyCommand(int argc, char** argv) {
  static char flag[] = "--study";
  std::vector<char*> arguments = withNamedFile(argc, argv, flag);
  po::variables_map values;
  if (!parseArguments(static_cast<int>(arguments.size()), arguments.data(), studyOptions(),
                      "grid_path study FILE.yaml --out DIR [--jobs N] [--results PAGE.md]", values))
    return 0;
  const std::string file = values["study"].as<std::string>();
  const int jobs = jobsFrom(values);
  const StudyJob job(file, readMap);
  ProcessPool pool(static_cast<std::size_t>(jobs), job.work());
  const StudyTarget target = targetFrom(values, "study", file);
#ifdef GPP_HAVE_MPI
  if (startedByMpi()) {
    MpiSession session;
    if (session.rank() > 0) {
      serveTasks(session, pool);
      return 0;
    }
    MpiWorkers workers(session, pool);
    return runStudyWith(job, target, workers);
  }
#endif
  return runStudyWith(job, target, pool);
}

}  // namespace grid_path_planner::command_line
