#include "image_check.h"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner {
namespace {

using namespace std::literals;

[[noreturn]] void refuse(const std::string& file, const std::string& reason) {
  throw InputError(file, "is not an image that can be read: " + reason);
}

[[noreturn]] void refuseEarlyEnd(const std::string& file, std::size_t size) {
  refuse(file, "it ends early, after " + std::to_string(size) + " bytes");
}

bool startsWith(std::string_view bytes, std::string_view start) {
  return bytes.substr(0, start.size()) == start;
}

// Precondition: the bytes are there.
std::uint64_t highFirst(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = at; i < at + count; ++i)
    value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

std::uint64_t lowFirst(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = at + count; i-- > at;)
    value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

// ---- PNG: chunks of length, name, data and checksum, the last one IEND.

constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n"sv;

void checkPng(std::string_view bytes, const std::string& file) {
  constexpr std::size_t kAround = 12;  // bytes of a chunk beside its data
  std::string_view name;
  for (std::size_t at = kPng.size(); name != "IEND";) {
    if (bytes.size() < at + kAround) refuseEarlyEnd(file, bytes.size());
    const std::uint64_t length = highFirst(bytes, at, 4);
    if (bytes.size() - at - kAround < length) refuseEarlyEnd(file, bytes.size());
    name = bytes.substr(at + 4, 4);
    const std::string_view summed = bytes.substr(at + 4, 4 + length);
    const auto sum =
        crc32(0, reinterpret_cast<const Bytef*>(summed.data()), static_cast<uInt>(summed.size()));
    if (sum != highFirst(bytes, at + 8 + length, 4))
      refuse(file, "it is damaged near byte " + std::to_string(at));
    at += kAround + length;
  }
}

// ---- JPEG: segments that begin with 0xff and a code, then coded pixels, the last one 0xd9.

constexpr std::string_view kJpeg = "\xff\xd8\xff"sv;

// A code that stands alone: no length follows it. Behind 0xff, 0 is a byte of the pixels.
bool standsAlone(std::uint8_t code) {
  return code <= 1 || (code >= 0xd0 && code <= 0xd8);
}

void checkJpeg(std::string_view bytes, const std::string& file) {
  constexpr std::uint8_t kMark = 0xff, kEnd = 0xd9;
  std::size_t at = 2;
  while (at + 1 < bytes.size()) {
    const auto mark = static_cast<std::uint8_t>(bytes[at]);
    const auto code = static_cast<std::uint8_t>(bytes[at + 1]);
    if (mark != kMark || code == kMark) {
      ++at;  // pixels, or filling
    } else if (code == kEnd) {
      return;
    } else {
      at += 2;
      if (standsAlone(code)) continue;
      if (bytes.size() < at + 2) break;
      at += highFirst(bytes, at, 2);
    }
  }
  refuseEarlyEnd(file, bytes.size());
}

// ---- BMP without compression

void checkBmp(std::string_view bytes, const std::string& file) {
  constexpr std::size_t kHeader = 34, kLargestSide = std::size_t{1} << 20;
  if (bytes.size() < kHeader) refuseEarlyEnd(file, bytes.size());
  const std::uint64_t info_size = lowFirst(bytes, 14, 4), compression = lowFirst(bytes, 30, 4);
  if (info_size < 40 || compression != 0) return;  // older and rarer kinds
  const std::uint64_t width = lowFirst(bytes, 18, 4);
  const auto height = static_cast<std::int32_t>(lowFirst(bytes, 22, 4));
  const auto lines = static_cast<std::uint64_t>(std::abs(std::int64_t{height}));
  if (width > kLargestSide || lines > kLargestSide) return;
  const std::uint64_t line = (width * lowFirst(bytes, 28, 2) + 31) / 32 * 4;
  if (bytes.size() < lowFirst(bytes, 10, 4) + line * lines) refuseEarlyEnd(file, bytes.size());
}

// ---- PBM, PGM and PPM: as text (P1, P2, P3) and binary (P4, P5, P6)

// The next number of a header, with the white space and comments before it; none: there is none.
std::optional<std::uint64_t> nextNumber(std::string_view bytes, std::size_t& at) {
  const auto space = [&] {
    return at < bytes.size() && std::isspace(static_cast<unsigned char>(bytes[at])) != 0;
  };
  while (space() || (at < bytes.size() && bytes[at] == '#'))
    if (bytes[at++] == '#')
      while (at < bytes.size() && bytes[at] != '\n') ++at;
  constexpr std::size_t kMostDigits = 7;
  std::size_t digits = 0;
  std::uint64_t number = 0;
  for (; at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9'; ++at, ++digits) {
    if (digits == kMostDigits) return std::nullopt;
    number = 10 * number + static_cast<std::uint64_t>(bytes[at] - '0');
  }
  if (digits == 0) return std::nullopt;
  return number;
}

// Whether so many pixels follow in a PBM's text, where no space need be between them.
bool hasBits(std::string_view text, std::uint64_t count) {
  const auto bits = std::count_if(text.begin(), text.end(),
                                  [](char letter) { return letter == '0' || letter == '1'; });
  return static_cast<std::uint64_t>(bits) >= count;
}

bool hasNumbers(std::string_view text, std::uint64_t count) {
  std::size_t at = 0;
  while (count > 0 && nextNumber(text, at)) --count;
  return count == 0;
}

void checkNetpbm(std::string_view bytes, const std::string& file) {
  const char kind = bytes[1];
  const bool bits = kind == '1' || kind == '4', colours = kind == '3' || kind == '6';
  std::size_t at = 2;
  const auto width = nextNumber(bytes, at), height = nextNumber(bytes, at);
  const auto white = bits ? std::optional<std::uint64_t>(1) : nextNumber(bytes, at);
  const bool ends = at < bytes.size() && std::isspace(static_cast<unsigned char>(bytes[at])) != 0;
  if (!width || !height || !white || *width == 0 || *height == 0 || !(ends || at == bytes.size()))
    refuse(file, "its header does not give a width, a height and the value of white");
  const std::uint64_t in_line = *width * (colours ? 3 : 1);
  const std::string_view rest = bytes.substr(at);
  bool whole;
  if (kind == '1') {
    whole = hasBits(rest, in_line * *height);
  } else if (kind == '2' || kind == '3') {
    whole = hasNumbers(rest, in_line * *height);
  } else {
    const std::uint64_t line = bits ? (in_line + 7) / 8 : in_line * (*white > 255 ? 2 : 1);
    whole = rest.size() > line * *height;  // one byte of white space ends the header
  }
  if (!whole) refuseEarlyEnd(file, bytes.size());
}

}  // namespace

void checkImageIsWhole(const std::string& content, const std::string& file) {
  if (startsWith(content, kPng)) return checkPng(content, file);
  if (startsWith(content, kJpeg)) return checkJpeg(content, file);
  if (startsWith(content, "BM")) return checkBmp(content, file);
  if (content.size() > 1 && content[0] == 'P' && content[1] >= '1' && content[1] <= '6')
    return checkNetpbm(content, file);
}

}  // namespace grid_path_planner
