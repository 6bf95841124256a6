#include "commands.h"

namespace grid_path_planner::tools {

const std::vector<Command>& commands() {
  static const std::vector<Command> all = {
      {"plan", "plan a path on a map file", runPlan},
      {"scenarios", "run MovingAI queries and check their costs", runScenarios},
      {"study", "compare planners, heuristics, kernels and weights, and report", runStudyCommand},
      {"rectangles", "cut a map's free space into rectangles", runRectangles},
      {"convert", "read a map file and write it in another format", runConvert},
      {"project", "project an octree file to a map file", runProject},
  };
  return all;
}

}  // namespace grid_path_planner::tools
