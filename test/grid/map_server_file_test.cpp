#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <random>

#include "grid_path_planner/grid/map_file.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/file_size_limit.h"
#include "support/temporary_folder.h"
#include "support/text_variants.h"

namespace grid_path_planner::grid {
namespace {

using test::AsciiMap;
using test::contains;
using test::errorText;
using Values = std::vector<std::int8_t>;
using Names = std::vector<std::string>;

const char* const kGeometry = "image: a.pgm\nresolution: 0.05\norigin: [-1.5, 2.0, 0.25]\n";

// A PGM of one line.
std::string pgmLine(const std::vector<int>& greys) {
  std::string pgm = "P5\n" + std::to_string(greys.size()) + " 1\n255\n";
  for (const int grey : greys) pgm += static_cast<char>(grey);
  return pgm;
}

class MapServerFile : public testing::Test {
 protected:
  MapServerFile() {
    options_.warn = [this](const std::string& text) { warnings_.push_back(text); };
  }
  // The map of a YAML file with `more` lines after the geometry, and the image a.pgm.
  Values valuesOf(const std::string& more, const std::string& pgm) {
    folder_.write("a.pgm", pgm);
    return readMapFile(folder_.write("a.yaml", kGeometry + more), options_).values();
  }
  std::string errorOf(const std::string& yaml) {
    const std::string error =
        errorText([&] { readMapFile(folder_.write("a.yaml", yaml), options_); });
    return error.substr(std::min(error.size(), folder_.path("").size()));
  }
  // The same for an image of several channels a pixel in a PNG.
  Values valuesOfColours(const std::string& more, const cv::Mat& image) {
    cv::imwrite(folder_.path("a.png"), image);
    const std::string yaml = "image: a.png\nresolution: 1\norigin: [0, 0, 0]\n" + more;
    return readMapFile(folder_.write("a.yaml", yaml), options_).values();
  }

  const test::TemporaryFolder folder_;
  MapFileOptions options_;
  std::vector<std::string> warnings_;
};

TEST_F(MapServerFile, FirstImageLineIsTheLastRow) {
  folder_.write("a.pgm", "P5\n3 2\n255\n\xfe\xfe\x01\xcd\xfe\xfe");
  const OccupancyGrid map = readMapFile(folder_.write("a.yaml", kGeometry));
  EXPECT_EQ(map.values(), AsciiMap({"?..", "..#"}).map.values());
  EXPECT_EQ(rowOrderOf(folder_.path("a.yaml")), RowOrder::LAST_ROW_FIRST);
  EXPECT_EQ(rowOrderOf(folder_.path("a.pgm")), RowOrder::LAST_ROW_FIRST);
  EXPECT_EQ(map.geometry(), GridGeometry(3, 2, 0.05, {-1.5, 2.0, 0.25}));
}

// innate-os PR#732: with another threshold, 205 came back as free.
TEST_F(MapServerFile, Value205IsUnknownAndTheThresholdsAreMapServers) {
  // p = (255 - v) / 255: 0.65 lies between v = 90 and 89, 0.196 between 206 and 205.
  EXPECT_EQ(valuesOf("", pgmLine({0, 89, 90, 205, 206, 254, 255})),
            (Values{100, 100, -1, -1, 0, 0, 0}));
}

TEST_F(MapServerFile, NegateTurnsBlackAndWhite) {
  EXPECT_EQ(valuesOf("negate: 1\n", pgmLine({0, 49, 50, 165, 166, 255})),
            (Values{0, 0, -1, -1, 100, 100}));
  EXPECT_EQ(valuesOf("negate: true\n", pgmLine({0, 255})), (Values{0, 100}));
  EXPECT_EQ(valuesOf("negate: 0\n", pgmLine({0, 255})), (Values{100, 0}));
}

TEST_F(MapServerFile, ThresholdsAreTakenFromTheFile) {
  const std::string more = "occupied_thresh: 0.9\nfree_thresh: 0.1\n";
  EXPECT_EQ(valuesOf(more, pgmLine({25, 26, 229, 230})), (Values{100, -1, -1, 0}));
}

// As map_server's image_loader of Noetic has it: 1 + 98 (p - free) / (occupied - free), cut to an integer. By 99 alone, as
// older ones had it, what lies just above free_thresh was free.
TEST_F(MapServerFile, ScaleModeInterpolates) {
  const std::string more = "mode: scale\nfree_thresh: 0.2\noccupied_thresh: 0.6\n";
  EXPECT_EQ(valuesOf(more, pgmLine({0, 101, 103, 153, 200, 205, 255})),
            (Values{100, 100, 98, 50, 4, 0, 0}));
}

TEST_F(MapServerFile, RawModeTakesTheValueItself) {
  EXPECT_EQ(valuesOf("mode: raw\n", pgmLine({0, 1, 57, 100, 101, 254, 255})),
            (Values{0, 1, 57, 100, -1, -1, -1}));
  EXPECT_EQ(valuesOf("mode: raw\nnegate: 1\n", pgmLine({255, 155, 154, 0})),
            (Values{0, 100, -1, -1}));
}

TEST_F(MapServerFile, AColourImageIsAveragedWithAWarning) {
  cv::Mat image(1, 2, CV_8UC3);
  image.at<cv::Vec3b>(0, 0) = {254, 254, 255};
  image.at<cv::Vec3b>(0, 1) = {255, 0, 0};  // mean 85: p = 0.667
  EXPECT_EQ(valuesOfColours("", image), (Values{0, 100}));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_TRUE(contains(warnings_[0], "a.png: is a colour image: the mean of its 3 channels"));
}

TEST_F(MapServerFile, TransparentIsUnknownInScaleMode) {
  cv::Mat image(1, 3, CV_8UC4);
  image.at<cv::Vec4b>(0, 0) = {150, 150, 150, 0};
  image.at<cv::Vec4b>(0, 1) = {150, 150, 150, 255};  // p = 0.412: 1 + 98 (0.412 - 0.196) / 0.454
  image.at<cv::Vec4b>(0, 2) = {0, 0, 0, 255};
  EXPECT_EQ(valuesOfColours("mode: scale\n", image), (Values{-1, 47, 100}));
}

TEST_F(MapServerFile, InTrinaryModeTheAlphaChannelIsAveragedToo) {
  cv::Mat image(1, 2, CV_8UC4);
  image.at<cv::Vec4b>(0, 0) = {255, 255, 255, 255};
  image.at<cv::Vec4b>(0, 1) = {120, 120, 120, 0};  // mean 90
  EXPECT_EQ(valuesOfColours("", image), (Values{0, -1}));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_TRUE(contains(warnings_[0], "the alpha channel among them"));
}

TEST_F(MapServerFile, SixteenBitsAreReadAsEight) {
  cv::Mat image(1, 3, CV_16UC1);
  image.at<std::uint16_t>(0, 0) = 0;
  image.at<std::uint16_t>(0, 1) = 205 * 257;
  image.at<std::uint16_t>(0, 2) = 65535;
  EXPECT_EQ(valuesOfColours("", image), (Values{100, -1, 0}));
  image.at<std::uint16_t>(0, 1) = 206 * 256 + 17;  // the upper ones, as SDL: rounded it was 205
  EXPECT_EQ(valuesOfColours("", image), (Values{100, 0, 0}));
  EXPECT_TRUE(warnings_.empty());
}

// As SDL, which map_server reads with, does; OpenCV by itself leaves a binary image dark.
TEST_F(MapServerFile, TheWhiteOfAPgmIsWhatItsHeaderSays) {
  EXPECT_EQ(valuesOf("", std::string("P5\n# 100\n4 1\n100\n\x00\x32\x51\x64", 21)),
            (Values{100, -1, 0, 0}));
  EXPECT_EQ(valuesOf("", "P2\n4 1\n100\n0 50 81 100\n"), (Values{100, -1, 0, 0}));
  EXPECT_EQ(valuesOf("", std::string("P5 3 1 65535\n\x00\x00\xcd\xcd\xff\xff", 19)),
            (Values{100, -1, 0}));
}

// Of a header with CR LF the LF was the first pixel, and each pixel lay one column to the right.
TEST_F(MapServerFile, WhatEditorsLeaveIsRead) {
  const std::string pixels = "\n\xfe\x01\xcd";  // the first one is 10
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const std::string header = test::replacedAll("P5\n# by hand\n4\t1\n255\n", "\n", end);
    EXPECT_EQ(valuesOf("", header + pixels), (Values{100, 0, 100, -1}));
    if (header.back() == '\r') continue;  // the first pixel may end that line
    EXPECT_EQ(valuesOf("", header + pixels + "\n"), (Values{100, 0, 100, -1})) << "and more bytes";
  }
  for (const auto& [name, text] : test::variantsOf("P2\n# by hand\n4 1\n255\n10 254 1 205\n"))
    EXPECT_EQ(valuesOf("", text), (Values{100, 0, 100, -1})) << name;
  folder_.write("a.pgm", pgmLine({0, 255}));
  const std::string yaml =
      "image: a.pgm\nresolution: 5e-2\norigin: [-1.5, 2.0, 0.25]\nnegate: 1\n"
      "occupied_thresh: 6.5e-1\nfree_thresh: .196\nmode: trinary\n";
  for (const auto& [name, text] : test::variantsOf(yaml, ": "))
    EXPECT_EQ(readMapFile(folder_.write("a.yaml", text)),
              OccupancyGrid(GridGeometry(2, 1, 0.05, {-1.5, 2.0, 0.25}), Values{0, 100}))
        << name;
}

// navigation#993: map_saver prints the yaw of octomap_server's map so; it was refused.
TEST_F(MapServerFile, AYawThatIsNotANumberIsZeroAndTold) {
  folder_.write("a.pgm", pgmLine({0, 255}));
  const auto withYaw = [&](const std::string& yaw) {
    warnings_.clear();
    const std::string text = "image: a.pgm\nresolution: 1\norigin: [-10, -10, " + yaw + "]\n";
    return readMapFile(folder_.write("a.yaml", text), options_).geometry();
  };
  for (const char* yaw : {"nan", "-nan", ".nan", ".NaN", "-NAN"}) {
    EXPECT_EQ(withYaw(yaw), GridGeometry(2, 1, 1.0, {-10.0, -10.0, 0.0})) << yaw;
    EXPECT_EQ(warnings_,
              std::vector<std::string>{folder_.path("a.yaml") +
                                       ": its origin has no orientation: yaw 0 is taken"});
  }
  EXPECT_EQ(withYaw("0.5"), GridGeometry(2, 1, 1.0, {-10.0, -10.0, 0.5}));
  EXPECT_TRUE(warnings_.empty());
  for (const char* yaw : {"nano", "inf", "''", "[nan]"})
    EXPECT_TRUE(contains(errorText([&] { withYaw(yaw); }), "a number of radians")) << yaw;
}

// As cartographer's: its floor and its walls are both greys.
TEST_F(MapServerFile, GreysBetweenTheThresholdsAreTold) {
  EXPECT_EQ(valuesOf("", pgmLine({158, 110, 128})), (Values{-1, -1, -1}));
  EXPECT_EQ(warnings_,
            (std::vector<std::string>{folder_.path("a.pgm") +
                                      ": no pixel is free or occupied by free_thresh 0.196 and "
                                      "occupied_thresh 0.65: its greys count as unknown"}));
  warnings_.clear();
  EXPECT_EQ(valuesOf("free_thresh: 0.4\noccupied_thresh: 0.5\n", pgmLine({158, 110, 128})),
            (Values{0, 100, -1}));
  valuesOf("", pgmLine({254, 205, 205}));  // nothing occupied has been seen yet
  valuesOf("", pgmLine({205, 205}));
  valuesOf("mode: scale\n", pgmLine({158, 110, 128}));
  EXPECT_TRUE(warnings_.empty()) << warnings_[0];
}

TEST_F(MapServerFile, ABitmapIsAnImageToo) {
  const OccupancyGrid map = readMapFile(folder_.write("a.pbm", "P1\n3 1\n1 0 1\n"));
  EXPECT_EQ(map.values(), (Values{100, 0, 100}));
}

TEST_F(MapServerFile, TheImageMayHaveAnAbsolutePathOrLieInAFolder) {
  const std::string image = folder_.write("b.pgm", pgmLine({0, 255}));
  const std::string rest = "\nresolution: 1\norigin: [0, 0, 0]\n";
  for (const std::string& name : {image, std::string("b.pgm"), std::string("./b.pgm")})
    EXPECT_EQ(readMapFile(folder_.write("b.yaml", "image: " + name + rest)).values(),
              (Values{100, 0}));
}

TEST_F(MapServerFile, OptionsOverrideTheGeometry) {
  options_.resolution = 0.5;
  options_.origin = Origin{7.0, 8.0, 0.0};
  folder_.write("a.pgm", pgmLine({0, 255}));
  EXPECT_EQ(readMapFile(folder_.write("a.yaml", kGeometry), options_).geometry(),
            GridGeometry(2, 1, 0.5, {7.0, 8.0, 0.0}));
}

TEST_F(MapServerFile, APlainImageHasCellsOfAMetre) {
  const OccupancyGrid map = readMapFile(folder_.write("a.pgm", pgmLine({0, 205, 254})));
  EXPECT_EQ(map.geometry(), GridGeometry(3, 1, 1.0));
  EXPECT_EQ(map.values(), (Values{100, -1, 0}));
}

OccupancyGrid randomMap(std::mt19937& random, const std::vector<int>& choices) {
  std::uniform_int_distribution<int> side(1, 40);
  std::uniform_int_distribution<std::size_t> pick(0, choices.size() - 1);
  std::uniform_real_distribution<double> place(-100.0, 100.0), angle(-3.0, 3.0);
  const int width = side(random), height = side(random);
  OccupancyGrid map(GridGeometry(width, height, std::exp(angle(random)),
                                 {place(random), place(random), angle(random)}));
  for (std::int8_t& value : map.values()) value = static_cast<std::int8_t>(choices[pick(random)]);
  return map;
}

TEST_F(MapServerFile, LawTrinaryKeepsFreeUnknownAndOccupiedAndTheGeometryToTheLastBit) {
  std::mt19937 random(205);
  for (int trial = 0; trial < 50; ++trial) {
    const OccupancyGrid map = randomMap(random, {-1, 0, 100});
    writeMapServerFile(folder_.path("b.yaml"), map);
    ASSERT_EQ(readMapFile(folder_.path("b.yaml")), map) << "trial " << trial;
    writeImageFile(folder_.path("b.png"), map);
    ASSERT_EQ(readMapFile(folder_.path("b.png")).values(), map.values()) << "trial " << trial;
  }
  EXPECT_EQ(folder_.endings(), (Names{".pgm", ".png", ".yaml"})) << "of 50 maps the last";
}

TEST_F(MapServerFile, LawRawKeepsEveryValue) {
  std::vector<int> all;
  for (int value = -1; value <= 100; ++value) all.push_back(value);
  std::mt19937 random(101);
  for (int trial = 0; trial < 50; ++trial) {
    const OccupancyGrid map = randomMap(random, all);
    writeMapServerFile(folder_.path("b.yaml"), map, MapMode::RAW);
    ASSERT_EQ(readMapFile(folder_.path("b.yaml")), map) << "trial " << trial;
  }
}

TEST_F(MapServerFile, WritingFollowsTheThresholds) {
  OccupancyGrid map(GridGeometry(4, 1, 1.0), Values{25, 26, 64, 65});
  writeMapServerFile(folder_.path("b.yaml"), map);
  EXPECT_EQ(readMapFile(folder_.path("b.yaml")).values(), (Values{0, -1, -1, 100}));
}

TEST_F(MapServerFile, ANameThatYamlWouldReadOtherwiseComesBack) {
  const OccupancyGrid map = AsciiMap({".#?"}).map;
  for (const char* name : {"0x1: # b.yaml", "true.yaml", "a 'quoted' \"one\".yaml", "[b].yaml"}) {
    writeMapServerFile(folder_.path(name), map);
    EXPECT_EQ(readMapFile(folder_.path(name)), map) << name;
  }
}

TEST_F(MapServerFile, BadFilesAreRefusedWithTheirLine) {
  folder_.write("a.pgm", pgmLine({0, 255}));
  const std::string image = "image: a.pgm\n", origin = "origin: [0, 0, 0]\n";
  for (const char* resolution : {"0", "-0.05", "0.0"})
    EXPECT_EQ(
        errorOf(image + "resolution: " + resolution + "\n" + origin),
        std::string("a.yaml:2: resolution must be a positive, finite number of metres, got ") +
            (resolution[0] == '-' ? "-0.05" : "0"));
  for (const char* resolution : {".nan", ".inf", "abc", "[1]", "0.05m", ""})
    EXPECT_TRUE(contains(errorOf(image + "resolution: " + resolution + "\n" + origin),
                         "resolution must be a positive, finite number of metres, got "))
        << resolution;
  EXPECT_TRUE(contains(errorOf(image + origin), "has no 'resolution'"));
  EXPECT_TRUE(contains(errorOf("resolution: 1\n" + origin), "is no map: no 'image' (map_server)"));
  EXPECT_TRUE(contains(errorOf("image:\nresolution: 1\n" + origin), "image must be the path"));
  const std::string head = image + "resolution: 1\n";
  EXPECT_TRUE(contains(errorOf(head), "has no 'origin'"));
  EXPECT_TRUE(contains(errorOf(head + "origin: [0, 0]\n"), "a.yaml:3: origin must be"));
  EXPECT_TRUE(contains(errorOf(head + "origin: 5\n"), "got '5'"));
  EXPECT_TRUE(contains(errorOf(head + "origin: [0, .nan, 0]\n"), "a.yaml:3: origin y must be"));
  EXPECT_TRUE(contains(errorOf(head + origin + "negate: 2\n"), "a.yaml:4: negate must be 0 or 1"));
  EXPECT_TRUE(contains(errorOf(head + origin + "mode: blue\n"),
                       "a.yaml:4: mode must be one of trinary, scale, raw, got 'blue'"));
  EXPECT_TRUE(contains(errorOf(head + origin + "occupied_thresh: 65\n"),
                       "a.yaml:4: occupied_thresh must be a number from 0 to 1, got 65"));
  EXPECT_TRUE(contains(errorOf(head + origin + "free_thresh: 0.7\n"), "must not be above"));
  EXPECT_TRUE(contains(errorOf("- 1\n"), "a.yaml: is no map"));
  EXPECT_TRUE(contains(errorOf("image: [a\n"), "is not YAML"));
  EXPECT_TRUE(contains(errorOf(std::string(100000, '[')), "is nested deeper"));
  EXPECT_TRUE(contains(errorOf(std::string("image\0", 6)), "is not text"));
  EXPECT_TRUE(contains(errorOf(""), "a.yaml: is empty"));
  EXPECT_EQ(errorOf(head + origin), "");
}

TEST_F(MapServerFile, ImagesThatCannotBeReadAreNamed) {
  const std::string rest = "\nresolution: 1\norigin: [0, 0, 0]\n";
  const auto errorOfImage = [&](const std::string& name, const std::string& content) {
    folder_.write(name, content);
    return errorOf("image: " + name + rest);
  };
  EXPECT_TRUE(contains(errorOf("image: none.pgm" + rest),
                       "none.pgm: cannot be read: No such file or directory"));
  EXPECT_TRUE(contains(errorOf("image: none.pgm" + rest), "a.yaml:1: its image "));
  EXPECT_TRUE(contains(errorOf("image: ." + rest), "is a directory"));
  EXPECT_TRUE(contains(errorOfImage("b.pgm", ""), "b.pgm: is empty"));
  EXPECT_TRUE(contains(errorOfImage("b.pgm", "hello"), "b.pgm: is not an image"));
  EXPECT_TRUE(contains(errorOfImage("b.pgm", "P5\n3 2\n255\n12"), "b.pgm: is not an image"));
  EXPECT_TRUE(contains(errorOfImage("b.pgm", "P5\n0 0\n255\n"), "b.pgm: is not an image"));
  EXPECT_TRUE(contains(errorOfImage("b.pgm", "P5\n-3 2\n255\n123456"), "b.pgm: is not an image"));
  EXPECT_TRUE(contains(errorOfImage("b.png", "\x89PNG\r\n\x1a\n"), "b.png: is not an image"));
}

TEST_F(MapServerFile, FilesThatAreNoMapAreNamed) {
  EXPECT_TRUE(contains(errorText([&] { readMapFile(folder_.path("none")); }), "No such file"));
  EXPECT_TRUE(contains(errorText([&] { readMapFile(folder_.path("")); }), "is a directory"));
  EXPECT_TRUE(
      contains(errorText([&] { readMapFile(folder_.write("a", "#ROSBAG V2.0\n")); }), "is a bag"));
}

TEST_F(MapServerFile, WhatCannotBeWrittenIsNamed) {
  const OccupancyGrid map = AsciiMap({".#?"}).map;
  const std::string parent = folder_.write("parent", "x");
  EXPECT_TRUE(contains(errorText([&] { writeMapServerFile(parent + "/a.yaml", map); }),
                       ".pgm: cannot be written: Not a directory"));
  EXPECT_TRUE(contains(errorText([&] { writeMapServerFile(folder_.path("a.pgm"), map); }),
                       "must end in .yaml"));
  EXPECT_TRUE(contains(errorText([&] { writeImageFile(folder_.path("a.jpg"), map); }),
                       "must end in .pgm or .png"));
  EXPECT_TRUE(
      contains(errorText([&] { writeMapServerFile(folder_.path("a.yaml"), map, MapMode::SCALE); }),
               "scale"));
  EXPECT_EQ(folder_.names(), (Names{"parent"}));
}

TEST_F(MapServerFile, OnAFullDiskTheOldMapStaysWhole) {
  const OccupancyGrid old_map(GridGeometry(20, 20, 0.05), 0);
  const std::string file = folder_.path("a.yaml");
  writeMapServerFile(file, old_map);
  const OccupancyGrid large(GridGeometry(300, 300, 0.05), 100);
  EXPECT_TRUE(test::refusedOnAFullDisk(4096, [&] { writeMapServerFile(file, large); }));
  EXPECT_EQ(readMapFile(file), old_map);
  EXPECT_EQ(folder_.endings(), (Names{".pgm", ".yaml"}));
}

}  // namespace
}  // namespace grid_path_planner::grid
