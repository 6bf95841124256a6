// TIFF by OpenCV's libtiff, once the first directory of the file has told what that will take.
#include <algorithm>
#include <cstdint>
#include <limits>

#include "grid/formats/image_formats.h"

namespace grid_path_planner::grid {
namespace {

enum Tag : std::uint32_t {
  WIDTH = 256,
  HEIGHT = 257,
  BITS = 258,
  COMPRESSION = 259,
  CHANNELS = 277,
  ROWS_IN_STRIP = 278,
  TILE_WIDTH = 322,
  TILE_HEIGHT = 323,
};

enum Type : std::uint32_t { BYTE = 1, SHORT = 3, LONG = 4 };

// Others (LZMA, Zstandard) have dictionaries as large as their data claims.
bool isBounded(std::uint64_t compression) {
  constexpr std::uint64_t kNone = 1, kFaxes = 4, kLzw = 5, kJpeg = 7, kDeflate = 8,
                          kPackBits = 32773, kOldDeflate = 32946;
  return (compression >= kNone && compression <= kFaxes) || compression == kLzw ||
         compression == kJpeg || compression == kDeflate || compression == kPackBits ||
         compression == kOldDeflate;
}

class TiffDirectory {
 public:
  TiffDirectory(const std::string& content, const std::string& file)
      : content_(content), file_(file), high_first_(content[0] == 'M') {
    const std::uint64_t begin = number(4, 4), entries = number(begin, 2);
    for (std::uint64_t i = 0; i < entries; ++i) readEntry(begin + 2 + i * kEntrySize);
    constexpr std::uint64_t kLargestSide = std::numeric_limits<std::int32_t>::max();
    if (width_ < 1 || width_ > kLargestSide || height_ < 1 || height_ > kLargestSide)
      refuse("a width or height out of range");
    if (!isBounded(compression_)) refuse("an unknown compression");
    if (channels_ > kMostChannels) refuse("more than 4 channels");
    if (bits_ > 64) refuse("more than 64 bits a channel");
  }

  int width() const { return static_cast<int>(width_); }
  int height() const { return static_cast<int>(height_); }

  // Of the pixels as they are read, in 8 bits, and of the largest piece of them.
  std::size_t bytes() const {
    const std::size_t pixel = kMostChannels * std::max<std::size_t>(1, (bits_ + 7) / 8);
    const std::uint64_t piece_width = tile_width_ > 0 ? tile_width_ : width_;
    const std::uint64_t piece_height = tile_height_ > 0 ? tile_height_ : stripHeight();
    return (width_ * height_) * (pixel + kMostChannels) +
           2 * pixel * std::min(piece_width, kFar) * std::min(piece_height, kFar);
  }

 private:
  static constexpr std::uint64_t kEntrySize = 12, kMostChannels = 4;
  static constexpr std::uint64_t kWholeImage = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint64_t kFar = 1u << 24;  // such pieces are refused by OpenCV

  // OpenCV makes room for all rows that a strip claims, however few the image has.
  std::uint64_t stripHeight() const {
    return whole_strip_ || rows_in_strip_ == 0 ? std::max(rows_in_strip_, height_) : rows_in_strip_;
  }

  // What is kept of a tag; null for others.
  std::uint64_t* keptOf(std::uint64_t tag) {
    switch (tag) {
      case WIDTH:
        return &width_;
      case HEIGHT:
        return &height_;
      case BITS:
        return &bits_;
      case COMPRESSION:
        return &compression_;
      case CHANNELS:
        return &channels_;
      case ROWS_IN_STRIP:
        return &rows_in_strip_;
      case TILE_WIDTH:
        return &tile_width_;
      case TILE_HEIGHT:
        return &tile_height_;
      default:
        return nullptr;
    }
  }

  // Of a tag that comes twice the largest value: which of them libtiff takes is its own affair.
  void readEntry(std::uint64_t at) {
    const std::uint64_t tag = number(at, 2), type = number(at + 2, 2), count = number(at + 4, 4);
    std::uint64_t* const kept = keptOf(tag);
    if (kept == nullptr || count == 0) return;
    const std::uint64_t size = type == BYTE ? 1 : type == SHORT ? 2 : type == LONG ? 4 : 0;
    if (size == 0)
      refuse("a size in a type that is not meant for it");  // libtiff reads some of these
    const std::uint64_t value =
        number(size * count <= 4 ? at + 8 : number(at + 8, 4), static_cast<int>(size));
    if (tag == ROWS_IN_STRIP && value >= kWholeImage)
      whole_strip_ = true;
    else
      *kept = std::max(*kept, value);
  }

  std::uint64_t number(std::uint64_t at, int count) const {
    if (at > content_.size() || content_.size() - at < static_cast<std::size_t>(count))
      refuseEarlyEnd(file_, content_.size());
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i) {
      const std::uint64_t place = at + static_cast<std::uint64_t>(high_first_ ? i : count - 1 - i);
      value = value << 8 | static_cast<std::uint8_t>(content_[place]);
    }
    return value;
  }
  [[noreturn]] void refuse(const std::string& what) const {
    refuseImage(file_, "its header speaks of " + what);
  }

  const std::string& content_;
  const std::string& file_;
  const bool high_first_;
  std::uint64_t width_ = 0;
  std::uint64_t height_ = 0;
  std::uint64_t bits_ = 1;
  std::uint64_t compression_ = 1;
  std::uint64_t channels_ = 1;
  std::uint64_t rows_in_strip_ = 0;
  bool whole_strip_ = false;
  std::uint64_t tile_width_ = 0;
  std::uint64_t tile_height_ = 0;
};

}  // namespace

cv::Mat decodeTiff(const std::string& content, const std::string& file, const ImageLimits& limits) {
  const TiffDirectory directory(content, file);
  limits.checkSize(directory.width(), directory.height());
  limits.limits.take(file, directory.bytes());
  return decodeWithOpenCv(content, file);
}

}  // namespace grid_path_planner::grid
