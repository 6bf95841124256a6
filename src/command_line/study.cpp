// grid_path study: a study file run by worker processes, and its report.
#include <csignal>
#include <cstdio>
#include <iostream>
#include <memory>

#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "command_line/progress_bar.h"
#include "grid_path_planner/ros/bag.h"
#include "grid_path_planner/study/process_pool.h"
#include "grid_path_planner/study/study_job.h"

#ifdef GPP_HAVE_MPI
#include "command_line/mpi_workers.h"
#endif

namespace grid_path_planner::command_line {

using base::InputError, base::StopSource;
using grid::MapFileOptions, grid::OccupancyGrid;
using nodes::readAnyMapFile;
using study::ProcessPool, study::StudyFailure, study::StudyJob, study::StudyOutcome,
    study::StudyTarget, study::WorkerGroup;

namespace {

namespace po = boost::program_options;

constexpr int kIncomplete = 1;
constexpr int kMostJobs = 1024;

StopSource interrupted;

void onInterrupt(int) {
  interrupted.cancel();
}

// For its lifetime Ctrl-C stops the study instead of ending the program.
class CatchInterrupt {
 public:
  CatchInterrupt() : before_(std::signal(SIGINT, onInterrupt)) {}
  ~CatchInterrupt() { std::signal(SIGINT, before_); }
  CatchInterrupt(const CatchInterrupt&) = delete;
  CatchInterrupt& operator=(const CatchInterrupt&) = delete;

 private:
  void (*before_)(int);
};

po::options_description studyOptions() {
  po::options_description known("Options");
  known.add_options()("study", po::value<std::string>()->required(), "study file (YAML)")(
      "out", po::value<std::string>()->required(),
      "folder for report.html, the tables (CSV, JSON) and the runs; a study that was interrupted "
      "goes on there")("results", po::value<std::string>()->default_value(""),
                       "also write the results as a page of Markdown to keep in a repository, with "
                       "two pictures (SVG) beside it")(
      "commit", po::value<std::string>()->default_value(""),
      "the commit of the runs, for the page to say")(
      "jobs", po::value<int>()->default_value(1),
      "worker processes; with more than there are cores times are not to be "
      "trusted");
  return known;
}

OccupancyGrid readMap(const std::string& file) {
  MapFileOptions reading;
  reading.warn = [](const std::string& warning) { std::cerr << "warning: " << warning << '\n'; };
  return readAnyMapFile(file, reading);
}

int printOutcome(const StudyOutcome& outcome, std::size_t units, const std::string& folder) {
  for (const StudyFailure& failure : outcome.failures)
    std::cerr << "not done: " << failure.unit << ": " << failure.reason << '\n';
  if (outcome.interrupted) std::cerr << "interrupted: the same command goes on from here\n";
  std::printf("questions=%zu resumed=%zu runs=%zu failed=%zu report=%s/report.html\n", units,
              outcome.resumed, outcome.runs, outcome.failures.size(), folder.c_str());
  return outcome.failures.empty() && !outcome.interrupted ? 0 : kIncomplete;
}

int runAndReport(const StudyJob& job, const StudyTarget& target, WorkerGroup& workers) {
  const CatchInterrupt catching;
  ProgressBar bar(job.units());
  const StudyOutcome outcome =
      job.run(target, workers, interrupted.token(), [&bar](std::size_t done) { bar.done(done); });
  return printOutcome(outcome, job.units(), target.folder);
}

// Turns `grid_path study FILE --out DIR` into `grid_path study --study FILE --out DIR`.
std::vector<char*> withNamedFile(int argc, char** argv) {
  static char flag[] = "--study";
  std::vector<char*> arguments(argv, argv + argc);
  if (argc > 1 && argv[1][0] != '-') arguments.insert(arguments.begin() + 1, flag);
  return arguments;
}

int jobsFrom(const po::variables_map& values) {
  const int jobs = values["jobs"].as<int>();
  if (jobs < 1 || jobs > kMostJobs)
    throw InputError("--jobs must be from 1 to " + std::to_string(kMostJobs) + ", got " +
                     std::to_string(jobs));
  return jobs;
}

}  // namespace

int runStudyCommand(int argc, char** argv) {
  std::vector<char*> arguments = withNamedFile(argc, argv);
  po::variables_map values;
  if (!parseArguments(static_cast<int>(arguments.size()), arguments.data(), studyOptions(),
                      "grid_path study FILE.yaml --out DIR [--jobs N] [--results PAGE.md]", values))
    return 0;
  const std::string file = values["study"].as<std::string>();
  const std::string out = values["out"].as<std::string>();
  const std::string results = values["results"].as<std::string>();
  const int jobs = jobsFrom(values);
  const StudyJob job(file, readMap);
  ProcessPool pool(static_cast<std::size_t>(jobs), job.work());
  const StudyTarget target = {out,
                              "rosrun grid_path_planner grid_path study " + file + " --out " + out +
                                  (results.empty() ? "" : " --results " + results),
                              results, values["commit"].as<std::string>()};
#ifdef GPP_HAVE_MPI
  if (startedByMpi()) {
    const MpiSession session;
    if (session.rank() > 0) {
      serveTasks(pool);
      return 0;
    }
    MpiWorkers workers(session, pool);
    return runAndReport(job, target, workers);
  }
#endif
  return runAndReport(job, target, pool);
}

}  // namespace grid_path_planner::command_line
