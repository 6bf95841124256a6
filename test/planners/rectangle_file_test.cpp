#include "grid_path_planner/planners/rectangle_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "grid_path_planner/planners/decomposition.h"
#include "support/error_text.h"
#include "support/file_size_limit.h"
#include "support/free_cells.h"
#include "support/mutation.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::BitMap;
using grid::CellRect;
using grid::GridGeometry;

namespace {

using test::contains;
using test::FreeCells;

constexpr std::size_t kHeaderSize = 61;  // as the header file of the format says

std::vector<CellRect> largestRectangles(const FreeCells& free) {
  return largestFirst(test::bitMapsOf(free), {}, StopToken());
}

RectangleGraph publishedMap() {
  const FreeCells free = test::publishedExample();
  return RectangleGraph(GridGeometry(10, 10, 0.05, {-1.5, 2.25, 0.3}), largestRectangles(free),
                        Touching::BORDERS);
}

std::string littleEndian(std::uint64_t value, int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  return bytes;
}

// The content with a checksum that fits it again.
std::string signedAgain(std::string content) {
  const std::size_t end = content.size() - 4;
  boost::crc_32_type sum;
  sum.process_bytes(content.data(), end);
  return content.replace(end, 4, littleEndian(sum.checksum(), 4));
}

// As deflate stores what it cannot make smaller.
std::string stored(const std::string& bytes) {
  return '\1' + littleEndian(bytes.size(), 2) + littleEndian(~bytes.size(), 2) + bytes;
}

std::string bodyOf(const std::vector<std::string>& lists) {
  std::string body;
  for (const std::string& list : lists) body += littleEndian(stored(list).size(), 5) + stored(list);
  return body;
}

std::string fileOf(int rectangles, int order, const std::string& body) {
  return signedAgain(rectangleFileContent(publishedMap()).substr(0, 48) +
                     littleEndian(static_cast<std::uint64_t>(rectangles), 4) +
                     littleEndian(static_cast<std::uint64_t>(order), 1) +
                     littleEndian(body.size(), 8) + body + "sum_");
}

// Rows, columns, widths, heights, numbers.
using Lists = std::vector<std::string>;
const std::string kZeros(2, '\0');

class RectangleFile : public testing::Test {
 protected:
  void expectComesBack(const GridGeometry& geometry, const std::vector<CellRect>& rectangles) {
    const RectangleGraph map(geometry, rectangles, Touching::BORDERS);
    writeRectangleFile(folder_.path("map"), map);
    const RectangleGraph same = readRectangleFile(folder_.path("map"), Touching::BORDERS);
    ASSERT_EQ(same.geometry(), geometry);
    ASSERT_EQ(same.rectangles(), rectangles);
    ASSERT_EQ(same.connections().size(), map.connections().size());
  }
  // What reading `content` says after the file's name; "" where it is read.
  std::string refusal(const std::string& content) {
    const std::string file = folder_.write("bad", content);
    const std::string text = test::errorText([&] { readRectangleFile(file, Touching::BORDERS); });
    if (text.empty()) return text;
    EXPECT_EQ(text.find(file + ": "), 0u) << text;
    return text.substr(std::min(text.size(), file.size() + 2));
  }

  test::TemporaryFolder folder_;
  std::mt19937 random_{1};
};

TEST_F(RectangleFile, comesBackInEveryOrder) {
  for (int trial = 0; trial < 300; ++trial) {
    const FreeCells free = trial % 2 ? test::randomBlocks(random_, 60)
                                     : test::randomFreeCells(random_, 40, trial % 10 / 9.0);
    std::vector<CellRect> rectangles = largestRectangles(free);
    expectComesBack(free.geometry(), rectangles);
    expectComesBack(free.geometry(), mergedRuns(test::bitMapsOf(free).rows, StopToken()));
    std::shuffle(rectangles.begin(), rectangles.end(), random_);
    expectComesBack(free.geometry(), rectangles);
  }
}

TEST_F(RectangleFile, comesBackWhereSidesNeedSeveralBytes) {
  expectComesBack(GridGeometry(1 << 19, 1, 0.01), {{3, 0, 400000, 1}, {500000, 0, 1, 1}});
  expectComesBack(GridGeometry(3, 300000, 0.01), {{0, 0, 1, 20000}, {2, 150000, 1, 150000}});
}

TEST_F(RectangleFile, keepsTheGeometryToTheBit) {
  for (const double number : {-0.1, 3.3e-6, 1.0 / 3.0, -999999.99999999988}) {
    const GridGeometry geometry(4, 7, std::abs(number), {number, -number, number});
    expectComesBack(geometry, {{1, 1, 2, 2}});
  }
}

TEST_F(RectangleFile, leavesOutWhatEditsLeftVacant) {
  FreeCells free = test::randomBlocks(random_, 40);
  RectangleGraph map(free.geometry(), largestRectangles(free), Touching::BORDERS);
  map.edit(BitMap(free.width(), free.height()), free.geometry().rect(), StopToken());
  for (std::uint8_t& cell : free.values()) cell = 0;
  free.values()[0] = 1;
  map.edit(test::bitMapsOf(free).rows, {0, 0, 1, 1}, StopToken());
  ASSERT_EQ(map.count(), 1u);
  ASSERT_GT(map.rectangles().size(), 1u);
  writeRectangleFile(folder_.path("map"), map);
  const RectangleGraph same = readRectangleFile(folder_.path("map"), Touching::BORDERS);
  EXPECT_EQ(same.rectangles(), (std::vector<CellRect>{{0, 0, 1, 1}}));
}

TEST_F(RectangleFile, aMapWithoutCellsHasNone) {
  EXPECT_EQ(test::errorText([] { rectangleFileContent(RectangleGraph()); }),
            "a rectangle map without cells has no file");
}

TEST_F(RectangleFile, largestFirstCostsNothingToKeep) {
  const FreeCells free = test::randomFreeCells(random_, 60, 0.8);
  std::vector<CellRect> rectangles = largestRectangles(free);
  const auto sizeOf = [&free](const std::vector<CellRect>& list) {
    return rectangleFileContent(RectangleGraph(free.geometry(), list, Touching::BORDERS)).size();
  };
  const std::size_t size = sizeOf(rectangles);
  std::reverse(rectangles.begin(), rectangles.end());
  EXPECT_GT(sizeOf(rectangles), size);
}

TEST_F(RectangleFile, everyChangedByteIsNoticed) {
  const std::string good = rectangleFileContent(publishedMap());
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const int change : {0x01, 0x80, 0xff}) {
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] ^ change);
      ASSERT_NE(refusal(bad), "") << "byte " << at;
    }
  EXPECT_EQ(refusal(good), "");
}

TEST_F(RectangleFile, everyEarlyEndIsNoticed) {
  const std::string good = rectangleFileContent(publishedMap());
  EXPECT_EQ(refusal(""), "is empty");
  for (std::size_t size = 1; size < good.size(); ++size)
    ASSERT_EQ(
        refusal(good.substr(0, size)),
        "ends early, at byte " + std::to_string(size) +
            (size < kHeaderSize ? ", inside its header" : " of " + std::to_string(good.size())));
}

TEST_F(RectangleFile, whatFollowsTheEndIsNoticed) {
  const std::string good = rectangleFileContent(publishedMap());
  const std::string end = std::to_string(good.size());
  EXPECT_EQ(refusal(good + "x"), "goes on for 1 bytes after its end at byte " + end);
  EXPECT_EQ(refusal(good + good), "goes on for " + end + " bytes after its end at byte " + end);
}

TEST_F(RectangleFile, otherFilesAreToldApart) {
  EXPECT_EQ(refusal("image: map.pgm\n"), "is not a rectangle file: it does not begin with RECTMAP");
  std::string bad = rectangleFileContent(publishedMap());
  bad[7] = 2;
  EXPECT_EQ(refusal(bad), "has format number 2, expected 1");
  EXPECT_TRUE(
      contains(test::errorText([&] { readRectangleFile(folder_.path("none"), Touching::BORDERS); }),
               "none: cannot be read"));
}

TEST_F(RectangleFile, aDamagedHeaderTakesNoMemory) {
  const std::string good = rectangleFileContent(publishedMap());
  std::string bad = good;
  for (const std::size_t at : {8u, 12u, 48u, 57u}) {
    bad = good;
    for (std::size_t i = 0; i < 3; ++i) bad[at + i] = '\xff';
    EXPECT_NE(refusal(bad), "");
    EXPECT_NE(refusal(signedAgain(bad)), "");
  }
  for (std::size_t i = 0; i < 2; ++i) bad[9 + 4 * i] = '\x40';  // about 16384x16384
  bad[50] = 0;
  bad[51] = 1;  // 16 million rectangles
  EXPECT_NE(refusal(signedAgain(bad)), "");
}

TEST_F(RectangleFile, rectanglesThatCannotBeAreNamed) {
  const auto ofLists = [&](const Lists& lists) { return refusal(fileOf(2, 1, bodyOf(lists))); };
  EXPECT_EQ(ofLists({{0, 5}, "\1\1", "\3\3", kZeros}), "");  // [1, 0, 4, 1] and [1, 5, 4, 1]
  const char leaves[] = "has a rectangle, number 1 by position, that leaves the map of 10x10 cells";
  EXPECT_EQ(ofLists({{0, 5}, "\1\1", "\3\6", kZeros}), "");
  EXPECT_EQ(ofLists({{0, 5}, "\1\1", "\3\x9", kZeros}), leaves);
  EXPECT_EQ(ofLists({{0, 5}, "\1\1", "\3\3", {0, 5}}), leaves);
  EXPECT_EQ(ofLists({{0, 5}, "\1\xA", "\3\3", kZeros}), leaves);
  EXPECT_EQ(ofLists({{0, 10}, "\1\1", "\3\3", kZeros}), leaves);
  EXPECT_EQ(ofLists({{0, 1}, {1, 0}, {3, 0}, {2, 0}}), "");
  EXPECT_EQ(ofLists({{0, 1}, {1, 0}, {3, 1}, {2, 0}}),
            "rectangle 0 [1, 0, 4, 3] overlaps rectangle 1 [0, 1, 2, 1]");
}

TEST_F(RectangleFile, listsThatCannotBeAreNamed) {
  const Lists two{{0, 5}, "\1\1", "\3\3", kZeros};
  const auto ofLists = [&](int rectangles, int order, Lists lists) {
    lists.resize(order == 2 ? 5 : 4);
    return refusal(fileOf(rectangles, order, bodyOf(lists)));
  };
  EXPECT_EQ(ofLists(2, 3, two), "has an unknown order of rectangles, 3");
  EXPECT_EQ(ofLists(3, 1, two), "its list of rows ends early, at its byte 2");
  EXPECT_EQ(ofLists(1, 1, two), "its list of rows goes on for 1 bytes after its end");
  EXPECT_EQ(ofLists(101, 1, two),
            "speaks of 101 rectangles, more than 100 cells and 48 bytes can hold");
  EXPECT_EQ(ofLists(2, 1, {{0, 5}, "\1\x81", "\3\3", kZeros}),
            "its list of columns ends early, at its byte 2");
  EXPECT_EQ(ofLists(2, 1,
                    {"\xff\xff\xff\xff\x10"
                     "\1",
                     "\1\1", "\3\3", kZeros}),
            "its list of rows has a number of more than 32 bits before its byte 5");
  EXPECT_EQ(ofLists(2, 1,
                    {"\xff\xff\xff\xff\xff"
                     "\1",
                     "\1\1", "\3\3", kZeros}),
            "its list of rows has a number of more than 32 bits before its byte 5");
  EXPECT_EQ(ofLists(2, 1, {std::string(11, '\0'), "\1\1", "\3\3", kZeros}),
            "has a packed list that unpacks to more than 10 bytes");
  const auto numbered = [&](const std::string& numbers) {
    return ofLists(2, 2, {two[0], two[1], two[2], two[3], numbers});
  };
  EXPECT_EQ(numbered({1, 0}), "");
  for (const std::string& numbers : {std::string{0, 0}, std::string{0, 2}})
    EXPECT_TRUE(contains(numbered(numbers), "numbers two rectangles"));
}

TEST_F(RectangleFile, bodiesThatCannotBeAreNamed) {
  const std::string body = bodyOf({{0, 5}, "\1\1", "\3\3", kZeros});
  EXPECT_EQ(refusal(fileOf(2, 1, body)), "");
  for (std::size_t size = 1; size < body.size(); ++size)
    ASSERT_NE(refusal(fileOf(2, 1, body.substr(0, size))), "");
  EXPECT_EQ(refusal(fileOf(2, 1, body + "x")), "its body goes on after its lists");
  EXPECT_EQ(refusal(fileOf(2, 1, littleEndian(2, 5) + "\3")), "its body ends early");
  EXPECT_EQ(refusal(fileOf(2, 1, littleEndian(1, 5) + "\1" + body)),
            "has a packed list that ends early");
  EXPECT_TRUE(contains(refusal(fileOf(2, 1, littleEndian(1, 5) + "\7" + body)), "is damaged: "));
  EXPECT_EQ(refusal(fileOf(2, 1, littleEndian(8, 5) + stored({0, 5}) + "x" + body.substr(12))),
            "has a packed list that goes on after its end");
}

// With a checksum that fits: as a program may write that errs.
TEST_F(RectangleFile, damageThatTheChecksumMissesNeverCrashes) {
  const std::string good = rectangleFileContent(publishedMap());
  const Lists lists{{0, 5, 0}, "\1\1\1", "\3\3\1", {0, 0, 1}, {2, 1, 0}};
  int read = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Lists damaged(lists.begin(), lists.begin() + (trial % 3 == 2 ? 5 : 4));
    std::string& list = damaged[random_() % damaged.size()];
    list = test::mutated(list, random_);
    read += refusal(fileOf(3, trial % 3, bodyOf(damaged))).empty();
    std::string header = test::mutated(good.substr(0, kHeaderSize), random_);
    header.resize(kHeaderSize);
    refusal(signedAgain(header + good.substr(kHeaderSize)));
    refusal(signedAgain(good.substr(0, kHeaderSize) +
                        test::mutated(good.substr(kHeaderSize), random_) + "sum_"));
  }
  EXPECT_GT(read, 0);
  EXPECT_LT(read, 2000);
}

TEST_F(RectangleFile, writingFailsLoudlyAndLeavesTheOldFile) {
  const RectangleGraph map = publishedMap();
  const auto write = [&map](const std::string& file) { writeRectangleFile(file, map); };
  EXPECT_TRUE(contains(test::errorText([&] { write(folder_.path("none/map")); }),
                       "none/map: cannot be written"));
  const std::string old = folder_.write("map", "old");
  EXPECT_TRUE(test::refusedOnAFullDisk(50, [&] { write(old); }));
  EXPECT_EQ(test::contentOf(old), "old");
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"map"});
}

}  // namespace
}  // namespace grid_path_planner::planners
