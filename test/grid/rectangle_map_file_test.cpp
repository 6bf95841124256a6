// A file of rectangles is one more map: its free cells come back, and damage gives an InputError.
// What the file holds in bytes is tested where rectangles are cut (test/rectangles).
#include "grid/formats/rectangle_map_file.h"

#include <gtest/gtest.h>

#include <boost/crc.hpp>
#include <random>

#include "support/error_text.h"
#include "support/mutation.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::grid {
namespace {

using test::contains;

constexpr std::size_t kHeaderSize = 61, kChecksumSize = 4;  // as the header of the format says

// The content with a checksum that fits it.
std::string signedAgain(std::string content) {
  boost::crc_32_type sum;
  const std::size_t end = content.size() - kChecksumSize;
  sum.process_bytes(content.data(), end);
  for (std::size_t i = 0; i < kChecksumSize; ++i)
    content[end + i] = static_cast<char>(sum.checksum() >> (8 * i) & 0xff);
  return content;
}

// The runs of free cells of every row.
std::vector<CellRect> runsOf(const OccupancyGrid& map) {
  std::vector<CellRect> runs;
  for (int row = 0; row < map.height(); ++row)
    for (int column = 0; column < map.width(); ++column) {
      if (map.row(row)[column] != 0) continue;
      if (column > 0 && map.row(row)[column - 1] == 0)
        ++runs.back().width;
      else
        runs.push_back({column, row, 1, 1});
    }
  return runs;
}

class RectangleMapFile : public testing::Test {
 protected:
  // Free with probability `share`, otherwise occupied.
  OccupancyGrid randomMap(const GridGeometry& geometry, double share) {
    OccupancyGrid map(geometry);
    for (std::int8_t& value : map.values())
      value = std::bernoulli_distribution(share)(random_) ? 0 : 100;
    return map;
  }
  std::string contentOf(const OccupancyGrid& map) {
    return rectangleMapContent({map.geometry(), runsOf(map)});
  }
  std::string refusal(const std::string& content) {
    const std::string file = folder_.write("a.rectangles", content);
    const std::string text = test::errorText([&] { checkOccupancyValues(readMapFile(file)); });
    EXPECT_TRUE(text.empty() || text.find(file + ": ") == 0) << text;
    return text;
  }

  const test::TemporaryFolder folder_;
  std::mt19937 random_{20261123};
};

TEST_F(RectangleMapFile, ComesBackWithTheGeometryToTheBit) {
  for (int trial = 0; trial < 33; ++trial) {
    const GridGeometry geometry(1 + static_cast<int>(random_() % 50),
                                1 + static_cast<int>(random_() % 50), 1.0 / (1 + trial),
                                {-0.1 * trial, 1e-300, 1.0 / 3.0});
    const OccupancyGrid map = randomMap(geometry, trial % 11 / 10.0);
    const std::string content = contentOf(map);
    for (const char* name : {"a.rectangles", "told_by_its_content"})
      ASSERT_EQ(readMapFile(folder_.write(name, content)), map);
  }
  EXPECT_EQ(rowOrderOf(folder_.path("a.rectangles")), RowOrder::FIRST_ROW_FIRST);
}

TEST_F(RectangleMapFile, ItsGeometryMayBeOverridden) {
  const OccupancyGrid map = randomMap(GridGeometry(5, 4, 0.1), 0.5);
  MapFileOptions options;
  options.resolution = 0.25;
  options.origin = Origin{1.0, 2.0, 3.0};
  const OccupancyGrid other = readMapFile(folder_.write("a", contentOf(map)), options);
  EXPECT_EQ(other.geometry(), GridGeometry(5, 4, 0.25, {1.0, 2.0, 3.0}));
  EXPECT_EQ(other.values(), map.values());
}

TEST_F(RectangleMapFile, OtherContentUnderItsNameIsToldApart) {
  EXPECT_TRUE(contains(refusal("image: map.pgm\n"), "is not a rectangle file"));
}

TEST_F(RectangleMapFile, RectanglesThatOverlapAreNamed) {
  const GridGeometry geometry(9, 9, 1.0);
  EXPECT_EQ(refusal(rectangleMapContent({geometry, {{1, 0, 4, 3}, {0, 1, 1, 1}}})), "");
  EXPECT_TRUE(contains(refusal(rectangleMapContent({geometry, {{1, 0, 4, 3}, {0, 1, 2, 1}}})),
                       "rectangle 1 [0, 1, 2, 1] overlaps another"));
}

TEST_F(RectangleMapFile, ADamagedFileIsAMapOrRefused) {
  const std::string good = contentOf(randomMap(GridGeometry(13, 9, 0.05), 0.7));
  int read = 0;
  for (std::size_t size = 1; size < good.size(); ++size)
    ASSERT_TRUE(contains(refusal(good.substr(0, size)), "ends early, at byte")) << size;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string content = test::mutated(good, random_);
    EXPECT_TRUE(content == good || content.empty() || !refusal(content).empty());
    // As a program may write that errs: the checksum fits, and at times the length too.
    content = test::mutated(trial % 2 ? good : good.substr(0, kHeaderSize), random_);
    content.resize(trial % 2 ? std::max(content.size(), kHeaderSize + kChecksumSize) : kHeaderSize);
    if (trial % 2 == 0) content += good.substr(kHeaderSize);
    read += refusal(signedAgain(content)).empty() ? 1 : 0;
  }
  EXPECT_GT(read, 0);
  EXPECT_LT(read, 1000);
}

// Of its width, its height, its number of rectangles and the bytes of its body.
TEST_F(RectangleMapFile, AClaimOfTheHeaderBeyondItsLimitsIsRefused) {
  const std::string good = contentOf(randomMap(GridGeometry(13, 9, 0.05), 0.7));
  for (const std::size_t at : {8U, 12U, 48U, 55U}) {
    std::string bad = good;
    bad.replace(at, 3, "\xff\xff\xff");
    EXPECT_NE(refusal(signedAgain(bad)), "") << at;
  }
}

}  // namespace
}  // namespace grid_path_planner::grid
