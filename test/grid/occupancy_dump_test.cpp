#include "grid/formats/occupancy_dump.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::grid {
namespace {

using test::AsciiMap;
using test::contains;
using test::errorText;
using Values = std::vector<std::int8_t>;

// What `rostopic echo -n1 /projected_map` prints, with other text in some places.
struct Dump {
  std::string resolution = "0.05000000074505806";
  std::string width = "3";
  std::string height = "2";
  std::string position = "\n      x: -1.5\n      y: 2.0\n      z: 0.0";
  std::string orientation = "\n      x: 0.0\n      y: 0.0\n      z: 0.0\n      w: 1.0";
  std::string data = " [0, 0, 100, -1, 0, 0]";

  std::string text() const {
    return "header: \n  seq: 3\n  stamp: \n    secs: 12\n    nsecs: 340000000\n"
           "  frame_id: \"map\"\ninfo: \n  map_load_time: \n    secs: 12\n    nsecs:         0\n"
           "  resolution: " +
           resolution + "\n  width: " + width + "\n  height: " + height +
           "\n  origin: \n    position: " + position + "\n    orientation: " + orientation +
           "\ndata:" + data + "\n---\n";
  }
};

class OccupancyDump : public testing::Test {
 protected:
  OccupancyGrid read(const std::string& text) { return readMapFile(folder_.write("a.txt", text)); }
  // What is said of the file without its folder.
  std::string errorOf(const std::string& text) {
    const std::string error = errorText([&] { read(text); });
    return error.substr(std::min(error.size(), folder_.path("").size()));
  }

  const test::TemporaryFolder folder_;
  Dump dump_;
};

TEST_F(OccupancyDump, WhatRostopicPrintsIsRead) {
  EXPECT_EQ(read(dump_.text()), AsciiMap({"..#", "?.."}, 0.05, {-1.5, 2.0, 0.0}).map);
}

TEST_F(OccupancyDump, TheFirstOfSeveralMessagesIsTaken) {
  Dump second;
  second.data = " [1, 1, 1, 1, 1, 1]";
  EXPECT_EQ(read(dump_.text() + second.text()).values(), (Values{0, 0, 100, -1, 0, 0}));
  EXPECT_EQ(read("---\n" + dump_.text() + second.text()).values(), (Values{0, 0, 100, -1, 0, 0}));
  EXPECT_EQ(read(dump_.text() + "[[[ cut of").values(), (Values{0, 0, 100, -1, 0, 0}));
}

// octomap_server's first message has no cells: it was refused, and with it the file.
TEST_F(OccupancyDump, MapsWithoutCellsArePassedOver) {
  Dump empty;
  empty.width = empty.height = "0";
  empty.resolution = "0.0";
  empty.data = " []";
  EXPECT_EQ(read(empty.text() + empty.text() + dump_.text()),
            AsciiMap({"..#", "?.."}, 0.05, {-1.5, 2.0, 0.0}).map);
  EXPECT_TRUE(contains(errorOf(empty.text() + empty.text()), "at least one cell, got 0x0"));
  dump_.width = "abc";
  EXPECT_TRUE(contains(errorOf(empty.text() + dump_.text()), "a.txt:37: width must be"))
      << "by the line of the file";
}

// yaml.dump of the original study's list.
TEST_F(OccupancyDump, AListWithOneValueALineIsRead) {
  for (const char* data : {"\n- 0\n- 0\n- 100\n- -1\n- 0\n- 0",
                           "\n  - 0\n  -  0\n  - 100\n  - -1\n"
                           "  - 0 # free\n  - 0\n"}) {
    dump_.data = data;
    EXPECT_EQ(read(dump_.text()).values(), (Values{0, 0, 100, -1, 0, 0}));
  }
}

TEST_F(OccupancyDump, AListOverSeveralLinesIsRead) {
  dump_.data = "\n  [0, 0,  # the first row\n   100,\r\n\n -1,0,0 ,\n]  # all";
  EXPECT_TRUE(contains(errorOf(dump_.text()), "data must be a list"));
  dump_.data = " [0, 0,  # the first row\n   100,\r\n\n -1,0,0 ,\n]  # all";
  EXPECT_EQ(read(dump_.text()).values(), (Values{0, 0, 100, -1, 0, 0}));
}

TEST_F(OccupancyDump, DataMayComeFirst) {
  const std::string text = dump_.text();
  const std::size_t data = text.find("data:");
  const std::string list = text.substr(data, text.find("---") - data);
  EXPECT_EQ(read(list + text.substr(0, data)).values(), (Values{0, 0, 100, -1, 0, 0}));
  dump_.data = "\n- 0\n- 0\n- 100\n- -1\n- 0\n- 0";
  EXPECT_EQ(read("data:" + dump_.data + "\n" + text.substr(0, data)).values(),
            (Values{0, 0, 100, -1, 0, 0}));
}

TEST_F(OccupancyDump, YawComesFromTheQuaternion) {
  dump_.orientation = " {x: 0.0, y: 0.0, z: 0.7071067811865476, w: 0.7071067811865476}";
  EXPECT_NEAR(read(dump_.text()).geometry().origin().yaw, M_PI / 2, 1e-12);
}

// A dump of octomap_server's map, which has no orientation.
TEST_F(OccupancyDump, AnOrientationOfZerosIsYawZeroAndTold) {
  dump_.orientation = " {x: 0.0, y: 0.0, z: 0.0, w: 0.0}";
  MapFileOptions options;
  std::vector<std::string> warnings;
  options.warn = [&](const std::string& warning) { warnings.push_back(warning); };
  const OccupancyGrid map = readMapFile(folder_.write("a.txt", dump_.text()), options);
  EXPECT_EQ(map, AsciiMap({"..#", "?.."}, 0.05, {-1.5, 2.0, 0.0}).map);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0], "a.txt: its origin has no orientation: yaw 0 is taken"));
}

TEST_F(OccupancyDump, DataLeftOutIsRefusedWithTheRemedy) {
  dump_.data = " \"<array type: int8, length: 6>\"";
  EXPECT_EQ(errorOf(dump_.text()),
            "a.txt:24: data was left out of this dump: use `rostopic echo` without --noarr");
}

TEST_F(OccupancyDump, BadValuesAreRefusedWithTheirLine) {
  const auto errorOfData = [this](const std::string& data) {
    dump_.data = data;
    return errorOf(dump_.text());
  };
  EXPECT_EQ(errorOfData(" [0, 0, 101, -1, 0, 0]"),
            "a.txt:24: data must be whole numbers from -1 to 100, value 3 is '101, -1, 0, 0]'");
  EXPECT_TRUE(contains(errorOfData(" [0, 0, 100,\n -2, 0, 0]"), "a.txt:25: "));
  EXPECT_TRUE(contains(errorOfData("\n- 0\n- 1e1\n"), "a.txt:26: "));
  EXPECT_TRUE(contains(errorOfData(" [0, 99999999999999999999]"), "value 2 is '99999"));
  EXPECT_TRUE(contains(errorOfData(" [0, 0.5]"), "value 2 is '0.5]'"));
  EXPECT_TRUE(contains(errorOfData(" [0, abc]"), "value 2 is 'abc]'"));
  EXPECT_TRUE(contains(errorOfData(" [0, [1]]"), "value 2 is '[1]]'"));
  EXPECT_TRUE(contains(errorOfData(" [0, 1"), "expected ',' or ']' after value 2"));
  EXPECT_TRUE(contains(errorOfData(" [0 1]"), "expected ',' or ']' after value 1"));
  EXPECT_TRUE(contains(errorOfData(" [0, 1] 2"), "expected the end of the line"));
  EXPECT_TRUE(contains(errorOfData(" 5"), "data must be a list of numbers, got '5'"));
  EXPECT_TRUE(contains(errorOfData(""), "data must be a list of numbers"));
  EXPECT_TRUE(contains(errorOfData(" []"), "needs 6 values, got 0"));
  EXPECT_TRUE(
      contains(errorOfData(" [0, 0, 0, 0, 0]"), "a map of 3x2 cells needs 6 values, got 5"));
  EXPECT_TRUE(contains(errorOfData(" [0, 0, 0, 0, 0, 0, 0]"), "needs 6 values, got 7"));
}

TEST_F(OccupancyDump, BadInfoIsRefusedWithItsLine) {
  const auto errorWith = [this](std::string Dump::*part, const std::string& text) {
    Dump dump = dump_;
    dump.*part = text;
    return errorOf(dump.text());
  };
  EXPECT_EQ(errorWith(&Dump::width, "abc"), "a.txt:12: width must be a number of cells, got 'abc'");
  EXPECT_TRUE(contains(errorWith(&Dump::width, "0"), "at least one cell, got 0x2"));
  EXPECT_TRUE(contains(errorWith(&Dump::height, "-2"), "at least one cell, got 3x-2"));
  EXPECT_TRUE(contains(errorWith(&Dump::height, "99999999999"), "height must be"));
  EXPECT_TRUE(contains(errorWith(&Dump::height, "400000"), "needs 1200000 values, got 6"));
  for (const char* resolution : {"0.0", "-0.05", "nan", "inf", ".nan", "[]"})
    EXPECT_TRUE(contains(errorWith(&Dump::resolution, resolution), "resolution must be a positive"))
        << resolution;
  EXPECT_TRUE(contains(errorWith(&Dump::position, " {x: .nan, y: 0, z: 0}"), "x must be"));
  EXPECT_TRUE(contains(errorWith(&Dump::position, " 5"), "expected a mapping with 'x', got '5'"));
  EXPECT_TRUE(contains(errorWith(&Dump::orientation, " {x: 0, y: 0, z: 0, w: 1e-9}"),
                       "a.txt:19: origin: orientation x 0 y 0 z 0 w 1e-09 has length zero"));
  EXPECT_TRUE(contains(errorWith(&Dump::orientation, " {x: 0.1, y: 0, z: 0, w: 1}"),
                       "origin: orientation x 0.1 y 0 z 0 w 1 must be level"));
  EXPECT_TRUE(
      contains(errorWith(&Dump::orientation, " {x: 0, y: -0.1, z: 0, w: 1}"), "must be level"));
}

TEST_F(OccupancyDump, ATextWithoutInfoOrCutShortIsRefused) {
  EXPECT_TRUE(contains(errorOf("data: [0, 0]\n"), "info"));
  const std::string text = dump_.text();
  EXPECT_TRUE(contains(errorOf(text.substr(0, text.find("data:"))), "is no map"));
  EXPECT_TRUE(
      contains(errorOf("deep: " + std::string(100000, '[') + "\n" + text), "nested deeper"));
}

// The whole text as a YAML tree would take gigabytes.
TEST_F(OccupancyDump, FourMillionCellsAreReadAsAStream) {
  constexpr int kSide = 2000;
  std::mt19937 random(2000);
  std::uniform_int_distribution<int> pick(0, 2);
  Values values(std::size_t{kSide} * kSide);
  std::string data = " [";
  for (std::int8_t& value : values) {
    value = std::array<std::int8_t, 3>{-1, 0, 100}[pick(random)];
    data += std::to_string(value) + ", ";
  }
  data.replace(data.size() - 2, 2, "]");
  dump_.data = data;
  dump_.width = dump_.height = std::to_string(kSide);
  EXPECT_EQ(read(dump_.text()).values(), values);
}

}  // namespace
}  // namespace grid_path_planner::grid
