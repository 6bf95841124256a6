// BMP by OpenCV, which prints an error of its own where a file ends early: so the file's header
// says first how long it must be.
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "grid/formats/image_formats.h"

namespace grid_path_planner::grid {
namespace {

// Values of the field "compression".
constexpr std::uint32_t kPlain = 0, kRle8 = 1, kRle4 = 2, kBitFields = 3;

class BmpHeader {
 public:
  BmpHeader(const std::string& content, const std::string& file) : content_(content), file_(file) {
    offset_ = number(10, 4);
    info_size_ = number(14, 4);
    if (info_size_ == kOldInfoSize) {
      width_ = number(18, 2);
      lines_ = number(20, 2);
      bits_ = number(24, 2);
      return;
    }
    if (info_size_ < kInfoSize || info_size_ > kLargestInfo) refuse("a header of unknown kind");
    width_ = number(18, 4);
    lines_ = std::abs(std::int64_t{static_cast<std::int32_t>(number(22, 4))});
    bits_ = number(28, 2);
    compression_ = number(30, 4);
    packed_size_ = number(34, 4);
    colours_ = number(46, 4);
  }

  bool isPacked() const { return compression_ == kRle8 || compression_ == kRle4; }
  int width() const { return static_cast<int>(width_); }
  int height() const { return static_cast<int>(lines_); }

  // Throws InputError for what OpenCV does not read, and for packed pixels without their size.
  void check() const {
    constexpr auto kLargestSide = std::int64_t{std::numeric_limits<std::int32_t>::max()};
    if (width_ < 1 || width_ > kLargestSide || lines_ < 1 || lines_ > kLargestSide)
      refuse("a width or height out of range");
    if (compression_ > kBitFields) refuse("an unknown compression");
    if (isPacked() && bits_ != (compression_ == kRle8 ? 8 : 4)) refuse("an unknown compression");
    if (isPacked() && packed_size_ == 0) refuse("packed pixels of no size");
    if (bits_ <= 8 && colours_ > kMostColours) refuse("more than 256 colours");
  }
  // Call after check() and once the size is accepted.
  void checkLength() const {
    const std::int64_t line = (width_ * bits_ + 31) / 32 * 4;
    const std::int64_t size = static_cast<std::int64_t>(content_.size());
    const std::int64_t room = size - offset_;
    // Not line * lines_: a header may speak of 2^31 lines of 2^31 pixels of 2^16 bits.
    const bool fits = isPacked() ? packed_size_ <= room : line <= room / lines_;
    if (!fits || size < 14 + info_size_ + bytesOfColours()) refuseEarlyEnd(file_, content_.size());
  }

 private:
  static constexpr std::int64_t kOldInfoSize = 12, kInfoSize = 40, kLargestInfo = 1 << 10,
                                kMostColours = 256;

  // What follows the header: the palette, or the masks of bit fields.
  std::int64_t bytesOfColours() const {
    if (compression_ == kBitFields) return 12;
    if (bits_ > 8) return 0;
    if (info_size_ == kOldInfoSize) return 3 << bits_;
    return 4 * (colours_ == 0 ? std::int64_t{1} << bits_ : colours_);
  }
  std::uint32_t number(std::size_t at, std::size_t count) const {
    if (content_.size() < at + count) refuseEarlyEnd(file_, content_.size());
    std::uint32_t value = 0;
    for (std::size_t i = at + count; i-- > at;)
      value = value << 8 | static_cast<std::uint8_t>(content_[i]);
    return value;
  }
  [[noreturn]] void refuse(const std::string& what) const {
    refuseImage(file_, "its header speaks of " + what);
  }

  const std::string& content_;
  const std::string& file_;
  std::int64_t offset_ = 0;
  std::int64_t info_size_ = 0;
  std::int64_t width_ = 0;
  std::int64_t lines_ = 0;
  std::int64_t bits_ = 0;
  std::uint32_t compression_ = kPlain;
  std::int64_t packed_size_ = 0;
  std::int64_t colours_ = 0;
};

}  // namespace

cv::Mat decodeBmp(const std::string& content, const std::string& file, const ImageLimits& limits) {
  const BmpHeader header(content, file);
  header.check();
  limits.checkSize(header.width(), header.height());
  header.checkLength();
  constexpr std::size_t kMostChannels = 4;
  limits.limits.take(
      file, content.size() + bytesOfPixels(header.width(), header.height(), kMostChannels));
  if (!header.isPacked()) return decodeWithOpenCv(content, file);
  // Zeros are ends of lines: a decoder that misreads the rest reaches the last one.
  const auto zeros = 4 * (static_cast<std::size_t>(header.height()) + 2);
  return decodeWithOpenCv(content + std::string(zeros, '\0'), file);
}

}  // namespace grid_path_planner::grid
