// The YAML file of a node, read by commands.
#pragma once

#include <string>

#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::command_line {

// Sets the options that `file`, a YAML with parameters of the node path_planner, has; those of the
// node alone are passed over, unknown ones are warned about on the standard error, as the node does.
// Throws InputError naming file, line and option; `options` is then as it was.
void readNodeConfig(const std::string& file, planning::PlannerOptions& options);

}  // namespace grid_path_planner::command_line
