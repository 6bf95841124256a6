// PNG by libpng.
#include <png.h>

#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <vector>

#include "grid/formats/image_formats.h"
#include "grid/formats/longjmp_decoder.h"

namespace grid_path_planner::grid {
namespace {

constexpr std::uint64_t kMostOfDeflatedByte = 1032;  // what one may unpack to, by zlib's manual
constexpr png_uint_32 kLargestSide = 0x7fffffff;     // of the format

class PngReader : private LongjmpDecoder {
 public:
  PngReader(const std::string& content, const std::string& file, const ImageLimits& limits)
      : LongjmpDecoder(content, file, limits) {}
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  cv::Mat read() {
    run([this] { create(); });
    if (info_ == nullptr) throw std::bad_alloc();
    run([this] { readHeader(); });
    limits_.checkSize(width_, height_);
    if (std::uint64_t{png_get_channels(png_, info_)} * png_get_bit_depth(png_, info_) *
            static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_) / 8 >
        kMostOfDeflatedByte * content_.size())
      refuseTooManyPixels(file_, width_, height_, content_.size());
    run([this] { chooseConversions(); });
    limits_.limits.take(file_, bytesOfPixels(width_, height_, png_get_channels(png_, info_)) +
                                   sizeof(png_bytep) * static_cast<std::size_t>(height_));
    cv::Mat image(height_, width_, CV_8UC(static_cast<int>(png_get_channels(png_, info_))));
    std::vector<png_bytep> rows(static_cast<std::size_t>(height_));
    for (int row = 0; row < height_; ++row) rows[static_cast<std::size_t>(row)] = image.ptr(row);
    run([this, &rows] {
      png_read_image(png_, rows.data());
      png_read_end(png_, nullptr);
    });
    return image;
  }

 private:
  void create() {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  void readHeader() {
    png_set_read_fn(png_, this, giveBytes);
    png_set_user_limits(png_, kLargestSide, kLargestSide);
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);  // texts, profiles
    png_read_info(png_, info_);
    width_ = static_cast<int>(png_get_image_width(png_, info_));
    height_ = static_cast<int>(png_get_image_height(png_, info_));
  }
  // As OpenCV's: grey, colours, or colours and alpha. The transparent grey of a grey image is not
  // told apart.
  void chooseConversions() {
    const int type = png_get_color_type(png_, info_);
    png_set_strip_16(png_);
    if (type == PNG_COLOR_TYPE_GRAY) {
      png_set_expand_gray_1_2_4_to_8(png_);
    } else {
      png_set_palette_to_rgb(png_);
      png_set_gray_to_rgb(png_);
      if (png_get_valid(png_, info_, PNG_INFO_tRNS) != 0) png_set_tRNS_to_alpha(png_);
    }
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
  }

  static PngReader& readerOf(png_voidp pointer) { return *static_cast<PngReader*>(pointer); }
  [[noreturn]] static void onError(png_structp png, png_const_charp message) {
    PngReader& reader = readerOf(png_get_error_ptr(png));
    std::snprintf(reader.message_, sizeof reader.message_, "%s", message);
    std::longjmp(reader.jump_, 1);
  }
  static void onWarning(png_structp, png_const_charp) {}
  static void giveBytes(png_structp png, png_bytep bytes, std::size_t count) {
    PngReader& reader = readerOf(png_get_io_ptr(png));
    reader.late_ = !reader.limits_.limits.mayGoOn();
    if (reader.late_) png_error(png, "");
    reader.ends_early_ = count > reader.content_.size() - reader.at_;
    if (reader.ends_early_) png_error(png, "");
    std::memcpy(bytes, reader.content_.data() + reader.at_, count);
    reader.at_ += count;
  }

  std::size_t at_ = 0;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace

cv::Mat decodePng(const std::string& content, const std::string& file, const ImageLimits& limits) {
  return PngReader(content, file, limits).read();
}

}  // namespace grid_path_planner::grid
