// Every kind of image means what OpenCV, which once decoded them all, decodes of it; damage at any
// byte is told in one sentence, and a header's claim takes no memory.
#include <gtest/gtest.h>
#include <png.h>

#include <boost/crc.hpp>
#include <cstdint>
#include <cstdio>
// libjpeg's header needs <cstdio>'s names and does not include it.
#include <jpeglib.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <vector>

#include "grid/formats/image_file.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::grid {
namespace {

using test::contains;
using namespace std::literals;

std::string bigEndian(std::uint32_t value) {
  std::string bytes;
  for (int i = 3; i >= 0; --i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  return bytes;
}

std::string littleEndian(std::uint64_t value, int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  return bytes;
}

// ---- Writers of what OpenCV does not write

struct PngKind {
  int colour_type;
  int depth;
  bool interlaced;
  bool transparency;  // a tRNS chunk
};

void append(png_structp png, png_bytep bytes, std::size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))
      ->append(reinterpret_cast<const char*>(bytes), count);
}

void writeHeader(png_structp png, png_infop info, const PngKind& kind, int width, int height,
                 std::mt19937& random) {
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
               kind.depth, kind.colour_type,
               kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  const int colours = 1 << kind.depth;
  std::vector<png_color> palette(256);
  std::vector<png_byte> alpha(256);
  for (png_color& colour : palette)
    colour = {png_byte(random()), png_byte(random()), png_byte(random())};
  for (png_byte& value : alpha) value = random() % 3 ? png_byte(random()) : png_byte(0);
  if (kind.colour_type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), colours);
  png_color_16 key{};
  key.gray = 1;
  if (kind.transparency) png_set_tRNS(png, info, alpha.data(), std::min(colours, 256), &key);
  png_write_info(png, info);
}

std::string pngOf(const PngKind& kind, int width, int height, std::mt19937& random) {
  std::string content;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &content, append, nullptr);
  writeHeader(png, info, kind, width, height, random);
  std::vector<std::vector<png_byte>> rows(static_cast<std::size_t>(height));
  std::vector<png_bytep> pointers;
  for (auto& row : rows) {
    row.resize(png_get_rowbytes(png, info));
    for (png_byte& byte : row) byte = random() % 4 ? png_byte(random()) : png_byte(0);
    pointers.push_back(row.data());
  }
  png_write_image(png, pointers.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return content;
}

std::string cmykJpegOf(int width, int height, std::mt19937& random) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = static_cast<JDIMENSION>(width);
  jpeg.image_height = static_cast<JDIMENSION>(height);
  jpeg.input_components = 4;
  jpeg.in_color_space = JCS_CMYK;
  jpeg_set_defaults(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<JSAMPLE> row(static_cast<std::size_t>(4 * width));
  for (int i = 0; i < height; ++i) {
    for (JSAMPLE& value : row) value = static_cast<JSAMPLE>(random());
    JSAMPROW pointer = row.data();
    jpeg_write_scanlines(&jpeg, &pointer, 1);
  }
  jpeg_finish_compress(&jpeg);
  std::string content(reinterpret_cast<const char*>(bytes), size);
  jpeg_destroy_compress(&jpeg);
  std::free(bytes);
  return content;
}

// Of 3x2 pixels of 8 bits in packed lines: bytes as they are, and a run.
std::string packedBmp() {
  const std::string pixels = "\x00\x03\x05\x06\x07\x00\x00\x00\x03\x01\x00\x01"s;
  std::string palette;
  for (std::uint32_t i = 0; i < 8; ++i) palette += littleEndian(0x1c1c1c * i, 4);
  return "BM" + littleEndian(static_cast<std::uint32_t>(54 + palette.size() + pixels.size()), 4) +
         littleEndian(0, 4) + littleEndian(static_cast<std::uint32_t>(54 + palette.size()), 4) +
         littleEndian(40, 4) + littleEndian(3, 4) + littleEndian(2, 4) + littleEndian(1, 2) +
         littleEndian(8, 2) + littleEndian(1, 4) +
         littleEndian(static_cast<std::uint32_t>(pixels.size()), 4) + littleEndian(0, 8) +
         littleEndian(8, 4) + littleEndian(0, 4) + palette + pixels;
}

// Of 3x2 pixels of 1 bit, with the header of OS/2.
std::string oldBmp() {
  return "BM" + littleEndian(40, 4) + littleEndian(0, 4) + littleEndian(32, 4) +
         littleEndian(12, 4) + littleEndian(3, 2) + littleEndian(2, 2) + littleEndian(1, 2) +
         littleEndian(1, 2) + "\x00\x00\x00\xff\xff\xff"s + "\xa0\x00\x00\x00\x40\x00\x00\x00"s;
}

// ---- What the rules of image_file.h make of what OpenCV decodes

// `white`: of a binary PGM or PPM, which OpenCV leaves as it is.
std::vector<std::int8_t> expectedOf(const std::string& content, const PixelRule& rule, int white) {
  cv::Mat image = cv::imdecode(std::vector<char>(content.begin(), content.end()), -1);
  if (white == 0) white = image.depth() == CV_8U ? 255 : 65535;
  const bool upper_bits = image.depth() == CV_16U && content[1] == 'P';  // of a PNG
  image.convertTo(image, CV_8U, upper_bits ? 1.0 / 256 : 255.0 / white, upper_bits ? -0.499 : 0.0);
  const int channels = image.channels();
  const int averaged = channels == 4 && rule.mode != MapMode::TRINARY ? 3 : channels;
  std::vector<std::int8_t> values;
  for (int row = image.rows - 1; row >= 0; --row)
    for (int column = 0; column < image.cols; ++column) {
      const std::uint8_t* pixel = image.ptr(row) + column * channels;
      double value = 0;
      for (int i = 0; i < averaged; ++i) value += pixel[i];
      value = rule.negate ? 255 - value / averaged : value / averaged;
      const double occupied = (255 - value) / 255.0;
      const double range = rule.occupied_thresh - rule.free_thresh;
      if (rule.mode == MapMode::RAW)
        values.push_back(value < 101 ? static_cast<std::int8_t>(value) : std::int8_t{-1});
      else if (occupied > rule.occupied_thresh || occupied < rule.free_thresh)
        values.push_back(occupied > rule.occupied_thresh ? 100 : 0);
      else if (rule.mode == MapMode::TRINARY || (channels == 4 && pixel[3] == 0))
        values.push_back(-1);
      else
        values.push_back(
            static_cast<std::int8_t>(1 + 98 * ((occupied - rule.free_thresh) / range)));
    }
  return values;
}

// Together they tell every grey from every other, and use alpha as a grey value and as transparency.
const std::vector<PixelRule> kRules{{MapMode::RAW, false, 0.65, 0.196},
                                    {MapMode::RAW, true, 0.65, 0.196},
                                    {MapMode::SCALE, false, 0.62, 0.38},
                                    {MapMode::TRINARY, false, 0.65, 0.196}};

class ImageFormats : public testing::Test {
 protected:
  std::vector<std::int8_t> read(const std::string& content, const PixelRule& rule = {}) const {
    MapFileOptions options;
    return readImageFile(folder_.write("image", content), rule, 1.0, {}, options).values();
  }
  void expectAsOpenCv(const std::string& content, int white = 0) const {
    for (const PixelRule& rule : kRules)
      ASSERT_EQ(read(content, rule), expectedOf(content, rule, white));
  }
  std::string refusal(const std::string& content) const {
    const std::string text = test::errorText([&] { read(content); });
    EXPECT_TRUE(text.empty() || contains(text, folder_.path("image") + ": ")) << text;
    return text;
  }
  cv::Mat noise(int type) {
    cv::Mat image(1 + static_cast<int>(random_() % 40), 1 + static_cast<int>(random_() % 40), type);
    cv::theRNG().state = random_();
    cv::randu(image, 0, CV_MAT_DEPTH(type) == CV_8U ? 256 : 65536);
    return image;
  }
  std::string encoded(const std::string& extension, int type, const std::vector<int>& how = {}) {
    std::vector<unsigned char> bytes;
    cv::imencode(extension, noise(type), bytes, how);
    return {bytes.begin(), bytes.end()};
  }
  // One of each, small, and how OpenCV's writers make it.
  std::vector<std::string> oneOfEach() {
    std::vector<std::string> images{packedBmp(), oldBmp(), cmykJpegOf(9, 5, random_)};
    for (const bool interlaced : {false, true})
      images.push_back(pngOf({PNG_COLOR_TYPE_PALETTE, 4, interlaced, true}, 9, 5, random_));
    for (const char* extension : {".png", ".jpg", ".bmp", ".pgm", ".pbm"})
      images.push_back(encoded(extension, CV_8UC1));
    images.push_back(encoded(".jpg", CV_8UC3, {cv::IMWRITE_JPEG_PROGRESSIVE, 1}));
    images.push_back(encoded(".bmp", CV_8UC4));
    images.push_back(encoded(".pgm", CV_16UC1));
    images.push_back(encoded(".ppm", CV_8UC3, {cv::IMWRITE_PXM_BINARY, 0}));
    images.push_back("P1\n3 2\n101 011\n");
    return images;
  }

  const test::TemporaryFolder folder_;
  std::mt19937 random_{20261122};
};

TEST_F(ImageFormats, PngsOfEveryKindMeanWhatOpenCvDecodes) {
  const std::vector<std::pair<int, std::vector<int>>> kinds{{PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}},
                                                            {PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}},
                                                            {PNG_COLOR_TYPE_RGB, {8, 16}},
                                                            {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}},
                                                            {PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}}};
  for (const auto& [colour_type, depths] : kinds)
    for (const int depth : depths)
      for (const bool interlaced : {false, true})
        for (const bool transparency : {false, true}) {
          if (transparency && (colour_type & PNG_COLOR_MASK_ALPHA) != 0) continue;
          SCOPED_TRACE(std::to_string(colour_type) + " " + std::to_string(depth) + " " +
                       std::to_string(interlaced) + std::to_string(transparency));
          for (const int side : {1, 7, 40})
            expectAsOpenCv(
                pngOf({colour_type, depth, interlaced, transparency}, side, 41 - side, random_));
        }
}

TEST_F(ImageFormats, JpegsOfEveryKindMeanWhatOpenCvDecodes) {
  for (int trial = 0; trial < 5; ++trial)
    for (const int type : {CV_8UC1, CV_8UC3})
      for (const int progressive : {0, 1})
        expectAsOpenCv(
            encoded(".jpg", type,
                    {cv::IMWRITE_JPEG_PROGRESSIVE, progressive, cv::IMWRITE_JPEG_RST_INTERVAL,
                     trial, cv::IMWRITE_JPEG_QUALITY, 60 + 10 * trial}));
  expectAsOpenCv(cmykJpegOf(33, 17, random_));
}

TEST_F(ImageFormats, PnmsAndBmpsOfEveryKindMeanWhatOpenCvDecodes) {
  for (int trial = 0; trial < 5; ++trial) {
    for (const int binary : {0, 1}) {
      const std::vector<int> how{cv::IMWRITE_PXM_BINARY, binary};
      for (const int type : {CV_8UC1, CV_16UC1}) expectAsOpenCv(encoded(".pgm", type, how));
      for (const int type : {CV_8UC3, CV_16UC3}) expectAsOpenCv(encoded(".ppm", type, how));
      expectAsOpenCv(encoded(".pbm", CV_8UC1, how));
    }
    for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4}) expectAsOpenCv(encoded(".bmp", type));
  }
  expectAsOpenCv("P2 # white is 9\n3 2 9\n0 1 2\n# more\n3 8 9\n");
  expectAsOpenCv("P3\n1 2\n100 0 50 100 7 99 101\n");
  expectAsOpenCv("P5\n3 2\n100\n\x0a\x32\x64\x63\xff\x01", 100);
  expectAsOpenCv("P5\n2 1\n1000\n\x03\xe8\x01\x02", 1000);
  expectAsOpenCv(packedBmp());
  expectAsOpenCv(oldBmp());
}

// OpenCV left these as they are, so that all was nearly black.
TEST_F(ImageFormats, ATextPgmOfMoreThan8BitsIsScaledByItsWhite) {
  EXPECT_EQ(read("P2\n3 1\n1000\n0 800 1000\n"), (std::vector<std::int8_t>{100, -1, 0}));
}

TEST_F(ImageFormats, AnEarlyEndIsToldAtEveryByteWithoutAWordElsewhere) {
  testing::internal::CaptureStderr();
  for (const std::string& whole : oneOfEach()) {
    ASSERT_EQ(refusal(whole), "");
    // Of a text the last number may be cut and still be one.
    const bool text = whole[0] == 'P' && whole[1] <= '3';
    for (std::size_t size = 1; size < whole.size() - (text ? 8 : 0); ++size) {
      const std::string told = refusal(whole.substr(0, size));
      ASSERT_TRUE(contains(told, "is not an image that can be read"))
          << size << " of " << whole.size() << " bytes of " << whole.substr(0, 4) << ", " << told;
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ImageFormats, ChangedBitsNeverCrashNorSpeak) {
  int refused = 0, changed = 0;
  testing::internal::CaptureStderr();
  for (const std::string& whole : oneOfEach()) {
    const bool png = whole[1] == 'P';
    for (std::size_t at = 2; at < whole.size(); ++at, ++changed) {
      std::string content = whole;
      content[at] = static_cast<char>(content[at] ^ 1 << random_() % 8);
      const std::string told = refusal(content);
      refused += told.empty() ? 0 : 1;
      ASSERT_TRUE(!png || !told.empty()) << "byte " << at;
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, changed);
}

std::string pngThatClaims(std::uint32_t width, std::uint32_t height) {
  const std::string header =
      "IHDR" + bigEndian(width) + bigEndian(height) + "\x08\x00\x00\x00\x00"s;
  boost::crc_32_type sum;
  sum.process_bytes(header.data(), header.size());
  boost::crc_32_type end;
  end.process_bytes("IDAT", 4);
  return "\x89PNG\r\n\x1a\n" + bigEndian(13) + header + bigEndian(sum.checksum()) + bigEndian(0) +
         "IDAT" + bigEndian(end.checksum());
}

// Behind the marks of its beginning: how a JPEG tells its height and width.
std::string jpegThatClaims(std::string jpeg, std::uint32_t width, std::uint32_t height) {
  const std::size_t frame = jpeg.find("\xff\xc0");
  return jpeg.replace(frame + 5, 4, bigEndian(height << 16 | width));
}

TEST_F(ImageFormats, SizesThatTheFileCannotHoldAreRefusedBeforeMemoryIsTaken) {
  const std::string jpeg = encoded(".jpg", CV_8UC1);
  EXPECT_TRUE(contains(refusal(pngThatClaims(40000, 26000)),
                       "bytes cannot hold the 40000x26000 pixels of its header"));
  EXPECT_TRUE(contains(refusal(jpegThatClaims(jpeg, 40000, 26000)),
                       "bytes cannot hold the 40000x26000 pixels of its header"));
  EXPECT_TRUE(contains(refusal("P5\n40000 26000\n255\n0"), "ends early"));
  EXPECT_TRUE(contains(refusal("P1\n40000 26000\n0"), "ends early"));
  for (const std::string& content :
       {pngThatClaims(40000, 27000), jpegThatClaims(jpeg, 40000, 27000), "P6 40000 27000 255 "s})
    EXPECT_TRUE(contains(refusal(content), "is an image of 40000x27000 pixels, more than 2^30"));
  for (const std::string& content :
       {pngThatClaims(0x7fffffff, 1), "P4 9999999 1 "s,
        "BM"s.append(12, '\0') + littleEndian(40, 4) + littleEndian(1 << 20, 4) +
            littleEndian(1, 4).append(30, '\0')})
    EXPECT_TRUE(contains(refusal(content), "larger than 2^31 - 1 cells or 2^19 a side"));
  EXPECT_NE(refusal(pngThatClaims(0, 7)), "");
  EXPECT_NE(refusal(pngThatClaims(0xffffffff, 7)), "");
}

TEST_F(ImageFormats, TextsThatHoldNoNumberAreRefusedAtTheirByte) {
  EXPECT_TRUE(
      contains(refusal("P2\n2 1\n9\n3 x"), "it is damaged: its byte 11 belongs to no number"));
  EXPECT_TRUE(contains(refusal("P1\n2 1\n12"), "it is damaged: its byte 8 belongs to no number"));
  for (const char* header : {"P2\n0 1\n9\n3", "P2\n1 1\n0\n3", "P5\n1 1\n65536\n33", "P5\n1\n"})
    EXPECT_TRUE(contains(refusal(header), "its header does not give a width")) << header;
}

}  // namespace
}  // namespace grid_path_planner::grid
