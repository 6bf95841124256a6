#include "command_line/commands.h"

namespace grid_path_planner::command_line {

const std::vector<Command>& commands() {
  static const std::vector<Command> all = {
      {"plan", "plan a path on a map file", runPlan},
#ifdef GPP_WITH_STUDY
      {"scenarios", "run MovingAI queries and check their costs", runScenarios},
      {"study", "compare planners, heuristics, kernels and weights, and report", runStudyCommand},
#endif
#ifdef GPP_WITH_FLIGHTS
      {"flights", "fly the local planner through simulated worlds, and report", runFlights},
#endif
#ifdef GPP_WITH_TRIALS
      {"localization", "run a trial of the localization, in simulation or on a bag, and report",
       runLocalization},
#endif
      {"replay", "plan again what was recorded, and compare the paths", runReplay},
      {"rectangles", "cut a map's free space into rectangles", runRectangles},
      {"convert", "read a map file and write it in another format", runConvert},
      {"waypoints", "read a waypoint file and write it in another format", runWaypoints},
#ifdef GPP_WITH_MAPPING
      {"project", "project an octree file to a map file", runProject},
#endif
  };
  return all;
}

}  // namespace grid_path_planner::command_line
