// Waypoint files that name few waypoints very often, or are trees of something else.
#include <gtest/gtest.h>

#include "grid_path_planner/path/waypoint_file.h"
#include "support/bombs.h"
#include "support/bounded_run.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::path {
namespace {

using test::BoundedRun;
using test::contains;
using test::repeated;

class WaypointBombs : public testing::Test {
 protected:
  BoundedRun reading(const std::string& content, double seconds) const {
    const std::string file = folder_.write("bomb.yaml", content);
    base::ReadOptions options;
    options.read_memory_limit = 100;
    options.read_time_limit = seconds;
    const BoundedRun run = test::runBounded([&] { readWaypointFile(file, options); });
    EXPECT_TRUE(run.ended) << run;
    EXPECT_LT(run.megabytes, 130.0) << run;
    EXPECT_LT(run.cpu_seconds, 60.0) << run;
    return run;
  }

  const test::TemporaryFolder folder_;
};

TEST_F(WaypointBombs, WaypointsThatAreNamedAgainAndAgainEndWithTheTime) {
  std::string others;
  for (int i = 0; i < 2000; ++i) others += "k" + std::to_string(i) + ": 0, ";
  const std::string pose =
      "&a {" + others + "position: {x: 0, y: 0, z: 0}, orientation: {x: 0, y: 0, z: 0, w: 1}}";
  const BoundedRun run = reading("waypoints: [" + pose + repeated(", *a", 300000) + "]\n", 3.0);
  EXPECT_TRUE(contains(run.refusal, "read_time_limit")) << run;
}

TEST_F(WaypointBombs, TreesAreCountedBeforeTheyAreBuilt) {
  const BoundedRun run = reading("waypoints: [" + repeated("{},", 400000) + "0]\n", 20.0);
  EXPECT_TRUE(contains(run.refusal, "read_memory_limit")) << run;
}

TEST_F(WaypointBombs, PlainWaypointsTakeLessThanTheirTextTwice) {
  const std::string pose =
      "  - position: {x: 0.0, y: 0.0, z: 0.0}\n    orientation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}\n";
  const std::string text = "header: {frame_id: map}\nwaypoints:\n" + repeated(pose, 120000);
  const BoundedRun run = reading(text, 30.0);
  EXPECT_EQ(run.refusal, "");
  EXPECT_LT(run.megabytes, 3e-6 * static_cast<double>(text.size()) + 10.0) << run;
}

}  // namespace
}  // namespace grid_path_planner::path
