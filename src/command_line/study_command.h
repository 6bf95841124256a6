// What the commands that run a study have in common: options, Ctrl-C, what is printed at the end.
#pragma once

#include <boost/program_options.hpp>
#include <functional>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/study/study_job.h"

namespace grid_path_planner::command_line {

// --out (required unless `optional_out`), --results, --commit, --jobs.
void describeStudyOutput(boost::program_options::options_description& known, bool optional_out);

// Throws InputError for a number of processes out of limits.
int jobsFrom(const boost::program_options::variables_map& values);

// Turns `grid_path study FILE --out DIR` into `grid_path study --study FILE --out DIR`. The strings live
// as long as `argv` and the flag.
std::vector<char*> withNamedFile(int argc, char** argv, char* flag);

// What a study writes and says of how it was made: the `command` of grid_path with its `file`.
study::StudyTarget targetFrom(const boost::program_options::variables_map& values,
                              const std::string& command, const std::string& file);

// Runs a study with a bar of its progress, which Ctrl-C ends after the units that were started, and prints what
// became of it. Returns the exit code.
using StudyRunner = std::function<study::StudyOutcome(
    const base::StopToken& stop, const std::function<void(std::size_t done)>& progress)>;
int runAndReport(std::size_t units, const std::string& folder, const StudyRunner& run);

}  // namespace grid_path_planner::command_line
