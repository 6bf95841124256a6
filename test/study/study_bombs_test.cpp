// Study and scenario files that ask for much with little.
#include <gtest/gtest.h>

#include "grid_path_planner/study/scenario_file.h"
#include "study/study.h"
#include "support/bombs.h"
#include "support/bounded_run.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::study {
namespace {

using test::BoundedRun;
using test::contains;
using test::repeated;

class StudyBombs : public testing::Test {
 protected:
  template <class Read>
  BoundedRun reading(const std::string& name, const std::string& content, const Read& read) const {
    const std::string file = folder_.write(name, content);
    const BoundedRun run = test::runBounded([&] { read(file); });
    EXPECT_TRUE(run.ended) << run;
    EXPECT_TRUE(contains(run.refusal, file)) << run;
    EXPECT_LT(run.megabytes, 2100.0) << run;
    EXPECT_LT(run.cpu_seconds, 60.0) << run;
    return run;
  }

  const test::TemporaryFolder folder_;
};

TEST_F(StudyBombs, CombinationsAreCountedBeforeTheyAreMade) {
  std::string maps, weights;
  for (int i = 0; i < 2000; ++i) {
    maps += "m" + std::to_string(i) + ".map, ";
    weights += "[1, 1, " + std::to_string(i + 1) + "], ";
  }
  const BoundedRun run = reading("bomb.yaml",
                                 "maps: [" + maps + "]\nplanners: [dijkstra]\nweights: [" +
                                     weights + "]\nqueries: {pairs: [[[0, 0], [1, 1]]]}\n",
                                 [](const std::string& file) { readStudyFile(file); });
  EXPECT_TRUE(contains(run.refusal, "combinations")) << run;
}

TEST_F(StudyBombs, PairsOfEveryMapAreCountedBeforeTheyAreCopied) {
  std::string maps;
  for (int i = 0; i < 20000; ++i) maps += "m" + std::to_string(i) + ".map, ";
  const std::string text = "queries: {pairs: [&a [[0, 0], [1, 1]]" + repeated(", *a", 20000) +
                           "]}\nmaps: [" + maps + "]\nplanners: [dijkstra]\n";
  reading("bomb.yaml", text, [](const std::string& file) { readStudyFile(file); });
}

TEST_F(StudyBombs, ScenariosAreCounted) {
  base::ReadOptions options;
  options.read_memory_limit = 50;
  const BoundedRun run =
      reading("bomb.scen", "version 1\n" + repeated("0 m 1 1 0 0 0 0 0\n", 500000),
              [&](const std::string& file) { readScenarioFile(file, options); });
  EXPECT_TRUE(contains(run.refusal, "read_memory_limit")) << run;
  EXPECT_LT(run.megabytes, 70.0) << run;
}

}  // namespace
}  // namespace grid_path_planner::study
