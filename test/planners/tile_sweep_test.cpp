#include "planners/tables/tile_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

namespace grid_path_planner::planners {
namespace {

constexpr int kSide = static_cast<int>(TileSweep::kSide);

struct Source {
  int column, row;
  SearchKey key;
};

std::vector<Source> randomSources(std::mt19937& random) {
  std::vector<Source> sources(1 + random() % 40);
  for (Source& source : sources)
    source = {static_cast<int>(random() % kSide), static_cast<int>(random() % kSide),
              random() % 60 * kPackedScale.straight + random() % 60 * kPackedScale.diagonal};
  return sources;
}

// Over all sources, by the length of the steps in the open.
SearchKey leastKey(const std::vector<Source>& sources, int column, int row, SearchKey straight,
                   SearchKey diagonal) {
  SearchKey least = TileSweep::kNoKey;
  for (const Source& source : sources) {
    const int columns = std::abs(column - source.column), rows = std::abs(row - source.row);
    const auto both = static_cast<SearchKey>(std::min(columns, rows));
    const auto one = static_cast<SearchKey>(std::abs(columns - rows));
    least = std::min(least, source.key + both * std::min(diagonal, 2 * straight) + one * straight);
  }
  return least;
}

TEST(TileSweepLaw, EachCellHasItsLeastKey) {
  std::mt19937 random(1986);
  TileSweep sweep;
  const SearchKey straight = kPackedScale.straight;
  for (const SearchKey diagonal : {kPackedScale.diagonal, straight, 2 * straight})
    for (int trial = 0; trial < 15; ++trial) {
      sweep.clear();
      const std::vector<Source> sources = randomSources(random);
      for (const Source& source : sources) {
        SearchKey& key = sweep.key(static_cast<std::uint32_t>(source.column),
                                   static_cast<std::uint32_t>(source.row));
        key = std::min(key, source.key);
      }
      sweep.run(straight, diagonal);
      for (int row = 0; row < kSide; ++row)
        for (int column = 0; column < kSide; ++column)
          ASSERT_EQ(sweep.key(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)),
                    leastKey(sources, column, row, straight, diagonal))
              << column << ", " << row << ", trial " << trial;
    }
}

TEST(TileSweep, WithoutAKeyThereIsNone) {
  TileSweep sweep;
  sweep.run(kWideScale.straight, kWideScale.diagonal);
  EXPECT_EQ(sweep.key(0, 0), TileSweep::kNoKey);
  EXPECT_EQ(sweep.key(127, 127), TileSweep::kNoKey);
}

// Rather no key than one that has wrapped around.
TEST(TileSweep, KeysThatWouldBeTooLargeAreNone) {
  TileSweep sweep;
  sweep.key(0, 0) = TileSweep::kNoKey - kWideScale.straight;
  sweep.run(kWideScale.straight, kWideScale.diagonal);
  EXPECT_EQ(sweep.key(0, 0), TileSweep::kNoKey - kWideScale.straight);
  EXPECT_EQ(sweep.key(1, 0), TileSweep::kNoKey);
  EXPECT_EQ(sweep.key(127, 127), TileSweep::kNoKey);
}

}  // namespace
}  // namespace grid_path_planner::planners
