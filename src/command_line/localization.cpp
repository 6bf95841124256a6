// grid_path localization: a trial of the localization in simulation, and its report.
#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "command_line/study_command.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/study/process_pool.h"
#include "trials/trial_job.h"

namespace grid_path_planner::command_line {

namespace {

namespace po = boost::program_options;

po::options_description trialOptions() {
  po::options_description known("Options");
  known.add_options()("trial", po::value<std::string>()->required(), "file of the trial (YAML)");
  describeStudyOutput(known, false);
  return known;
}

constexpr char kTrialUsage[] = "grid_path localization FILE.yaml --out DIR [--jobs N]";

}  // namespace

int runLocalization(int argc, char** argv) {
  static char flag[] = "--trial";
  std::vector<char*> arguments = withNamedFile(argc, argv, flag);
  po::variables_map values;
  if (!parseArguments(static_cast<int>(arguments.size()), arguments.data(), trialOptions(),
                      kTrialUsage, values))
    return 0;
  const std::string file = values["trial"].as<std::string>();
  const std::string out = values["out"].as<std::string>();
  const trials::TrialJob job(file);
  const study::StudyTarget target = targetFrom(values, "grid_path localization " + file);
  study::ProcessPool pool(static_cast<std::size_t>(jobsFrom(values)), job.work(out));
  return runAndReport(job.units(), out, [&](const auto& stop, const auto& progress) {
    return job.run(target, pool, stop, progress);
  });
}

}  // namespace grid_path_planner::command_line
