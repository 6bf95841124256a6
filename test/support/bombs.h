// Small files that ask for much, made by rule.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>

namespace grid_path_planner::test {

inline std::string repeated(const std::string& text, std::size_t times) {
  std::string all;
  all.reserve(text.size() * times);
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

inline std::string bytesOfNumber(std::uint64_t value, int count, bool high_first) {
  std::string bytes;
  for (int i = 0; i < count; ++i) {
    const int shift = 8 * (high_first ? count - 1 - i : i);
    bytes += static_cast<char>(value >> shift & 0xff);
  }
  return bytes;
}

inline std::string pngChunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto crc = ::crc32_z(0, reinterpret_cast<const Bytef*>(body.data()), body.size());
  return bytesOfNumber(data.size(), 4, true) + body + bytesOfNumber(crc, 4, true);
}

// A whole PNG of one colour, with colours and alpha where `channels` is 4, else grey.
inline std::string plainPng(int width, int height, int channels, bool interlaced = false) {
  z_stream stream{};
  ::deflateInit(&stream, Z_BEST_COMPRESSION);
  const std::string row(static_cast<std::size_t>(width) * channels + 1, '\0');
  std::string packed, buffer(1 << 16, '\0');
  for (int i = 0; i <= height; ++i) {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(row.data()));
    stream.avail_in = i < height ? static_cast<uInt>(row.size()) : 0;
    do {
      stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
      stream.avail_out = static_cast<uInt>(buffer.size());
      ::deflate(&stream, i < height ? Z_NO_FLUSH : Z_FINISH);
      packed.append(buffer, 0, buffer.size() - stream.avail_out);
    } while (stream.avail_out == 0);
  }
  ::deflateEnd(&stream);
  return "\x89PNG\r\n\x1a\n" +
         pngChunk("IHDR", bytesOfNumber(static_cast<std::uint64_t>(width), 4, true) +
                              bytesOfNumber(static_cast<std::uint64_t>(height), 4, true) + '\x08' +
                              (channels == 4 ? '\x06' : '\0') + std::string(2, '\0') +
                              (interlaced ? '\x01' : '\0')) +
         pngChunk("IDAT", packed) + pngChunk("IEND", "");
}

// A grey TIFF of one strip, packed by `compression`, whose pixels are missing.
inline std::string tiffHeader(std::uint32_t width, std::uint32_t height, std::uint32_t compression,
                              std::uint32_t rows_in_strip) {
  const std::uint32_t entries[][2] = {{256, width}, {257, height}, {258, 8}, {259, compression},
                                      {262, 1},     {273, 8},      {277, 1}, {278, rows_in_strip},
                                      {279, 8}};
  std::string directory = bytesOfNumber(std::size(entries), 2, false);
  for (const auto& [tag, value] : entries)
    directory += bytesOfNumber(tag, 2, false) + bytesOfNumber(4, 2, false) +
                 bytesOfNumber(1, 4, false) + bytesOfNumber(value, 4, false);
  return std::string("II*\0", 4) + bytesOfNumber(16, 4, false) + std::string(8, '\0') + directory +
         std::string(4, '\0');
}

// An 8-bit BMP whose run-length coded pixels are a few bytes.
inline std::string packedBmp(std::uint32_t width, std::uint32_t height) {
  const std::string pixels("\x00\x01", 2);
  const std::size_t offset = 14 + 40 + 4 * 256;
  return "BM" + bytesOfNumber(offset + pixels.size(), 4, false) + std::string(4, '\0') +
         bytesOfNumber(offset, 4, false) + bytesOfNumber(40, 4, false) +
         bytesOfNumber(width, 4, false) + bytesOfNumber(height, 4, false) +
         bytesOfNumber(1, 2, false) + bytesOfNumber(8, 2, false) + bytesOfNumber(1, 4, false) +
         bytesOfNumber(pixels.size(), 4, false) + std::string(16, '\0') +
         std::string(4 * 256, '\0') + pixels;
}

}  // namespace grid_path_planner::test
