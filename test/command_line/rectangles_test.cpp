#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/planners/rectangle_file.h"
#include "run_command.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::command_line {

using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;
using grid::readMapFile;
using grid::writeImageFile;
using grid::writeMapServerFile;
using planners::readRectangleFile;
using planners::RectangleGraph;
using planners::Touching;

namespace {

using nlohmann::json;
using test::contains;

// The worked example of the published R-map.
class Rectangles : public testing::Test {
 protected:
  Outcome run(const std::vector<std::string>& arguments, const std::string& map = "") {
    std::vector<std::string> all = {"rectangles", "--map", map.empty() ? map_ : map};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return runCommand(runRectangles, all);
  }
  json objectOf(const std::vector<std::string>& arguments, const std::string& map = "") {
    const Outcome outcome = run(arguments, map);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    return json::parse(outcome.printed);
  }

  const test::TemporaryFolder folder_;
  const std::string map_ = folder_.write("example.map",
                                         "type octile\nheight 10\nwidth 10\nmap\n"
                                         "..@@......\n"
                                         "..@@...@@@\n"
                                         "...@...@@@\n"
                                         "..........\n"
                                         "..@@@@@...\n"
                                         "..@@@@@...\n"
                                         "..@@@@@.@@\n"
                                         "........@@\n"
                                         "@@@@....@@\n"
                                         "........@@\n");
  const json published_ = json::parse(
      "[[0,0,2,8],[4,0,3,4],[4,7,4,3],[7,3,3,3],[0,9,4,1],[7,0,3,1],[2,3,2,1],[2,7,2,1],[2,2,1,1],"
      "[7,6,1,1]]");
};

TEST_F(Rectangles, TheJsonHoldsThePublishedOnes) {
  const json object = objectOf({"--json"});
  EXPECT_EQ(object["count"], 10);
  EXPECT_EQ(object["rectangles"], published_);
  EXPECT_EQ(object["cells"], 100);
  EXPECT_EQ(object["cells_in_rectangles"], 62);
  EXPECT_EQ(object["connections"], 11);
  EXPECT_EQ(object["sizes"]["entire_map"], 13);
  EXPECT_EQ(object["bytes"], object["sizes"]["file"]);
  EXPECT_GE(object["time_ms"], 0.0);
  EXPECT_FALSE(object.contains("weights"));
}

// The first row of a picture is the uppermost, that of a .map is row 0: the output follows the file.
TEST_F(Rectangles, ThePictureOfTheMapGivesTheSame) {
  const OccupancyGrid map = readMapFile(map_);
  OccupancyGrid turned(map.geometry());
  for (int row = 0; row < 10; ++row) std::copy_n(map.row(row), 10, turned.row(9 - row));
  for (const char* name : {"a.pgm", "a.png"}) {
    writeImageFile(folder_.path(name), turned);
    EXPECT_EQ(objectOf({"--json"}, folder_.path(name))["rectangles"], published_) << name;
  }
  writeMapServerFile(folder_.path("b.yaml"), turned);
  const json object =
      objectOf({"--json", "--output", folder_.path("b.rectangles")}, folder_.path("b.yaml"));
  EXPECT_EQ(object["rectangles"], published_);
  const RectangleGraph read = readRectangleFile(folder_.path("b.rectangles"), Touching::BORDERS);
  EXPECT_EQ(read.rectangles().front(), (CellRect{0, 2, 2, 8})) << "rows as in Cell";
  EXPECT_EQ(read.freeCells(), 62u);
  EXPECT_EQ(readMapFile(folder_.path("b.rectangles")), turned);
  EXPECT_EQ(objectOf({"--json"}, folder_.path("b.rectangles"))["cells_in_rectangles"], 62);
}

TEST_F(Rectangles, ALimitEndsTheWorkEarlier) {
  EXPECT_EQ(objectOf({"--json", "--limit", "3"})["rectangles"],
            json(std::vector<json>(published_.begin(), published_.begin() + 3)));
  EXPECT_EQ(objectOf({"--json", "--limit", "99"})["count"], 10);
  EXPECT_EQ(objectOf({"--json", "--min-area", "3"})["count"], 6);
  EXPECT_EQ(objectOf({"--json", "--min-area", "1000"})["count"], 0);
  for (const char* wrong : {"0", "-1", "1.5", "x"}) {
    EXPECT_TRUE(contains(run({"--limit", wrong}).error, "limit")) << wrong;
    EXPECT_TRUE(contains(run({"--min-area", wrong}).error, "min-area")) << wrong;
  }
  EXPECT_TRUE(contains(run({"--limit", "3", "--min-area", "3"}).error, "do not go together"));
}

TEST_F(Rectangles, WeightsAreThoseOfTheConnections) {
  const json distances = objectOf({"--json", "--weight", "distance"})["weights"];
  ASSERT_EQ(distances.size(), 22u) << "both directions";
  EXPECT_EQ(distances[0][0], 0);
  EXPECT_EQ(distances[0][1], 6);
  EXPECT_NEAR(distances[0][2].get<double>(), 2.0616, 5e-5);
  EXPECT_EQ(objectOf({"--json", "--weight", "area"})["weights"][1], json({0, 7, 8.0}));
  EXPECT_TRUE(contains(run({"--weight", "connections"}).printed, "\n1 -> 7: 0.333333\n"));
  const json lengths = objectOf({"--json", "--weight", "length"})["weights"];
  ASSERT_EQ(lengths.size(), distances.size());
  for (std::size_t i = 0; i < lengths.size(); ++i)
    EXPECT_GE(lengths[i][2].get<double>(), distances[i][2].get<double>() - 1e-9) << i;
  // 1 to 7: from (1, 4) to cell (1, 3), into (2, 3) and to (3, 3.5).
  EXPECT_NEAR(lengths[0][2].get<double>(), std::hypot(0.5, 0.5) + 1.0 + 0.5, 1e-9);
  EXPECT_TRUE(contains(run({"--weight", "colour"}).error, "colour"));
  const std::string diagonal =
      folder_.write("diagonal.map", "type octile\nheight 2\nwidth 2\nmap\n.@\n@.\n");
  EXPECT_EQ(objectOf({"--json"}, diagonal)["connections"], 0);
  EXPECT_EQ(objectOf({"--json", "--corners", "--weight", "area"}, diagonal)["weights"],
            json::parse("[[0,1,2.0],[1,0,1.0]]"));
}

// Thousands of lines scrolled the answer away.
TEST_F(Rectangles, OfManyConnectionsAFewAreTold) {
  std::string checkered = "type octile\nheight 9\nwidth 9\nmap\n";
  for (int row = 0; row < 9; ++row) checkered += row % 2 == 0 ? ".........\n" : ".@.@.@.@.\n";
  const std::string map = folder_.write("checkered.map", checkered);
  const std::size_t all = objectOf({"--json", "--weight", "area"}, map)["weights"].size();
  ASSERT_GT(all, 40u);
  const std::string told = run({"--weight", "area"}, map).printed;
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 2 + 10 + 1) << told;
  EXPECT_TRUE(contains(told, "... and " + std::to_string(all - 10) + " more: --json")) << told;
}

TEST_F(Rectangles, UnknownCellsAreFreeIfAskedFor) {
  OccupancyGrid map(GridGeometry(4, 1, 1.0), 0);
  map[Cell{1, 0}] = -1;
  map[Cell{3, 0}] = 100;
  writeMapServerFile(folder_.path("c.yaml"), map);
  EXPECT_EQ(objectOf({"--json"}, folder_.path("c.yaml"))["rectangles"],
            json::parse("[[0,0,1,1],[2,0,1,1]]"));
  EXPECT_EQ(objectOf({"--json", "--unknown-is-free"}, folder_.path("c.yaml"))["rectangles"],
            json::parse("[[0,0,3,1]]"));
}

TEST_F(Rectangles, AnotherPartitionIsNamed) {
  EXPECT_GE(objectOf({"--json", "--partition", "merged_runs"})["count"], 9);
  EXPECT_TRUE(contains(run({"--partition", "best"}).error, "largest_first or merged_runs"));
  EXPECT_TRUE(contains(run({"--partition", "merged_runs", "--limit", "3"}).error, "largest_first"));
}

TEST_F(Rectangles, AMapThatNeedsMoreMemoryIsRefusedBefore) {
  const std::string wide =
      folder_.write("wide.yaml", "vector_map: {size: [4000, 4000], resolution: 1, obstacles: []}");
  EXPECT_TRUE(contains(run({"--memory-limit", "1"}, wide).error, "more than --memory-limit 1"));
}

TEST_F(Rectangles, ThePictureIsWritten) {
  const std::string image = folder_.path("example.png");
  EXPECT_EQ(run({"--image", image, "--weight", "distance"}).code, 0);
  EXPECT_GT(test::contentOf(image).size(), 1000u);
}

}  // namespace
}  // namespace grid_path_planner::command_line
