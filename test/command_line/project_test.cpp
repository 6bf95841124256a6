#include <gtest/gtest.h>

#include <exception>

#include "command_line/commands.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/mapping/octree_map.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::command_line {

using grid::GridGeometry;
using grid::OccupancyGrid;
using grid::readMapFile;
using mapping::OctreeMap;
using mapping::OctreeOptions;
using mapping::Scan;

namespace {

using test::contains;

class Project : public testing::Test {
 protected:
  // A wall at x = 1 from z = 0 to 1 m, seen from (-1, 0, 0.5), on ground at z = 0.
  Project() {
    OctreeOptions options;
    options.resolution = 0.1;
    OctreeMap map(options);
    Scan scan;
    scan.origin = {-0.95F, 0.05F, 0.45F};
    for (int i = 0; i <= 10; ++i) scan.hits.emplace_back(1.05F, 0.05F, 0.05F + 0.1F * i);
    for (int i = 0; i < 19; ++i) scan.hits.emplace_back(-0.85F + 0.1F * i, 0.05F, -0.05F);
    map.insert(scan);
    map.save(octree_);
  }
  // What the command says of bad input, "" where it takes it.
  std::string project(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"project", "--octree", octree_, "--map", map_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    try {
      EXPECT_EQ(runProject(static_cast<int>(argv.size()), argv.data()), 0);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }
  // The value of the map at (x, 0.05); -1 outside of it.
  int valueAt(double x) const {
    const OccupancyGrid map = readMapFile(map_);
    const auto cell = map.geometry().cellAt({x, 0.05});
    return cell ? map[*cell] : -1;
  }

  const test::TemporaryFolder folder_;
  const std::string octree_ = folder_.path("tree.bt");
  const std::string map_ = folder_.path("map.yaml");
};

TEST_F(Project, ABandBecomesAMapServerFile) {
  EXPECT_EQ(project({"--min-z", "0.3", "--max-z", "0.8"}), "");
  EXPECT_EQ(valueAt(1.05), 100);
  EXPECT_EQ(valueAt(0.05), 0);
  EXPECT_EQ(valueAt(1.25), -1);
  EXPECT_EQ(folder_.endings(), (std::vector<std::string>{".bt", ".pgm", ".yaml"}));
}

TEST_F(Project, NegativeHeightsBoundsAndPictures) {
  EXPECT_EQ(project({"--min-z", "-0.2", "--max-z", "-0.01", "--bounds", "-0.5,-0.5,1.5,0.5",
                     "--image", folder_.path("map.png")}),
            "");
  EXPECT_EQ(valueAt(0.05), 100) << "the ground";
  const GridGeometry geometry = readMapFile(map_).geometry();
  EXPECT_EQ(geometry, GridGeometry(20, 10, 0.1, {-0.5, -0.5, 0.0}));
  EXPECT_EQ(readMapFile(folder_.path("map.png")).values(), readMapFile(map_).values());
}

TEST_F(Project, HeightsAboveTheSeabedAndAboutTheVehicle) {
  EXPECT_EQ(project({"--min-z", "0.2", "--max-z", "5", "--reference", "seabed"}), "");
  EXPECT_EQ(valueAt(1.05), 100);
  EXPECT_NE(valueAt(0.05), 100) << "ground is no obstacle";
  EXPECT_EQ(
      project({"--min-z", "-0.1", "--max-z", "0.1", "--reference", "vehicle", "--vehicle-z", "0"}),
      "");
  EXPECT_EQ(valueAt(0.05), 100);
}

TEST_F(Project, BadInputIsNamedAndNothingIsWritten) {
  EXPECT_TRUE(contains(project({"--min-z", "0"}), "max-z"));
  EXPECT_TRUE(contains(project({"--min-z", "1", "--max-z", "0"}), "min_z below its max_z"));
  EXPECT_TRUE(contains(project({"--min-z", "x", "--max-z", "0"}), "got 'x'"));
  const std::vector<std::string> band = {"--min-z", "0", "--max-z", "1"};
  const auto errorWith = [&](std::vector<std::string> more) {
    more.insert(more.end(), band.begin(), band.end());
    return project(more);
  };
  EXPECT_TRUE(contains(errorWith({"--bounds", "1,2,3"}), "--bounds needs 4"));
  EXPECT_TRUE(contains(errorWith({"--bounds", "3,0,1,1"}), "projection_bounds"));
  EXPECT_TRUE(contains(errorWith({"--reference", "sky"}), "got 'sky'"));
  EXPECT_TRUE(contains(errorWith({"--reference", "vehicle"}), "--vehicle-z"));
  EXPECT_TRUE(contains(errorWith({"--image", "map.jpg"}), "got 'map.jpg'"));
  std::vector<std::string> missing = {"project", "--octree", "/no/tree.bt", "--map", map_,
                                      "--min-z", "0",        "--max-z",     "1"};
  std::vector<char*> argv;
  for (std::string& argument : missing) argv.push_back(argument.data());
  EXPECT_TRUE(
      contains(test::errorText([&] { runProject(static_cast<int>(argv.size()), argv.data()); }),
               "/no/tree.bt"));
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"tree.bt"}));
}

}  // namespace
}  // namespace grid_path_planner::command_line
