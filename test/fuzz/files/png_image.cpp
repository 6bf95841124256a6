// Of a PNG with a wrong checksum nothing is read but that, so the checksums are put right.
#include <boost/crc.hpp>

#include "fuzz/files/fuzz_images.h"
#include "fuzz/fuzz_target.h"
#include "grid/formats/image_formats.h"

namespace grid_path_planner::fuzz {
namespace {

constexpr std::size_t kSignature = 8, kNumber = 4, kKind = 4;  // bytes

std::vector<std::string> seedsOfPng() {
  return {encodedPicture(".png", 1), encodedPicture(".png", 3), encodedPicture(".png", 4)};
}

std::uint32_t numberAt(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < kNumber; ++i)
    number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

// A PNG is a signature and chunks of length, kind, data and checksum of kind and data.
std::string withRightChecksums(std::string png) {
  std::size_t at = kSignature;
  while (at + 2 * kNumber + kKind <= png.size()) {
    const std::size_t length = numberAt(png, at);
    const std::size_t end = at + kNumber + kKind + length;
    if (end + kNumber > png.size()) break;
    boost::crc_32_type sum;
    sum.process_bytes(png.data() + at + kNumber, kKind + length);
    for (std::size_t i = 0; i < kNumber; ++i)
      png[end + i] = static_cast<char>(sum.checksum() >> (24 - 8 * i) & 0xff);
    at = end + kNumber;
  }
  return png;
}

FUZZ_TARGET(png_image, seedsOfPng) {
  LimitsOfPicture picture;
  mayRefuse([&] { grid::decodePng(withRightChecksums(input), "fuzz.png", picture.limits()); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
