// grid_path study: a study file run by worker processes, and its report.
#include <csignal>
#include <cstdio>
#include <iostream>
#include <memory>

#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "command_line/progress_bar.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/ros/bag.h"
#include "grid_path_planner/study/process_pool.h"
#include "grid_path_planner/study/report.h"
#include "grid_path_planner/study/study_runner.h"
#include "grid_path_planner/study/study_worker.h"

#ifdef GPP_HAVE_MPI
#include "command_line/mpi_workers.h"
#endif

namespace grid_path_planner::command_line {

using base::InputError;
using base::StopSource;
using base::writeFileAtomically;
using grid::MapFileOptions;
using grid::OccupancyGrid;
using nodes::readAnyMapFile;
using study::csvOf;
using study::Finding;
using study::findingsOf;
using study::jsonReport;
using study::linesOfUnit;
using study::ProcessPool;
using study::readStudyFile;
using study::reportHtml;
using study::runsTable;
using study::runStudy;
using study::StudyData;
using study::StudyFailure;
using study::StudyFolder;
using study::StudyPlan;
using study::StudyResult;
using study::StudyWorker;
using study::WorkerGroup;

namespace {

namespace po = boost::program_options;

constexpr int kIncomplete = 1;
constexpr int kMostJobs = 1024;

StopSource interrupted;

void onInterrupt(int) {
  interrupted.cancel();
}

// While one of these lives, Ctrl-C asks the study to end instead of ending the program.
class CatchInterrupt {
 public:
  CatchInterrupt() : before_(std::signal(SIGINT, onInterrupt)) {}
  ~CatchInterrupt() { std::signal(SIGINT, before_); }
  CatchInterrupt(const CatchInterrupt&) = delete;
  CatchInterrupt& operator=(const CatchInterrupt&) = delete;

 private:
  void (*before_)(int);
};

po::options_description describe() {
  po::options_description known("Options");
  known.add_options()("study", po::value<std::string>()->required(), "study file (YAML)")(
      "out", po::value<std::string>()->required(),
      "folder for report.html, the tables (CSV, JSON) and the runs; a study that was interrupted "
      "goes on there")("jobs", po::value<int>()->default_value(1),
                       "worker processes; with more than there are cores times are not to be "
                       "trusted");
  return known;
}

OccupancyGrid readMap(const std::string& file) {
  MapFileOptions reading;
  reading.warn = [](const std::string& warning) { std::cerr << "warning: " << warning << '\n'; };
  return readAnyMapFile(file, reading);
}

void writeReport(const StudyPlan& plan, const StudyFolder& folder, const StudyResult& result,
                 const std::string& command) {
  const StudyData data(plan, result.runs);
  const std::vector<Finding> findings = findingsOf(data);
  writeFileAtomically(folder.file("runs.csv"), csvOf(runsTable(data)));
  for (const Finding& finding : findings)
    writeFileAtomically(folder.file(finding.table.name + ".csv"), csvOf(finding.table));
  writeFileAtomically(folder.file("study.json"), jsonReport(data, findings, result.failures));
  writeFileAtomically(folder.file("report.html"),
                      reportHtml(data, findings, result.failures, command));
}

int tell(const StudyResult& result, const StudyPlan& plan, const std::string& folder) {
  for (const StudyFailure& failure : result.failures)
    std::cerr << "not done: " << failure.unit << ": " << failure.reason << '\n';
  if (result.interrupted) std::cerr << "interrupted: the same command goes on from here\n";
  std::printf("questions=%zu resumed=%zu runs=%zu failed=%zu report=%s/report.html\n",
              plan.units().size(), result.resumed, result.runs.size(), result.failures.size(),
              folder.c_str());
  return result.failures.empty() && !result.interrupted ? 0 : kIncomplete;
}

int runAndReport(const StudyPlan& plan, const std::string& out, WorkerGroup& workers,
                 const std::string& command) {
  StudyFolder folder(out, plan.fingerprint());
  const CatchInterrupt catching;
  ProgressBar bar(plan.units().size());
  const StudyResult result = runStudy(plan, folder, workers, interrupted.token(),
                                      [&bar](std::size_t done, std::size_t) { bar.done(done); });
  writeReport(plan, folder, result, command);
  return tell(result, plan, out);
}

// `grid_path study FILE --out DIR` for `grid_path study --study FILE --out DIR`.
std::vector<char*> withNamedFile(int argc, char** argv) {
  static char flag[] = "--study";
  std::vector<char*> arguments(argv, argv + argc);
  if (argc > 1 && argv[1][0] != '-') arguments.insert(arguments.begin() + 1, flag);
  return arguments;
}

}  // namespace

int runStudyCommand(int argc, char** argv) {
  std::vector<char*> arguments = withNamedFile(argc, argv);
  po::variables_map values;
  if (!parseArguments(static_cast<int>(arguments.size()), arguments.data(), describe(),
                      "grid_path study FILE.yaml --out DIR [--jobs N]", values))
    return 0;
  const std::string file = values["study"].as<std::string>();
  const std::string out = values["out"].as<std::string>();
  const int jobs = values["jobs"].as<int>();
  if (jobs < 1 || jobs > kMostJobs)
    throw InputError("--jobs must be from 1 to " + std::to_string(kMostJobs) + ", got " +
                     std::to_string(jobs));

  const StudyPlan plan(readStudyFile(file), readMap);
  const auto worker = std::make_shared<StudyWorker>(plan);
  ProcessPool pool(static_cast<std::size_t>(jobs),
                   [&plan, worker](std::size_t task) { return linesOfUnit(*worker, plan, task); });
  const std::string command = "rosrun grid_path_planner grid_path study " + file + " --out " + out;
#ifdef GPP_HAVE_MPI
  if (startedByMpi()) {
    const MpiSession session;
    if (session.rank() > 0) {
      serveTasks(pool);
      return 0;
    }
    MpiWorkers workers(session, pool);
    return runAndReport(plan, out, workers, command);
  }
#endif
  return runAndReport(plan, out, pool, command);
}

}  // namespace grid_path_planner::command_line
