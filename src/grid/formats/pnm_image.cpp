// PBM, PGM and PPM, as text (P1, P2, P3) and binary (P4, P5, P6), without a library: libnetpbm ends
// the process at a damaged file, and OpenCV prints errors of its own.
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>

#include "grid/formats/image_formats.h"

namespace grid_path_planner::grid {
namespace {

bool isSpace(char letter) {
  return std::isspace(static_cast<unsigned char>(letter)) != 0;
}

bool isDigit(char letter) {
  return letter >= '0' && letter <= '9';
}

class PnmReader {
 public:
  PnmReader(const std::string& content, const std::string& file)
      : content_(content), file_(file), kind_(content[1]) {}

  cv::Mat read(const ImageLimits& limits) {
    readHeader();
    limits.checkSize(width_, height_);
    if (content_.size() - at_ < leastBytes()) refuseEarlyEnd(file_, content_.size());
    limits.limits.take(file_, bytesOfPixels(width_, height_, (colours() ? 3 : 1) * bytesOfValue()));
    base::ReadPoll poll(limits.limits, file_, kRowsBetweenQuestions);
    cv::Mat image(height_, width_, CV_MAKETYPE(white_ > 255 ? CV_16U : CV_8U, colours() ? 3 : 1));
    for (int row = 0; row < height_; ++row) {
      poll();
      readRow(image, row);
    }
    const bool scaled = bits() || (isText() && white_ <= 255);  // pixel by pixel, as read
    if (!scaled && white_ != 255) image.convertTo(image, CV_8U, 255.0 / white_);
    return image;
  }

 private:
  static constexpr std::uint32_t kRowsBetweenQuestions = 64;

  // As read, and in 8 bits where it was read in 16 or is scaled.
  std::size_t bytesOfValue() const { return white_ > 255 ? 3 : white_ == 255 ? 1 : 2; }
  bool bits() const { return kind_ == '1' || kind_ == '4'; }
  bool colours() const { return kind_ == '3' || kind_ == '6'; }
  bool isText() const { return kind_ <= '3'; }
  std::size_t valuesInRow() const { return static_cast<std::size_t>(width_) * (colours() ? 3 : 1); }

  void readHeader() {
    const auto width = nextNumber(), height = nextNumber();
    const auto white = bits() ? std::optional<int>(1) : nextNumber();
    const bool ends = at_ == content_.size() || isSpace(content_[at_]);
    if (!width || !height || !white || *width == 0 || *height == 0 || *white == 0 ||
        *white > 65535 || !ends)
      refuseImage(file_, "its header does not give a width, a height and the value of white");
    width_ = *width;
    height_ = *height;
    white_ = *white;
    if (!isText()) endHeader();
  }
  // One byte of white space, or CR LF as Windows ends lines, where what is left holds the pixels.
  void endHeader() {
    const std::size_t left = content_.size() - at_;
    const bool two = content_.compare(at_, 2, "\r\n") == 0 && left >= 2 + leastBytes();
    at_ += std::min<std::size_t>(left, two ? 2 : 1);
  }
  std::size_t bytesInRow() const {
    return bits() ? (valuesInRow() + 7) / 8 : valuesInRow() * (white_ > 255 ? 2 : 1);
  }
  std::size_t leastBytes() const {
    const std::size_t in_row = isText() ? valuesInRow() : bytesInRow();
    return in_row * static_cast<std::size_t>(height_);
  }

  void readRow(cv::Mat& image, int row) {
    if (white_ > 255) return readWideRow(image.ptr<std::uint16_t>(row));
    auto* values = image.ptr<std::uint8_t>(row);
    if (kind_ == '1') {
      for (std::size_t i = 0; i < valuesInRow(); ++i) values[i] = nextBit() ? 0 : 255;
    } else if (isText()) {
      for (std::size_t i = 0; i < valuesInRow(); ++i)
        values[i] = static_cast<std::uint8_t>(nextValue() * 255 / white_);
    } else if (bits()) {
      for (std::size_t i = 0; i < valuesInRow(); ++i)
        values[i] =
            (static_cast<std::uint8_t>(content_[at_ + i / 8]) << i % 8 & 0x80) != 0 ? 0 : 255;
      at_ += bytesInRow();
    } else {
      std::copy_n(content_.begin() + static_cast<std::ptrdiff_t>(at_), bytesInRow(), values);
      at_ += bytesInRow();
    }
  }
  void readWideRow(std::uint16_t* values) {
    for (std::size_t i = 0; i < valuesInRow(); ++i)
      values[i] = static_cast<std::uint16_t>(isText() ? nextValue() : nextHighFirst());
  }

  int nextHighFirst() {
    const int high = static_cast<std::uint8_t>(content_[at_]),
              low = static_cast<std::uint8_t>(content_[at_ + 1]);
    at_ += 2;
    return high << 8 | low;
  }
  int nextValue() {
    const auto value = nextNumber();
    if (!value) refuseText();
    return std::min(*value, white_);
  }
  bool nextBit() {
    skipSpace();
    if (at_ == content_.size() || (content_[at_] != '0' && content_[at_] != '1')) refuseText();
    return content_[at_++] == '1';
  }
  [[noreturn]] void refuseText() const {
    if (at_ == content_.size()) refuseEarlyEnd(file_, at_);
    refuseImage(file_, "it is damaged: its byte " + std::to_string(at_) + " belongs to no number");
  }
  // The next number, with the white space and comments before it; none: there is none.
  std::optional<int> nextNumber() {
    skipSpace();
    constexpr std::size_t kMostDigits = 7;
    const std::size_t begin = at_;
    int number = 0;
    for (; at_ < content_.size() && isDigit(content_[at_]); ++at_) {
      if (at_ - begin == kMostDigits) return std::nullopt;
      number = 10 * number + (content_[at_] - '0');
    }
    if (at_ == begin) return std::nullopt;
    return number;
  }
  void skipSpace() {
    while (at_ < content_.size() && (isSpace(content_[at_]) || content_[at_] == '#'))
      if (content_[at_++] == '#')
        at_ = std::min(content_.find_first_of("\r\n", at_), content_.size());
  }

  const std::string& content_;
  const std::string& file_;
  char kind_;
  std::size_t at_ = 2;
  int width_ = 0;
  int height_ = 0;
  int white_ = 0;
};

}  // namespace

cv::Mat decodePnm(const std::string& content, const std::string& file, const ImageLimits& limits) {
  return PnmReader(content, file).read(limits);
}

}  // namespace grid_path_planner::grid
