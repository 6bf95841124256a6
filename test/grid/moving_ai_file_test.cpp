#include <gtest/gtest.h>

#include "grid_path_planner/grid/map_file.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"
#include "support/text_variants.h"

namespace grid_path_planner::grid {
namespace {

using test::AsciiMap;
using test::contains;
using test::errorText;

class MovingAiFile : public testing::Test {
 protected:
  OccupancyGrid read(const std::string& text, const MapFileOptions& options = {}) {
    return readMapFile(folder_.write("a.map", text), options);
  }
  // What is said of the file without its folder.
  std::string errorOf(const std::string& text) {
    const std::string error = errorText([&] { read(text); });
    return error.substr(std::min(error.size(), folder_.path("").size()));
  }

  const test::TemporaryFolder folder_;
};

TEST_F(MovingAiFile, FirstLineIsRowZeroAndOnlyDotAndGAreFree) {
  const OccupancyGrid map = read("type octile\nheight 2\nwidth 4\nmap\n..@.\nTGSW\n");
  EXPECT_EQ(map, AsciiMap({"..#.",  //
                           "#.##"})
                     .map);
  EXPECT_EQ(map.geometry(), GridGeometry(4, 2, 1.0));
  EXPECT_EQ(rowOrderOf(folder_.path("a.map")), RowOrder::FIRST_ROW_FIRST);
}

// A comma for a dot was a wall, and nothing said so.
TEST_F(MovingAiFile, LettersThatTheFormatDoesNotDefineAreWarnedOfOnce) {
  const std::string head = "type octile\nheight 2\nwidth 4\nmap\n";
  std::vector<std::string> warnings;
  MapFileOptions options;
  options.warn = [&warnings](const std::string& warning) { warnings.push_back(warning); };
  read(head + "..@O\nTGSW\n", options);
  EXPECT_EQ(warnings, std::vector<std::string>());
  EXPECT_EQ(read(head + "..@.\n.,..\n", options), AsciiMap({"..#.", ".#.."}).map);
  EXPECT_EQ(read(head + "..@.\n.,#1\n", options), AsciiMap({"..#.", ".###"}).map);
  const std::string where = folder_.path("a.map") +
                            ":6: ',' in column 2 is no letter of a MovingAI "
                            "map (. and G are free; @, O, T, S and W occupied): ";
  EXPECT_EQ(warnings, (std::vector<std::string>{where + "it is taken for occupied",
                                                where + "it and 2 more are taken for occupied"}));
}

TEST_F(MovingAiFile, GeometryIsOverridable) {
  MapFileOptions options;
  options.resolution = 0.05;
  options.origin = Origin{-1.0, 2.0, 0.5};
  EXPECT_EQ(read("type octile\nheight 1\nwidth 2\nmap\n..\n", options).geometry(),
            GridGeometry(2, 1, 0.05, {-1.0, 2.0, 0.5}));
  options.resolution = 0.0;
  EXPECT_TRUE(
      contains(errorText([&] { read("type octile\nheight 1\nwidth 2\nmap\n..\n", options); }),
               "resolution"));
}

TEST_F(MovingAiFile, LineEndsOfWindowsAndAMissingLastOneAreRead) {
  EXPECT_EQ(read("type octile\r\nheight 2\r\nwidth 2\r\nmap\r\n.@\r\n..").values(),
            (std::vector<std::int8_t>{0, 100, 0, 0}));
}

// One of them with a tab, or a mark before "type", was refused.
TEST_F(MovingAiFile, WhatEditorsLeaveIsRead) {
  for (const auto& [name, text] : test::variantsOf("type octile\nheight 2\nwidth 2\nmap\n.@\n..\n"))
    for (const char* file : {"a.map", "a.txt"})
      EXPECT_EQ(readMapFile(folder_.write(file, text)).values(),
                (std::vector<std::int8_t>{0, 100, 0, 0}))
          << name;
}

TEST_F(MovingAiFile, WrittenAndReadBackFreeIsFree) {
  const AsciiMap picture({"..#", "?.#"});
  const std::string file = folder_.path("out.map");
  writeMovingAiFile(file, picture.map);
  EXPECT_EQ(test::contentOf(file), "type octile\nheight 2\nwidth 3\nmap\n..@\nT.@\n");
  EXPECT_EQ(readMapFile(file), AsciiMap({"..#", "#.#"}).map);
}

TEST_F(MovingAiFile, BadFilesAreRefusedWithTheirLine) {
  const std::string head = "type octile\nheight 2\nwidth 3\nmap\n";
  EXPECT_EQ(errorOf("octile\n"), "a.map:1: a MovingAI map begins with 'type octile', got 'octile'");
  EXPECT_EQ(errorOf("type octile\nheight 0\nwidth 0\nmap\n"),
            "a.map:2: height must be a number of cells from 1 to 524288, got '0'");
  EXPECT_TRUE(contains(errorOf("type octile\nheight -2\nwidth 3\nmap\n"), "got '-2'"));
  EXPECT_TRUE(contains(errorOf("type octile\nheight 99999999999\n"), "got '99999999999'"));
  EXPECT_TRUE(contains(errorOf("type octile\nheight 500000\nwidth 500000\nmap\n.\n"), "larger"));
  EXPECT_TRUE(contains(errorOf("type octile\nheight 9000\nwidth 9000\nmap\n.\n"), "too short"));
  EXPECT_TRUE(contains(errorOf("type octile\nheight 2\nmap\n"), "a.map:3: has no 'width'"));
  EXPECT_TRUE(contains(errorOf("type octile\nheight 2\nwidth 3\n"), "ends before the line 'map'"));
  EXPECT_TRUE(contains(errorOf("type octile\ndepth 2\n"), "a.map:2: expected 'height'"));
  EXPECT_EQ(errorOf(head + "...\n"), "a.map:5: ends after 1 rows of the map, expected 2");
  EXPECT_EQ(errorOf(head + "...\n..\n"), "a.map:6: a row of the map has 3 cells, got 2");
  EXPECT_EQ(errorOf(head + "...\n....\n"), "a.map:6: a row of the map has 3 cells, got 4");
  EXPECT_EQ(errorOf(head + "...\n...\n...\n"), "a.map:7: has more than the 2 rows of its header");
  EXPECT_EQ(errorOf(head + std::string(".\0.\n", 4)), "a.map:5: is not text: byte 0");
}

}  // namespace
}  // namespace grid_path_planner::grid
