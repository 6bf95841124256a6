#include <gtest/gtest.h>

#include <exception>

#include "command_line/commands.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/ros/bag.h"
#include "run_command.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::command_line {

using grid::GridGeometry;
using grid::MapMode;
using grid::OccupancyGrid;
using grid::readMapFile;
using grid::writeMapServerFile;
using grid::writeMovingAiFile;
using nodes::readMapFromBag;

namespace {

using test::AsciiMap;
using test::contains;

class Convert : public testing::Test {
 protected:
  // What the command says of bad input, "" where it takes it.
  std::string convert(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "convert");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    try {
      EXPECT_EQ(runConvert(static_cast<int>(argv.size()), argv.data()), 0);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }
  std::string path(const std::string& name) const { return folder_.path(name); }

  const test::TemporaryFolder folder_;
  const OccupancyGrid map_ = AsciiMap({"..#", "?.."}, 0.05, {-1.0, 2.0, 0.0}).map;
};

TEST_F(Convert, ABagBecomesAMapServerFile) {
  const std::string bag = "test/data/projected_map.bag";
  EXPECT_EQ(convert({"--map", bag, "--output", path("a.yaml")}), "");
  EXPECT_EQ(readMapFile(path("a.yaml")), readMapFromBag(bag));
  EXPECT_EQ(folder_.endings(), (std::vector<std::string>{".pgm", ".yaml"}));
}

TEST_F(Convert, EveryFormatIsWritten) {
  writeMapServerFile(path("in.yaml"), map_);
  for (const char* name : {"out.yaml", "out.png", "out.pgm"}) {
    EXPECT_EQ(convert({"--map", path("in.yaml"), "--output", path(name)}), "");
    EXPECT_EQ(readMapFile(path(name)).values(), map_.values()) << name;
  }
  EXPECT_EQ(convert({"--map", path("in.yaml"), "--output", path("out.map")}), "");
  EXPECT_EQ(readMapFile(path("out.map")).values(), AsciiMap({"..#", "#.."}).map.values());
}

TEST_F(Convert, GeometryIsOverriddenAndNegativeNumbersParse) {
  writeMovingAiFile(path("in.map"), map_);
  EXPECT_EQ(convert({"--map", path("in.map"), "--output", path("out.yaml"), "--resolution", "0.5",
                     "--origin", "-1.5,-2,-0.25"}),
            "");
  EXPECT_EQ(readMapFile(path("out.yaml")).geometry(), GridGeometry(3, 2, 0.5, {-1.5, -2.0, -0.25}));
}

TEST_F(Convert, RawKeepsEveryValue) {
  OccupancyGrid map(GridGeometry(4, 1, 1.0), std::vector<std::int8_t>{-1, 3, 57, 100});
  writeMapServerFile(path("in.yaml"), map, MapMode::RAW);
  EXPECT_EQ(convert({"--map", path("in.yaml"), "--output", path("out.yaml"), "--mode", "raw"}), "");
  EXPECT_EQ(readMapFile(path("out.yaml")), map);
}

// The last blocks hold what is left of the map; conservative is what planning is safe on.
TEST_F(Convert, AKernelMakesBlocksOfCells) {
  const AsciiMap map({"..?#.",  //
                      "....?",  //
                      "??...",  //
                      "?#..."},
                     0.5, {-1.0, 2.0, 0.0});
  writeMapServerFile(path("in.yaml"), map.map);
  EXPECT_EQ(convert({"--map", path("in.yaml"), "--output", path("a.yaml"), "--kernel", "2"}), "");
  EXPECT_EQ(readMapFile(path("a.yaml")), AsciiMap({".#?", "#.."}, 1.0, {-1.0, 2.0, 0.0}).map);
  EXPECT_EQ(convert({"--map", path("in.yaml"), "--output", path("b.yaml"), "--kernel", "2",
                     "--kernel-rule", "filter2d"}),
            "");
  EXPECT_EQ(readMapFile(path("b.yaml")), AsciiMap({".#?", "..."}, 1.0, {-1.0, 2.0, 0.0}).map)
      << "one obstacle among three unknown cells vanishes";
}

TEST_F(Convert, BadInputIsNamedAndNothingIsWritten) {
  writeMovingAiFile(path("in.map"), map_);
  const auto errorWith = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--map", path("in.map")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return convert(arguments);
  };
  const std::string out = path("out.yaml");
  EXPECT_TRUE(contains(errorWith({}), "output"));
  EXPECT_TRUE(contains(errorWith({"--output", path("out.jpg")}), "must end in .yaml, .map"));
  EXPECT_TRUE(contains(errorWith({"--output", out, "--mode", "scale"}), "got 'scale'"));
  EXPECT_TRUE(contains(errorWith({"--output", path("o.map"), "--mode", "raw"}), "does not apply"));
  EXPECT_TRUE(contains(errorWith({"--output", out, "--resolution", "-0.05"}), "got -0.05"));
  EXPECT_TRUE(contains(errorWith({"--output", out, "--resolution", "nan"}), "got 'nan'"));
  EXPECT_TRUE(contains(errorWith({"--output", out, "--origin", "1,2"}), "--origin needs 3"));
  EXPECT_TRUE(contains(errorWith({"--output", out, "--kernel", "0"}), "kernel must be"));
  EXPECT_TRUE(contains(errorWith({"--output", out, "--kernel", "1.5"}), "whole number"));
  EXPECT_TRUE(contains(errorWith({"--output", out, "--kernel-rule", "mean"}), "got 'mean'"));
  EXPECT_TRUE(contains(errorWith({"--output", out, "--colour", "red"}), "colour"));
  EXPECT_TRUE(contains(errorWith({"--output", path("in.map/out.yaml")}), "Not a directory"));
  EXPECT_TRUE(contains(convert({"--map", path("none"), "--output", out}), "No such file"));
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"in.map"}));
}

class Waypoints : public testing::Test {
 protected:
  Outcome waypoints(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "waypoints");
    return runCommand(runWaypoints, arguments);
  }

  const test::TemporaryFolder folder_;
  const std::string csv_ = folder_.write("a.csv", "1,2\n3,4,5\n");
};

TEST_F(Waypoints, GoFromFormatToFormat) {
  const std::string csv = folder_.write("a.csv", "x,y,z,yaw\n1,2,3,0.5\n4,5,6,1.5\n");
  const std::string datum = "53.5,8.1,0.3,3";
  std::string from = csv;
  for (const char* to : {"b.geojson", "c.yaml", "d.csv"}) {
    const Outcome outcome =
        waypoints({"--input", from, "--output", folder_.path(to), "--datum", datum});
    ASSERT_EQ(outcome.code, 0) << to << ": " << outcome.error;
    from = folder_.path(to);
  }
  ASSERT_EQ(waypoints({"--input", from, "--to", "uuv", "--output", folder_.path("e.yaml")}).code,
            0);
  const Outcome last = waypoints(
      {"--input", folder_.path("e.yaml"), "--output", folder_.path("f.yaml"), "--frame", "map"});
  ASSERT_EQ(last.code, 0) << last.error;
  EXPECT_EQ(last.printed, "2 waypoints, uuv to planner\n");
  const path::Path path = path::readWaypointFile(folder_.path("f.yaml")).path;
  ASSERT_EQ(path.poses.size(), 2u);
  EXPECT_EQ(path.frame_id, "map");
  EXPECT_LT((path.poses[1].position - Eigen::Vector3d(4, 5, 6)).norm(), 1e-5);
  EXPECT_NEAR(path.poses[1].yaw, 1.5, 1e-6);
}

TEST_F(Waypoints, ARoundTripIsRepeatedWithoutAStopAtItsStart) {
  const std::string round = folder_.write("r.csv", "0,0\n5,0\n5,5\n0,0\n");
  const std::string line = folder_.write("l.csv", "0,0\n5,0\n");
  EXPECT_EQ(waypoints({"--input", round, "--output", folder_.path("s.csv"), "--laps", "3"}).printed,
            "10 waypoints, csv to csv\n");
  EXPECT_EQ(waypoints({"--input", line, "--output", folder_.path("m.csv"), "--laps", "3"}).printed,
            "6 waypoints, csv to csv\n");
  for (const char* laps : {"0", "-1", "1.5", "1000000"})
    EXPECT_TRUE(contains(
        waypoints({"--input", line, "--output", folder_.path("n.csv"), "--laps", laps}).error,
        "--laps"));
}

TEST_F(Waypoints, RefusalsSayWhatIsWrong) {
  const std::string good = folder_.write("b.csv", "1,2\n");
  const auto error = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = waypoints(arguments);
    EXPECT_EQ(outcome.code, kBadInput);
    return outcome.error;
  };
  EXPECT_TRUE(contains(error({"--input", csv_, "--output", folder_.path("c.yaml")}), "a.csv:2: "));
  EXPECT_TRUE(contains(error({"--input", good, "--output", folder_.path("c.geojson")}), "datum"));
  EXPECT_TRUE(contains(error({"--input", good, "--output", folder_.path("c.doc")}), "must end in"));
  EXPECT_TRUE(
      contains(error({"--input", good, "--output", folder_.path("c.json"), "--datum", "100,0"}),
               "latitude"));
  EXPECT_TRUE(contains(
      error({"--input", good, "--output", folder_.path("c.yaml"), "--from", "kml"}), "--from"));
  EXPECT_EQ(folder_.endings(), (std::vector<std::string>{".csv", ".csv"})) << "nothing is written";
}

}  // namespace
}  // namespace grid_path_planner::command_line
