#include "fuzz/fuzz_target.h"
#include "study/study.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfStudies() {
  return {
      "title: One\nmaps:\n  - {name: a, file: a.map}\nplanners: [a_star, dijkstra]\n"
      "heuristics: [octile, zero]\nkernels: [1, 3]\nkernel_rules: [filter2d]\n"
      "weights: [[1, 50, 100]]\nqueries: {random: {count: 9, seed: 3}}\nrepeats: 3\n",
      "maps: [a.map]\noptions: {radius: 0.4, cut_corners: true}\n"
      "queries: {pairs: [[[0, 0], [3, 4]]]}\n"};
}

FUZZ_TARGET(study_file, seedsOfStudies) {
  mayRefuse([&] { study::readStudyFile(fileOf("fuzz.yaml", input)); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
