#include "grid_path_planner/study/scenario_file.h"

#include "fuzz/fuzz_target.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfScenarios() {
  return {"version 1\n0\ta.map\t8\t4\t1\t2\t3\t3\t2.41421356\n1\ta.map\t8\t4\t0\t0\t7\t3\t8.5\n",
          "version 1.0\n0 a.map 8 4 1 2 1 2 0\n"};
}

FUZZ_TARGET(scenario_file, seedsOfScenarios) {
  const std::string file = fileOf("fuzz.scen", input);
  mayRefuse([&] {
    const auto queries = study::readScenarioFile(file);
    for (const study::ScenarioQuery& query : study::spreadOver(queries, 3))
      study::checkScenarioQuery(query, grid::GridGeometry(8, 4, 1.0), file);
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
