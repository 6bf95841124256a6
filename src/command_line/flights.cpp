// grid_path flights: simulated flights of the local planner, their report, and a log repeated.
#include <cstdio>

#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "command_line/study_command.h"
#include "grid_path_planner/avoidance/flight_log.h"
#include "grid_path_planner/flights/flight_job.h"
#include "grid_path_planner/study/process_pool.h"

namespace grid_path_planner::command_line {

using base::InputError;
using flights::FlightJob, flights::FlownAgain;
using study::ProcessPool, study::StudyTarget;

namespace {

namespace po = boost::program_options;

constexpr int kDiffers = 1;

po::options_description flightOptions() {
  po::options_description known("Options");
  known.add_options()("flights", po::value<std::string>()->default_value(""),
                      "file of the study of flights (YAML)")(
      "flight", po::value<std::string>()->default_value(""),
      "fly this one only, e.g. LHLM/7 or LHLM/7/safe, and write its log, its picture and its "
      "record "
      "into the folder")("log", po::value<std::string>()->default_value(""),
                         "repeat the log of a flight or of local_planner and compare every answer");
  describeStudyOutput(known, true);
  return known;
}

int repeatLog(const std::string& file) {
  const avoidance::ReplayResult result = avoidance::replayFlight(file);
  std::printf("updates=%llu differing=%llu\n", static_cast<unsigned long long>(result.updates),
              static_cast<unsigned long long>(result.differing));
  if (result.differing == 0) return 0;
  std::printf("%s\n", result.first_difference.c_str());
  return kDiffers;
}

int flyOne(const FlightJob& job, const std::string& name, const std::string& folder) {
  const FlownAgain flight = job.flyOne(name, folder);
  std::printf("%s: %s\n%s\n", flight.name.c_str(), flight.outcome.c_str(), flight.picture.c_str());
  if (!flight.log.empty()) std::printf("%s\n", flight.log.c_str());
  return 0;
}

std::string required(const po::variables_map& values, const std::string& name) {
  const std::string value = values[name].as<std::string>();
  if (value.empty()) throw InputError("flights needs --" + name + ", or --log");
  return value;
}

constexpr char kUsage[] =
    "grid_path flights FILE.yaml --out DIR [--jobs N] [--flight NAME/SEED]\n"
    "       grid_path flights --log FILE";

}  // namespace

int runFlights(int argc, char** argv) {
  static char flag[] = "--flights";
  std::vector<char*> arguments = withNamedFile(argc, argv, flag);
  po::variables_map values;
  if (!parseArguments(static_cast<int>(arguments.size()), arguments.data(), flightOptions(), kUsage,
                      values))
    return 0;
  if (!values["log"].as<std::string>().empty()) return repeatLog(values["log"].as<std::string>());
  const std::string file = required(values, "flights"), out = required(values, "out");
  const FlightJob job(file);
  const std::string flight = values["flight"].as<std::string>();
  if (!flight.empty()) return flyOne(job, flight, out);
  const StudyTarget target = targetFrom(values, "flights", file);
  ProcessPool pool(static_cast<std::size_t>(jobsFrom(values)), job.work());
  return runAndReport(job.units(), out, [&](const auto& stop, const auto& progress) {
    return job.run(target, pool, stop, progress);
  });
}

}  // namespace grid_path_planner::command_line
