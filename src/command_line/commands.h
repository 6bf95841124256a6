// The commands of grid_path. Each takes what follows its name as argc and argv (argv[0] is the
// name) and returns the exit code; bad input may be thrown as any std::exception and becomes
// kBadInput.
#pragma once

#include <vector>

namespace grid_path_planner::command_line {

constexpr int kBadInput = 2;

int runPlan(int argc, char** argv);
int runScenarios(int argc, char** argv);
int runReplay(int argc, char** argv);
int runRectangles(int argc, char** argv);
int runConvert(int argc, char** argv);
int runWaypoints(int argc, char** argv);
int runProject(int argc, char** argv);
int runStudyCommand(int argc, char** argv);
int runFlights(int argc, char** argv);
int runLocalization(int argc, char** argv);

struct Command {
  const char* name;
  const char* purpose;
  int (*run)(int argc, char** argv);
};

const std::vector<Command>& commands();

}  // namespace grid_path_planner::command_line
