// A study small enough to run in a test.
#pragma once

#include <memory>
#include <string>

#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/study/process_pool.h"
#include "study/study_folder.h"
#include "study/study_plan.h"
#include "study/study_runner.h"
#include "study/study_worker.h"
#include "support/ascii_map.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::test {

// Two kernels, two sets of weights, three queries, of which one has no answer; Dijkstra and two A*.
inline study::StudyPlan smallStudy(const TemporaryFolder& folder) {
  grid::writeMapServerFile(folder.path("site.yaml"), AsciiMap({".....#.",  //
                                                               ".##..#.",  //
                                                               ".?#..##",  //
                                                               ".??....",  //
                                                               ".......",  //
                                                               "......."})
                                                         .map);
  const std::string file = folder.write("study.yaml", R"(
title: A small study
maps: [site.yaml]
planners: [dijkstra, a_star]
heuristics: [octile, euclidean]
kernels: [1, 2]
weights: [[1, 2, 100], [1, 50, 100]]
queries:
  pairs: [[[0, 0], [4, 5]], [[0, 5], [6, 0]], [[0, 0], [6, 5]]]
repeats: 2
)");
  return study::StudyPlan(study::readStudyFile(file),
                          [](const std::string& map) { return grid::readMapFile(map); });
}

// The run of a unit by a variant, which found a path: what a study would find is then known.
inline study::StudyRun inventedRun(const study::StudyUnit& unit, std::size_t variant) {
  study::StudyRun run;
  run.setting = unit.setting;
  run.query = unit.query;
  run.variant = variant;
  run.status = base::Status::FOUND;
  run.cost = run.optimum = 10.0;
  run.length_m = 10.0;
  return run;
}

inline study::StudyResult runWith(const study::StudyPlan& plan, study::StudyFolder& folder,
                                  std::size_t processes) {
  const auto worker = std::make_shared<study::StudyWorker>(plan);
  study::ProcessPool pool(processes, [&plan, worker](std::size_t task) {
    return study::linesOfUnit(*worker, plan, task);
  });
  return study::runStudy(plan, folder, pool, base::StopToken(), [](std::size_t, std::size_t) {});
}

}  // namespace grid_path_planner::test
