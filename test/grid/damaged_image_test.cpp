// OpenCV and libpng printed errors of their own before ours, and half a JPEG was read as a map
// whose lower part was grey.
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "grid/formats/image_formats.h"
#include "grid_path_planner/grid/map_file.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::grid {
namespace {

using test::contains;

class DamagedImage : public testing::Test {
 protected:
  DamagedImage() : picture_(40, 60, CV_8UC1) { cv::randu(picture_, 0, 256); }

  std::string encoded(const std::string& extension, const std::vector<int>& how = {}) const {
    std::vector<unsigned char> bytes;
    cv::imencode(extension, picture_, bytes, how);
    return {bytes.begin(), bytes.end()};
  }
  // What is said of a file with this content, without its folder, and nothing else is said.
  std::string errorOf(const std::string& extension, const std::string& content) const {
    const std::string file = folder_.write("a" + extension, content);
    testing::internal::CaptureStderr();
    const std::string error = test::errorText([&] { readMapFile(file); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << extension << ", " << error;
    return error.substr(std::min(error.size(), folder_.path("").size()));
  }
  void expectRefusedWhereCut(const std::string& extension, const std::string& content) const {
    EXPECT_EQ(errorOf(extension, content), "");
    for (std::size_t size = 9; size < content.size(); size += 1 + content.size() / 97) {
      const std::string error = errorOf(extension, content.substr(0, size));
      EXPECT_TRUE(contains(error, "a" + extension + ": is not an image that can be read: it"))
          << error << " for " << size << " of " << content.size() << " bytes";
    }
  }

  const test::TemporaryFolder folder_;
  cv::Mat picture_;
};

TEST_F(DamagedImage, ThatEndsEarlyIsRefusedInOneSentence) {
  expectRefusedWhereCut(".png", encoded(".png"));
  expectRefusedWhereCut(".jpg", encoded(".jpg"));
  expectRefusedWhereCut(".bmp", encoded(".bmp"));
  expectRefusedWhereCut(".pgm", encoded(".pgm"));
  expectRefusedWhereCut(".pgm", encoded(".pgm", {cv::IMWRITE_PXM_BINARY, 0}));
  expectRefusedWhereCut(".pbm", encoded(".pbm"));
  expectRefusedWhereCut(".ppm", "P6\n# a comment\n2 1\n255\n123456");
  expectRefusedWhereCut(".pbm", "P1\n3 2\n101011");
  const std::string text = errorOf(".png", encoded(".png").substr(0, 100));
  EXPECT_EQ(text, "a.png: is not an image that can be read: it ends early, after 100 bytes");
}

// 2^30 lines of 2^30 pixels of 128 bits are 2^64 bytes, which was taken for none.
TEST_F(DamagedImage, ABmpOfMoreBytesThanCanBeCountedEndsEarly) {
  std::string content = encoded(".bmp");
  content.replace(18, 8, std::string("\0\0\0\x40\0\0\0\x40", 8));
  content.replace(28, 2, std::string("\x80\0", 2));
  base::ReadLimits limits({64, 60.0});
  const auto decode = [&] { decodeBmp(content, "a.bmp", {[](int, int) {}, limits}); };
  EXPECT_TRUE(contains(test::errorText(decode), "it ends early")) << test::errorText(decode);
}

TEST_F(DamagedImage, AByteOfAPngIsNoticed) {
  const std::string whole = encoded(".png");
  for (std::size_t at = 8; at < whole.size(); at += 1 + whole.size() / 97) {
    std::string content = whole;
    content[at] = static_cast<char>(content[at] ^ 0x10);
    EXPECT_TRUE(contains(errorOf(".png", content), "a.png: is not an image that can be read: it"))
        << at;
  }
}

// Cameras and tools add things.
TEST_F(DamagedImage, WhatFollowsTheImageDoesNotMatter) {
  for (const char* extension : {".png", ".jpg", ".bmp", ".pgm", ".pbm"})
    EXPECT_EQ(errorOf(extension, encoded(extension) + "and more"), "") << extension;
}

}  // namespace
}  // namespace grid_path_planner::grid
