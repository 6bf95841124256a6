// JPEG by libjpeg-turbo.
#include <csetjmp>
#include <cstdint>
#include <cstdio>
// libjpeg's headers need <cstdio>'s names and do not include it.
#include <jerror.h>
#include <jpeglib.h>

#include "grid/formats/image_formats.h"
#include "grid/formats/longjmp_decoder.h"

namespace grid_path_planner::grid {
namespace {

// A Huffman code takes a bit at least, and one is needed for every 8x8 block of each component. The
// factor 2: a file may give no component every block of the picture.
constexpr std::uint64_t kMostPixelsOfByte = 2 * 8 * 64;

// Of what libjpeg only warns about, whatever leaves the pixels as they were meant.
bool isHarmless(int warning) {
  return warning == JWRN_ADOBE_XFORM || warning == JWRN_BOGUS_PROGRESSION ||
         warning == JWRN_EXTRANEOUS_DATA || warning == JWRN_JFIF_MAJOR ||
         warning == JWRN_NOT_SEQUENTIAL;
}

class JpegReader : private LongjmpDecoder {
 public:
  JpegReader(const std::string& content, const std::string& file, const ImageLimits& limits)
      : LongjmpDecoder(content, file, limits) {}
  ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }

  cv::Mat read() {
    run([this] { readHeader(); });
    const int width = static_cast<int>(jpeg_.image_width);
    const int height = static_cast<int>(jpeg_.image_height);
    limits_.checkSize(width, height);
    if (!jpeg_.arith_code &&
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) >
            kMostPixelsOfByte * content_.size())
      refuseTooManyPixels(file_, width, height, content_.size());
    limits_.limits.take(file_, bytesFor(width, height));
    run([this] { start(); });
    cv::Mat image(height, width, CV_8UC(jpeg_.output_components));
    run([this, &image] { readRows(image); });
    return image.channels() == 4 ? coloursOfInks(image) : image;
  }

 private:
  void readHeader() {
    jpeg_.err = jpeg_std_error(&errors_);
    errors_.error_exit = onError;
    errors_.emit_message = onMessage;
    errors_.output_message = [](j_common_ptr) {};
    jpeg_.client_data = this;
    jpeg_create_decompress(&jpeg_);
    source_.next_input_byte = reinterpret_cast<const JOCTET*>(content_.data());
    source_.bytes_in_buffer = content_.size();
    source_.init_source = [](j_decompress_ptr) {};
    source_.fill_input_buffer = onEarlyEnd;
    source_.skip_input_data = skip;
    source_.resync_to_restart = jpeg_resync_to_restart;
    source_.term_source = [](j_decompress_ptr) {};
    jpeg_.src = &source_;
    jpeg_read_header(&jpeg_, TRUE);
  }
  // Of the pixels, twice where they are inks; and of all coefficients, which are kept until the last
  // scan where there are several.
  std::size_t bytesFor(int width, int height) {
    constexpr int kLargestBlock = 4 * DCTSIZE;
    const auto channels = static_cast<std::size_t>(jpeg_.num_components);
    const std::size_t pixels = bytesOfPixels(width, height, channels == 4 ? 7 : channels);
    if (jpeg_has_multiple_scans(&jpeg_) == FALSE) return pixels;
    return pixels +
           sizeof(JCOEF) * bytesOfPixels(width + kLargestBlock, height + kLargestBlock, channels);
  }
  void start() {
    progress_.progress_monitor = [](j_common_ptr jpeg) {
      JpegReader& reader = readerOf(jpeg->client_data);
      reader.late_ = !reader.limits_.limits.mayGoOn();
      if (reader.late_) std::longjmp(reader.jump_, 1);
    };
    jpeg_.progress = &progress_;
    if (jpeg_.num_components == 4)
      jpeg_.out_color_space = JCS_CMYK;
    else
      jpeg_.out_color_space = jpeg_.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_start_decompress(&jpeg_);
  }
  void readRows(cv::Mat& image) {
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = image.ptr(static_cast<int>(jpeg_.output_scanline));
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);  // reads up to the mark of the end
  }
  // Of cyan, magenta, yellow and black, written inverted as all programs do; computed as OpenCV
  // does.
  static cv::Mat coloursOfInks(const cv::Mat& inks) {
    cv::Mat colours(inks.rows, inks.cols, CV_8UC3);
    for (int row = 0; row < inks.rows; ++row) {
      const auto* ink = inks.ptr<std::uint8_t>(row);
      auto* colour = colours.ptr<std::uint8_t>(row);
      for (int column = 0; column < inks.cols; ++column, ink += 4, colour += 3)
        for (int i = 0; i < 3; ++i)
          colour[i] = static_cast<std::uint8_t>(ink[3] - ((255 - ink[i]) * ink[3] >> 8));
    }
    return colours;
  }

  static_assert(sizeof message_ >= JMSG_LENGTH_MAX);

  static JpegReader& readerOf(void* client_data) { return *static_cast<JpegReader*>(client_data); }
  [[noreturn]] static void onError(j_common_ptr jpeg) {
    JpegReader& reader = readerOf(jpeg->client_data);
    jpeg->err->format_message(jpeg, reader.message_);
    std::longjmp(reader.jump_, 1);
  }
  static void onMessage(j_common_ptr jpeg, int level) {
    if (level < 0 && !isHarmless(jpeg->err->msg_code)) onError(jpeg);
  }
  static boolean onEarlyEnd(j_decompress_ptr jpeg) {
    JpegReader& reader = readerOf(jpeg->client_data);
    reader.ends_early_ = true;
    std::longjmp(reader.jump_, 1);
  }
  static void skip(j_decompress_ptr jpeg, long count) {
    if (count <= 0) return;
    if (static_cast<std::size_t>(count) > jpeg->src->bytes_in_buffer) onEarlyEnd(jpeg);
    jpeg->src->next_input_byte += count;
    jpeg->src->bytes_in_buffer -= static_cast<std::size_t>(count);
  }

  jpeg_decompress_struct jpeg_{};
  jpeg_error_mgr errors_{};
  jpeg_source_mgr source_{};
  jpeg_progress_mgr progress_{};
};

}  // namespace

cv::Mat decodeJpeg(const std::string& content, const std::string& file, const ImageLimits& limits) {
  return JpegReader(content, file, limits).read();
}

}  // namespace grid_path_planner::grid
