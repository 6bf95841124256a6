// Maps of a few bytes that ask for gigabytes or hours: each is answered or refused, within what the
// limits of reading allow.
#include <gtest/gtest.h>

#include <cmath>

#include "grid/formats/rectangle_map_file.h"
#include "grid_path_planner/base/yaml_file.h"
#include "grid_path_planner/grid/map_file.h"
#include "support/bombs.h"
#include "support/bounded_run.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::grid {
namespace {

using test::BoundedRun;
using test::contains;
using test::repeated;

constexpr int kMegabytes = 200;  // of the limit

// A drawing of size x size cells.
std::string drawingOf(const std::string& size, const std::string& obstacles) {
  return "vector_map: {size: [" + size + ", " + size + "], resolution: 1, obstacles: [" +
         obstacles + "]}\n";
}

// Corners of a polygon of that radius around the middle of a map of twice the side.
std::string starOf(int corners, double radius) {
  std::string points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * i / corners, reach = i % 2 == 0 ? radius : 0.3 * radius;
    points += (i == 0 ? "[" : ", [") + std::to_string(radius + reach * std::cos(angle)) + ", " +
              std::to_string(radius + reach * std::sin(angle)) + "]";
  }
  return points;
}

class MapBombs : public testing::Test {
 protected:
  // Of reading `content` under a small limit of memory.
  BoundedRun reading(const std::string& name, const std::string& content, double seconds = 20.0) {
    const std::string file = folder_.write(name, content);
    base::ReadOptions options;
    options.read_memory_limit = kMegabytes;
    options.read_time_limit = seconds;
    return test::runBounded([&] {
      MapFileOptions map;
      map.limits = options;
      readMapFile(file, map);
    });
  }
  // Beside the limit some is taken that a reader's libraries need whatever they read.
  void expectBounded(const BoundedRun& run) {
    EXPECT_TRUE(run.ended) << run;
    EXPECT_LT(run.megabytes, kMegabytes + 60.0) << run;
    EXPECT_LT(run.cpu_seconds, 60.0) << run;
  }
  void expectTooLarge(const std::string& name, const std::string& content) {
    const BoundedRun run = reading(name, content);
    expectBounded(run);
    EXPECT_TRUE(contains(run.refusal, name)) << run;
    EXPECT_TRUE(contains(run.refusal, "read_memory_limit")) << run;
    EXPECT_LT(run.megabytes, kMegabytes) << run;
  }

  const test::TemporaryFolder folder_;
};

TEST_F(MapBombs, ADrawingOfTwoThousandMillionCellsIsRefusedBeforeTheyAreMade) {
  expectTooLarge("huge.yaml", drawingOf("46340", ""));
  expectTooLarge("fine.yaml", "vector_map: {size: [4, 4], resolution: 1e-4, obstacles: []}\n");
}

TEST_F(MapBombs, ObstaclesThatAreNamedAgainAndAgainEndWithTheTime) {
  const std::string once = "&a {polygon: [" + starOf(600, 2000) + "]}";
  for (const char* shape :
       {"&a {circle: {centre: [2000, 2000], radius: 1999}}",
        "&a {wall: {points: [[0, 0], [4000, 4000]], thickness: 900}}", once.c_str()}) {
    const BoundedRun run =
        reading("again.yaml", drawingOf("4000", shape + repeated(", *a", 10000)), 1.0);
    expectBounded(run);
    EXPECT_TRUE(contains(run.refusal, "read_time_limit")) << run;
    EXPECT_LT(run.cpu_seconds, 15.0) << run;
  }
}

TEST_F(MapBombs, PointsThatAreNamedAgainAndAgainEndWithTheTime) {
  const std::string points = "&p [0, 0], [9, 0], [9, 9]" + repeated(", *p", 12000);
  const std::string polygon = "&a {polygon: [" + points + "]}";
  const BoundedRun run =
      reading("points.yaml", drawingOf("10", polygon + repeated(", *a", 12000)), 2.0);
  expectBounded(run);
  EXPECT_TRUE(contains(run.refusal, "read_time_limit")) << run;
}

TEST_F(MapBombs, APolygonOfThreeThousandCornersOnSixteenMillionCellsTakesLessThanTwoSeconds) {
  constexpr double kBusyMachine = 300.0;  // s by the clock; the processor's are what counts here
  const BoundedRun run = reading(
      "star.yaml", drawingOf("4000", "polygon: [" + starOf(3000, 2000) + "]"), kBusyMachine);
  expectBounded(run);
  EXPECT_EQ(run.refusal, "");
  EXPECT_LT(run.cpu_seconds, test::hasShadowMemory() ? 20.0 : 2.0) << run;
}

TEST_F(MapBombs, ImagesAreRefusedBeforeTheirPixelsAreMade) {
  expectTooLarge("colours.png", test::plainPng(12000, 12000, 4));
  expectTooLarge("laced.png", test::plainPng(15000, 15000, 1, true));
  expectTooLarge("packed.bmp", test::packedBmp(30000, 30000));
  expectTooLarge("packed.tif", test::tiffHeader(30000, 30000, 8, 30000));
  expectTooLarge("strip.tif", test::tiffHeader(12000, 5, 1, 65000));
  constexpr std::size_t kColours = 66, kRows = 102;  // where these entries are
  std::string twice = test::tiffHeader(12000, 5, 1, 1);
  twice.replace(kColours, 12, test::tiffHeader(12000, 5, 1, 65000).substr(kRows, 12));
  expectTooLarge("twice.tif", twice);
  std::string typed = test::tiffHeader(12000, 5, 1, 65000);
  typed[kRows + 2] = 9;  // a number with a sign
  EXPECT_TRUE(contains(reading("typed.tif", typed).refusal, "a type that is not meant for it"));
  EXPECT_TRUE(
      contains(reading("codec.tif", test::tiffHeader(64, 64, 34925, 64)).refusal, "compression"));
}

TEST_F(MapBombs, AnImageThatFitsTakesItsPixelsAndItsCells) {
  const BoundedRun run = reading("fits.png", test::plainPng(8000, 8000, 1));
  expectBounded(run);
  EXPECT_EQ(run.refusal, "");
}

TEST_F(MapBombs, TheImageOfAYamlFileCountsToo) {
  folder_.write("large.png", test::plainPng(15000, 15000, 1));
  expectTooLarge("map.yaml", "image: large.png\nresolution: 0.05\norigin: [0, 0, 0]\n");
}

TEST_F(MapBombs, ATreeOfYamlIsCountedBeforeItIsBuilt) {
  for (const char* entry : {"0,", "[],", "{},", "{a},", "&a 0,", "!a 0,", "? 0,"})
    expectTooLarge("tree.yaml", "a: [" + repeated(entry, 600000) + "0]\n");
  expectTooLarge("lines.yaml", repeated("-\n", 600000));
  std::string keys;
  for (int i = 0; i < 400000; ++i) keys += std::to_string(i) + ":\n";
  expectTooLarge("keys.yaml", keys);
}

TEST_F(MapBombs, YamlThatIsSlowEndsWithTheTime) {
  const BoundedRun run = reading("slow.yaml", "a: [" + repeated("0,", 300000) + "0]\n", 0.05);
  expectBounded(run);
  EXPECT_TRUE(contains(run.refusal, "read_time_limit")) << run;
}

TEST_F(MapBombs, RectanglesAsLargeAsTheMapAreRefusedBeforeItsCellsAreMade) {
  expectTooLarge("one.rectangles",
                 rectangleMapContent({GridGeometry(40000, 40000, 1.0), {{0, 0, 40000, 40000}}}));
}

TEST_F(MapBombs, RectanglesThatUnpackToManyAreCounted) {
  const GridGeometry geometry(2000, 4000, 1.0);
  std::vector<CellRect> rectangles;
  for (int row = 0; row < 4000; row += 2)
    for (int column = 0; column < 2000; column += 2) rectangles.push_back({column, row, 1, 1});
  const std::string content = rectangleMapContent({geometry, rectangles});
  EXPECT_LT(content.size(), 200000u);
  expectTooLarge("many.rectangles", content);
}

TEST_F(MapBombs, TextIsReadInProportionToItsLength) {
  const std::string row(4000, '.');
  const BoundedRun text =
      reading("a.map", "type octile\nheight 4000\nwidth 4000\nmap\n" + repeated(row + "\n", 4000));
  expectBounded(text);
  EXPECT_EQ(text.refusal, "");
  EXPECT_LT(text.megabytes, 4 * 16.0) << text;
  const BoundedRun dump =
      reading("dump.yaml", "info: 3\ndata: [" + repeated("0,", 8000000) + "0]\n");
  expectBounded(dump);
  EXPECT_LT(dump.megabytes, 4 * 16.0) << dump;
  const BoundedRun text_image = reading("a.pbm", "P1 4000 4000\n" + repeated("1", 16000000));
  expectBounded(text_image);
  EXPECT_EQ(text_image.refusal, "");
  EXPECT_LT(text_image.megabytes, 6 * 16.0) << text_image;
  expectTooLarge("bits.pbm", "P4 40000 40000\n" + std::string(40000 * 5000, '\0'));
}

TEST_F(MapBombs, AReadingThatIsCancelledEndsAtOnce) {
  const std::string file =
      folder_.write("star.yaml", drawingOf("4000", "polygon: [" + starOf(3000, 2000) + "]"));
  base::StopSource stop;
  stop.cancel();
  MapFileOptions options;
  options.limits = {base::ReadOptions(), stop.token()};
  EXPECT_TRUE(contains(test::errorText([&] { readMapFile(file, options); }), "cancelled"));
}

}  // namespace
}  // namespace grid_path_planner::grid
