#include "vision/marker_picture.h"

#include <gtest/gtest.h>

#include "vision/panel_views.h"

namespace grid_path_planner::vision {
namespace {

// A marker of the layout and one that it does not have, on grey.
TEST(MarkerPicture, MarkersOfTheLayoutAreGreenAndOthersRed) {
  const std::vector<std::uint8_t> grey(100 * 60, 128);
  const auto square = [](int id, double left) {
    return DetectedMarker{id, {{{left, 10}, {left + 30, 10}, {left + 30, 40}, {left, 40}}}};
  };
  const auto rgb = markerPicture({grey.data(), 100, 60, 100}, {square(3, 10), square(500, 60)},
                                 shippedLayout(), MarkerFix());
  const auto pixel = [&](int column, int row) {
    const std::uint8_t* at = &rgb[3 * (row * 100 + column)];
    return std::vector<int>(at, at + 3);
  };
  EXPECT_EQ(pixel(25, 40), (std::vector<int>{0, 255, 0}));
  EXPECT_EQ(pixel(75, 40), (std::vector<int>{255, 0, 0}));
  EXPECT_EQ(pixel(50, 30), (std::vector<int>{128, 128, 128}));
}

}  // namespace
}  // namespace grid_path_planner::vision
