#include "vision/grey_conversion.h"

#include <gtest/gtest.h>

#include "support/error_text.h"

namespace grid_path_planner::vision {
namespace {

using Bytes = std::vector<std::uint8_t>;
using test::errorText;

EncodedImage imageOf(const Bytes& bytes, const std::string& encoding, std::uint32_t width,
                     std::uint32_t height, std::uint32_t step) {
  return {encoding, width, height, step, false, bytes.data(), bytes.size()};
}

TEST(GreyConversion, GreyStaysAsItIs) {
  const Bytes bytes = {0, 7, 255, 128};
  EXPECT_EQ(greyPixels(imageOf(bytes, "mono8", 2, 2, 2)), bytes);
  EXPECT_EQ(greyPixels(imageOf(bytes, "8UC1", 4, 1, 4)), bytes);
}

// Red, then blue: the eye, and the norm, has red brighter.
TEST(GreyConversion, ColoursAreAsBrightAsTheNormSays) {
  const Bytes grey = {77, 29};
  EXPECT_EQ(greyPixels(imageOf({255, 0, 0, 0, 0, 255}, "rgb8", 2, 1, 6)), grey);
  EXPECT_EQ(greyPixels(imageOf({0, 0, 255, 255, 0, 0}, "bgr8", 2, 1, 6)), grey);
  EXPECT_EQ(greyPixels(imageOf({255, 0, 0, 9, 0, 0, 255, 9}, "rgba8", 2, 1, 8)), grey);
  EXPECT_EQ(greyPixels(imageOf({0, 0, 255, 9, 255, 0, 0, 9}, "bgra8", 2, 1, 8)), grey);
}

TEST(GreyConversion, OfSixteenBitsTheHigherEight) {
  const Bytes bytes = {1, 200, 2, 100};
  EncodedImage image = imageOf(bytes, "mono16", 2, 1, 4);
  EXPECT_EQ(greyPixels(image), (Bytes{200, 100}));
  image.big_endian = true;
  EXPECT_EQ(greyPixels(image), (Bytes{1, 2}));
}

TEST(GreyConversion, WhatIsBehindARowsPixelsIsPassedOver) {
  EXPECT_EQ(greyPixels(imageOf({1, 2, 99, 3, 4, 99}, "mono8", 2, 2, 3)), (Bytes{1, 2, 3, 4}));
}

// A red image through the filter of a sensor: a quarter of the pixels is bright, and all are as bright as red.
TEST(GreyConversion, ThroughTheColourFilterOfASensor) {
  for (const auto& [encoding, red] : {std::pair("bayer_rggb8", 0), std::pair("bayer_grbg8", 1),
                                      std::pair("bayer_gbrg8", 2), std::pair("bayer_bggr8", 3)}) {
    Bytes bytes(64, 0);
    for (int row = 0; row < 8; ++row)
      for (int column = 0; column < 8; ++column)
        if (row % 2 * 2 + column % 2 == red) bytes[8 * row + column] = 255;
    const Bytes grey = greyPixels(imageOf(bytes, encoding, 8, 8, 8));
    EXPECT_NEAR(grey[8 * 3 + 3], 76, 1) << encoding;
    EXPECT_NEAR(grey[8 * 4 + 4], 76, 1) << encoding;
  }
}

TEST(GreyConversion, ImagesThatAreNoneAreRefusedWithASentence) {
  const Bytes bytes(12, 0);
  const auto error = [&](const std::string& encoding, std::uint32_t width, std::uint32_t height,
                         std::uint32_t step) {
    return errorText([&] { greyPixels(imageOf(bytes, encoding, width, height, step)); });
  };
  EXPECT_EQ(error("rgb8", 2, 2, 6), "");
  EXPECT_EQ(error("rgb8", 0, 0, 0), "it has 0 x 0 pixels");
  EXPECT_EQ(error("rgb8", 2, 2, 5), "its rows have 5 bytes, 2 pixels of rgb8 take 6");
  EXPECT_EQ(error("rgb8", 2, 3, 6), "it has 12 bytes, its rows take 18");
  EXPECT_EQ(error("mono8", 4294967295u, 4294967295u, 4294967295u),
            "it has 4294967295 x 4294967295 pixels, more than 8192 in a row or column");
  EXPECT_EQ(error("mono8", 8192, 8192, 4294967295u),
            "it has 12 bytes, its rows take 35184372080640");
  EXPECT_TRUE(test::contains(error("32FC1", 1, 1, 4), "its encoding must be mono8"));
}

}  // namespace
}  // namespace grid_path_planner::vision
