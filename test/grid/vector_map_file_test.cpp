#include <gtest/gtest.h>

#include <algorithm>

#include "grid_path_planner/grid/map_file.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::grid {
namespace {

using test::AsciiMap;
using test::contains;
using test::errorText;

// Drawings have y up, so the first line of their picture is the last row.
std::vector<std::int8_t> picture(std::vector<std::string> lines) {
  std::reverse(lines.begin(), lines.end());
  return AsciiMap(lines).map.values();
}

class VectorMapFile : public testing::Test {
 protected:
  OccupancyGrid read(const std::string& obstacles, const MapFileOptions& options = {}) {
    return readMapFile(folder_.write("a.yaml",
                                     "vector_map:\n  size: [8, 5]\n  resolution: 1\n"
                                     "  obstacles:\n" +
                                         obstacles),
                       options);
  }
  std::string errorOf(const std::string& text) {
    return errorText([&] { readMapFile(folder_.write("a.yaml", text)); });
  }
  std::string errorOfObstacle(const std::string& obstacle) {
    return errorOf("vector_map:\n  size: [8, 5]\n  resolution: 1\n  obstacles:\n    - " + obstacle);
  }

  const test::TemporaryFolder folder_;
};

TEST_F(VectorMapFile, CellsWhoseCentresLieInAnObstacleAreOccupied) {
  EXPECT_EQ(read("    - polygon: [[0, 0], [4, 0], [0, 4]]\n").values(),
            picture({"........",  //
                     "#.......",  //
                     "##......",  //
                     "###.....",  //
                     "####...."}))
      << "centres on the rim are in it";
  EXPECT_EQ(read("    - circle: {centre: [6, 2], radius: 1}\n").values(),
            picture({"........",  //
                     "........",  //
                     ".....##.",  //
                     ".....##.",  //
                     "........"}));
  EXPECT_EQ(read("    - wall: {points: [[1, 1.5], [5.5, 1.5], [5.5, 4]], thickness: 1}\n").values(),
            picture({".....#..",  //
                     ".....#..",  //
                     ".....#..",  //
                     "######..",  //
                     "........"}));
  EXPECT_EQ(rowOrderOf(folder_.path("a.yaml")), RowOrder::FIRST_ROW_FIRST);
}

TEST_F(VectorMapFile, ObstaclesMayOverlapAndLeaveTheMap) {
  EXPECT_EQ(read("    - polygon: [[-3, -3], [2, -3], [2, 2], [-3, 2]]\n"
                 "    - polygon: [[1, 1], [99, 1], [99, 99]]\n"
                 "    - circle: {centre: [-50, 2], radius: 2}\n")
                .values(),
            picture({"....####",  //
                     "...#####",  //
                     "..######",  //
                     "########",  //
                     "##......"}));
}

// The same drawing at any resolution: what is free hardly changes its share.
TEST_F(VectorMapFile, TheResolutionIsTheReaders) {
  MapFileOptions options;
  options.resolution = 0.01;
  const OccupancyGrid fine = read("    - circle: {centre: [4, 2.5], radius: 2}\n", options);
  EXPECT_EQ(fine.geometry(), GridGeometry(800, 500, 0.01));
  const auto& values = fine.values();
  EXPECT_NEAR(std::count(values.begin(), values.end(), 100) * 1e-4, 3.14159 * 4.0, 0.01);
  options.resolution = 3.0;
  EXPECT_EQ(read("    []\n", options).geometry(), GridGeometry(3, 2, 3.0));
}

// From a newcomer, whose path led through a thin wall.
TEST_F(VectorMapFile, WallsThatMayHaveGapsAreWarnedOf) {
  std::string warning;
  MapFileOptions options;
  options.warn = [&warning](const std::string& text) { warning += text; };
  const std::string obstacles =
      "    - wall: {points: [[0, 1], [8, 3]], thickness: 0.6}\n"
      "    - circle: {centre: [4, 2], radius: 0.8}\n";
  read(obstacles, options);
  EXPECT_TRUE(contains(warning, "1 of its walls and circles are thinner")) << warning;
  warning.clear();
  options.resolution = 0.25;
  read(obstacles, options);
  EXPECT_EQ(warning, "");
}

TEST_F(VectorMapFile, MistakesAreToldWithFileAndLine) {
  const auto expect = [](const std::string& error, const char* text) {
    EXPECT_TRUE(contains(error, text)) << error;
    EXPECT_TRUE(contains(error, "a.yaml")) << error;
  };
  expect(errorOfObstacle("polygon: [[0, 0], [1, 1]]"),
         "a.yaml:5: polygon must be a list of at least");
  expect(errorOfObstacle("polygon: [[0, 0], [1, 1], [2]]"), "polygon must be a list of x and y");
  expect(errorOfObstacle("polygon: [[0, 0], [1, 1], [2, .nan]]"), "polygon must be a number");
  expect(errorOfObstacle("circle: {centre: [1, 1], radius: -1}"), "radius must be a positive");
  expect(errorOfObstacle("circle: {radius: 1}"), "centre");
  expect(errorOfObstacle("wall: {points: [[1, 1], [2, 2]]}"), "thickness");
  expect(errorOfObstacle("square: 3"), "one of polygon, circle and wall, got 'square'");
  expect(errorOfObstacle("3"), "an obstacle must be one of polygon");
  expect(errorOfObstacle("{polygon: [[0, 0], [1, 1], [2, 0]], circle: 3}"), "got 2 entries");
  expect(errorOf("vector_map: {size: [8, 5], origin: [0, 0], obstacles: []}\n"), "got 'origin'");
  expect(errorOf("vector_map: {[8, 5]: 1}\n"), "got a list");  // an exception of yaml-cpp went on
  expect(errorOfObstacle("{[1, 1]: circle}"), "got a list");
  expect(errorOf("vector_map: 3\n"), "size");
  expect(errorOf("vector_map: {size: [8, 5], obstacles: []}\n"), "resolution");
  expect(errorOf("vector_map: {size: [8, 5], resolution: 0, obstacles: []}\n"), "resolution");
  expect(errorOf("vector_map: {size: [8, 5], resolution: 1, obstacles: 3}\n"),
         "obstacles must be a list");
  expect(errorOf("vector_map: {size: [8, -5], resolution: 1, obstacles: []}\n"),
         "-5 m do not make a map");
  expect(errorOf("vector_map: {size: [8, 5], resolution: 1e-300, obstacles: []}\n"),
         "do not make a map");
}

}  // namespace
}  // namespace grid_path_planner::grid
