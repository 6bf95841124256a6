#include "grid_path_planner/planners/map_sizes.h"

#include <gtest/gtest.h>

#include <random>

#include "grid_path_planner/planners/decomposition.h"
#include "grid_path_planner/planners/rectangle_file.h"
#include "support/error_text.h"
#include "support/free_cells.h"

namespace grid_path_planner::planners {

using base::StopToken;
using grid::CellRect;
using grid::GridGeometry;

namespace {

MapSizes sizesOf(int width, int height, const std::vector<CellRect>& rectangles) {
  return mapSizes(RectangleGraph(GridGeometry(width, height, 1.0), rectangles, Touching::BORDERS));
}

TEST(MapSizes, countsAsThePublishedComparisonDoes) {
  const MapSizes sizes = sizesOf(1250, 1250, {{0, 0, 1250, 1000}, {0, 1000, 7, 3}});
  EXPECT_EQ(sizes.entire_map, 195313u);  // published: 195 kB
  EXPECT_EQ(sizes.empty_cells, 1250021u * 22 / 8 + 1);
  EXPECT_EQ(sizes.rectangles, 11u);
}

TEST(MapSizes, numbersTakeNoMoreBitsThanTheMapNeeds) {
  EXPECT_EQ(sizesOf(16, 1, {{0, 0, 16, 1}}).rectangles, 2u);  // 4, 1, 4 and 1 bits
  EXPECT_EQ(sizesOf(17, 1, {{0, 0, 17, 1}}).rectangles, 2u);  // 5, 1, 5 and 1
  EXPECT_EQ(sizesOf(128, 2, {{0, 0, 128, 2}}).rectangles, 2u);
  EXPECT_EQ(sizesOf(129, 2, {{0, 0, 129, 2}}).rectangles, 3u);
}

TEST(MapSizes, theFileIsTheFileAndNoiseCannotBeCompressed) {
  std::mt19937 random(5);
  test::FreeCells free(GridGeometry(200, 150, 1.0));
  for (std::uint8_t& cell : free.values()) cell = random() & 1;
  const RectangleGraph map(free.geometry(), largestFirst(test::bitMapsOf(free), {}, StopToken()),
                           Touching::BORDERS);
  const MapSizes sizes = mapSizes(map);
  EXPECT_EQ(sizes.file, rectangleFileContent(map).size());
  // A bit a cell is all that noise can be brought to, in a PNG and by zlib.
  EXPECT_GE(sizes.zlib, sizes.entire_map);
  EXPECT_LT(sizes.zlib, sizes.entire_map * 11 / 10);
  EXPECT_GE(sizes.png, sizes.entire_map);
  EXPECT_LT(sizes.png, sizes.entire_map * 12 / 10);
}

TEST(MapSizes, anOpenMapTakesNextToNothing) {
  const MapSizes sizes = sizesOf(1024, 1024, {{0, 0, 1024, 1024}});
  EXPECT_EQ(sizes.rectangles, 5u);
  EXPECT_LT(sizes.file, 120u);
  EXPECT_LT(sizes.zlib, 200u);
  EXPECT_LT(sizes.png, 1000u);
}

TEST(MapSizes, aMapWithoutCellsHasNone) {
  EXPECT_NE(test::errorText([] { mapSizes(RectangleGraph()); }), "");
}

}  // namespace
}  // namespace grid_path_planner::planners
