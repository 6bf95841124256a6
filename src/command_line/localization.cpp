// grid_path localization: a trial of the localization, in simulation or on a bag, and its report.
#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "command_line/study_command.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/study/process_pool.h"
#include "ros/localization/navigation_bag.h"
#include "ros/planning/record/recorded_plans.h"
#include "trials/recorded_job.h"
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

trials::RecordedJob recordedJob(const std::string& file) {
  nodes::NavigationQuestion question;
  trials::RecordedTrial trial =
      trials::readRecordedTrialFile(file, [&](const std::string& name, const std::string& text) {
        return base::setOption(question.options, name, text);
      });
  try {
    checkVehicleLocalizerOptions(question.options);
  } catch (const base::InputError& error) {
    throw base::InputError(file, std::string("localizer: ") + error.what());
  }
  trial.filter = question.options.localizer.filter;
  question.topics = trial.topics;
  question.truth_frame = trial.truth_frame;
  question.frames = trial.frames;
  auto recording = nodes::readNavigationBag(trial.bag, question, nodes::longReading());
  return {std::move(trial), std::move(recording)};
}

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
  const study::StudyTarget target = targetFrom(values, "localization", file);
  const auto run = [&](const auto& job) {
    study::ProcessPool pool(static_cast<std::size_t>(jobsFrom(values)), job.work(out));
    return runAndReport(job.units(), out, [&](const auto& stop, const auto& progress) {
      return job.run(target, pool, stop, progress);
    });
  };
  return trials::isRecordedTrial(file) ? run(recordedJob(file)) : run(trials::TrialJob(file));
}

}  // namespace grid_path_planner::command_line
