// Images without a YAML: pictures of maps, thresholded and resampled as Park (2013) has it.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "grid_path_planner/grid/map_file.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::grid {
namespace {

using test::contains;
using test::errorText;
using test::TemporaryFolder;
using Numbers = std::vector<int>;

// The map of an image of these greys, its rows top to bottom as the image has them.
Numbers readAs(const PlainImageOptions& options, int columns, const Numbers& greys) {
  std::string pgm = "P2\n" + std::to_string(columns) + " " +
                    std::to_string(greys.size() / static_cast<std::size_t>(columns)) + "\n255\n";
  for (const int grey : greys) pgm += std::to_string(grey) + "\n";
  const TemporaryFolder folder;
  MapFileOptions reading;
  reading.plain_image = options;
  const OccupancyGrid map = readMapFile(folder.write("map.pgm", pgm), reading);
  Numbers values;
  for (int row = map.height() - 1; row >= 0; --row)
    for (int column = 0; column < map.width(); ++column) values.push_back(map[Cell{column, row}]);
  return values;
}

// Between a dark and a bright group, wherever these lie; map_server would call all of it occupied.
TEST(PlainImage, OtsusThresholdSeparatesDarkFromBright) {
  EXPECT_EQ(readAs({true, 0}, 4, {10, 20, 60, 70}), (Numbers{100, 100, 0, 0}));
  EXPECT_EQ(readAs({true, 0}, 4, {210, 200, 250, 251}), (Numbers{100, 100, 0, 0}));
  EXPECT_EQ(readAs({false, 0}, 4, {10, 20, 60, 70}), (Numbers{100, 100, 100, 100}));
}

// The threshold t that makes the variance between the greys up to t and those above it largest,
// by its definition (Otsu 1979), sums over all pixels for each t.
int otsuByDefinition(const Numbers& greys) {
  int best = 0;
  double largest = -1.0;
  for (int t = 0; t < 255; ++t) {
    std::array<double, 2> count{}, sum{};
    for (const int grey : greys) {
      count[grey > t ? 1 : 0] += 1.0;
      sum[grey > t ? 1 : 0] += grey;
    }
    if (count[0] == 0.0 || count[1] == 0.0) continue;
    const double apart = sum[0] / count[0] - sum[1] / count[1];
    const double variance = count[0] * count[1] * apart * apart;
    if (variance > largest * (1.0 + 1e-12)) {
      largest = variance;
      best = t;
    }
  }
  return best;
}

TEST(PlainImage, OtsusThresholdIsThatOfItsDefinition) {
  std::mt19937 random(20261122);
  for (int trial = 0; trial < 50; ++trial) {
    std::normal_distribution<double> dark(40 + trial, 15), bright(150 + trial, 25);
    Numbers greys, expected;
    for (int i = 0; i < 400; ++i) {
      const double grey = random() % 3 == 0 ? dark(random) : bright(random);
      greys.push_back(std::min(255, std::max(0, static_cast<int>(grey))));
    }
    const int threshold = otsuByDefinition(greys);
    for (const int grey : greys) expected.push_back(grey > threshold ? 0 : 100);
    ASSERT_EQ(readAs({true, 0}, 20, greys), expected) << "trial " << trial;
  }
}

// The pixel around the middle of each cell: the second and fourth of four, the middle one of three.
TEST(PlainImage, IsResampledByTheNearestPixel) {
  EXPECT_EQ(readAs({false, 2}, 4,
                   {255, 255, 255, 255,  //
                    255, 255, 255, 0,    //
                    255, 0, 255, 0,      //
                    255, 255, 0, 255}),
            (Numbers{0, 100, 0, 0}));
  EXPECT_EQ(readAs({false, 1}, 3, {0, 0, 0, 0, 255, 0, 0, 0, 0}), (Numbers{0}));
  EXPECT_EQ(readAs({false, 2}, 4, {0, 255, 0, 255}).size(), 2U) << "at least one row";
  EXPECT_EQ(readAs({true, 2}, 4, {9, 10, 9, 40}), (Numbers{100, 0}));
}

TEST(PlainImage, WhatItCannotBeReadAsIsRefused) {
  EXPECT_TRUE(contains(errorText([] {
                         readAs({false, 5}, 4, {0, 0, 0, 0});
                       }),
                       "has 4 columns of pixels, fewer than the 5 asked for"));
  const TemporaryFolder folder;
  const std::string file = folder.write("map.map", "type octile\nheight 1\nwidth 1\nmap\n.\n");
  MapFileOptions reading;
  reading.plain_image.otsu = true;
  EXPECT_TRUE(contains(errorText([&] { readMapFile(file, reading); }), "map.map: is no image"));
}

}  // namespace
}  // namespace grid_path_planner::grid
