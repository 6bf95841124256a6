// Command lines read with Boost.Program_options, for all commands.
#pragma once

#include <boost/program_options.hpp>
#include <string>
#include <vector>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::command_line {

// Long options only, so that negative numbers parse as values. Prints the help and returns false
// for --help, and for --complete, which lists the options for shells: one a line, with its choices.
// Throws InputError for unknown options, naming the closest known one.
bool parseArguments(int argc, char** argv, const boost::program_options::options_description& known,
                    const std::string& usage, boost::program_options::variables_map& values);

// "1.5,-2" as two numbers; throws InputError naming the option for anything but `fewest` to `most`
// finite numbers.
std::vector<double> numbersOf(const std::string& name, const std::string& text, std::size_t fewest,
                              std::size_t most);

// The value of --name. Throws InputError for anything but a whole number above 0.
std::int64_t countFrom(const boost::program_options::variables_map& values,
                       const std::string& name);

// --map, which is required, and --topic.
void describeMap(boost::program_options::options_description& known);
// --otsu and --columns.
void describeReading(boost::program_options::options_description& known);

// Options by --resolution, --topic, --otsu and --columns, with warnings to the standard error. Throws
// InputError.
grid::MapFileOptions readingOptionsFrom(const boost::program_options::variables_map& values);

// Adds an option --some-name for every option some_name of PlannerOptions, --weights F,U,O,
// --config FILE and --vehicle FILE.
void describePlannerOptions(boost::program_options::options_description& known,
                            const planning::PlannerOptions& defaults = {});

// The options given on the command line over those of --config over `defaults`, with what --vehicle says. Throws InputError
// naming the option, in the file with its line.
planning::PlannerOptions plannerOptionsFrom(const boost::program_options::variables_map& values,
                                            const planning::PlannerOptions& defaults = {});

// Prints on the standard error that `option` has no effect with `with`.
void warnAboutUnusedOption(const std::string& option, const std::string& with);
// Prints this for every option that has no effect with the others.
void warnAboutUnusedOptions(const planning::PlannerOptions& options,
                            const planning::PlannerOptions& defaults = {});

}  // namespace grid_path_planner::command_line
