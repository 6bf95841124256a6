#include "command_line/study_command.h"

#include <csignal>
#include <cstdio>
#include <iostream>

#include "base/shell_text.h"
#include "command_line/progress_bar.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::command_line {

using base::InputError, base::shellWord, base::StopSource;
using study::StudyFailure, study::StudyOutcome, study::StudyTarget;

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

int printOutcome(const StudyOutcome& outcome, std::size_t units, const std::string& folder) {
  for (const StudyFailure& failure : outcome.failures)
    std::cerr << "not done: " << failure.unit << ": " << failure.reason << '\n';
  if (outcome.interrupted) std::cerr << "interrupted: the same command goes on from here\n";
  std::printf("questions=%zu resumed=%zu runs=%zu failed=%zu report=%s/report.html\n", units,
              outcome.resumed, outcome.runs, outcome.failures.size(), folder.c_str());
  return outcome.failures.empty() && !outcome.interrupted ? 0 : kIncomplete;
}

}  // namespace

void describeStudyOutput(po::options_description& known, bool optional_out) {
  const auto out = po::value<std::string>();
  known.add_options()(
      "out", optional_out ? out->default_value("") : out->required(),
      "folder for report.html, the tables (CSV, JSON) and the runs; a study that was "
      "interrupted goes on there")("results", po::value<std::string>()->default_value(""),
                                   "also write the results as a page of Markdown to keep in a "
                                   "repository, with its pictures (SVG) "
                                   "beside it")("commit",
                                                po::value<std::string>()->default_value(""),
                                                "the commit of the runs, for the page to say")(
      "jobs", po::value<int>()->default_value(1),
      "worker processes; with more than there are cores times are not to be trusted");
}

int jobsFrom(const po::variables_map& values) {
  const int jobs = values["jobs"].as<int>();
  if (jobs < 1 || jobs > kMostJobs)
    throw InputError("--jobs must be from 1 to " + std::to_string(kMostJobs) + ", got " +
                     std::to_string(jobs));
  return jobs;
}

std::vector<char*> withNamedFile(int argc, char** argv, char* flag) {
  std::vector<char*> arguments(argv, argv + argc);
  if (argc > 1 && argv[1][0] != '-') arguments.insert(arguments.begin() + 1, flag);
  return arguments;
}

StudyTarget targetFrom(const po::variables_map& values, const std::string& command,
                       const std::string& file) {
  const std::string out = values["out"].as<std::string>();
  const std::string results = values["results"].as<std::string>();
  return {out,
          "rosrun grid_path_planner grid_path " + command + ' ' + shellWord(file) + " --out " +
              shellWord(out) + (results.empty() ? "" : " --results " + shellWord(results)),
          results, values["commit"].as<std::string>()};
}

int runAndReport(std::size_t units, const std::string& folder, const StudyRunner& run) {
  const CatchInterrupt catching;
  ProgressBar bar(units);
  const StudyOutcome outcome =
      run(interrupted.token(), [&bar](std::size_t done) { bar.done(done); });
  return printOutcome(outcome, units, folder);
}

}  // namespace grid_path_planner::command_line
