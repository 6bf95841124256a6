#include "grid_path_planner/grid/image_file.h"

#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <sstream>
#include <vector>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/grid/map_format.h"
#include "image_check.h"

namespace grid_path_planner {
namespace {

constexpr int kAlphaChannel = 3;

// The value that stands for white by the header of a binary PGM or PPM. OpenCV spreads the values
// of a text PGM to the full range, as map_server's SDL does for both, but not those of a binary
// one.
std::optional<int> whiteOf(const std::string& content) {
  if (content.compare(0, 2, "P5") != 0 && content.compare(0, 2, "P6") != 0) return std::nullopt;
  std::istringstream header(content.substr(2, 4096));
  int numbers[3] = {};  // width, height, white
  for (int& number : numbers) {
    while ((header >> std::ws).peek() == '#')
      header.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    header >> number;
  }
  if (!header || numbers[2] <= 0) return std::nullopt;
  return numbers[2];
}

cv::Mat decode(const std::string& file) {
  const std::string content = readWholeFile(file, kLargestMapFile);
  checkImageIsWhole(content, file);
  cv::Mat image;
  try {
    const cv::Mat bytes(1, static_cast<int>(content.size()), CV_8UC1,
                        const_cast<char*>(content.data()));
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw InputError(file, "is not an image that can be read: " + error.err);
  }
  if (image.empty()) throw InputError(file, "is not an image that can be read");
  if (image.depth() != CV_8U && image.depth() != CV_16U)
    throw InputError(file, "must be an image of 8 or 16 bits a channel");
  const int white = whiteOf(content).value_or(image.depth() == CV_8U ? 255 : 65535);
  if (white != 255) image.convertTo(image, CV_8U, 255.0 / white);
  return image;
}

// What a pixel means, by the sum of its channels.
class PixelTable {
 public:
  PixelTable(const PixelRule& rule, int channels) : rule_(rule), opaque_(255 * channels + 1) {
    for (std::size_t sum = 0; sum < opaque_.size(); ++sum)
      opaque_[sum] = occupancyOf(static_cast<double>(sum) / channels, false);
    transparent_ = opaque_;
    for (std::size_t sum = 0; sum < transparent_.size(); ++sum)
      transparent_[sum] = occupancyOf(static_cast<double>(sum) / channels, true);
  }

  std::int8_t operator()(int sum, bool transparent) const {
    return transparent ? transparent_[sum] : opaque_[sum];
  }

 private:
  std::int8_t occupancyOf(double average, bool transparent) const {
    const double value = rule_.negate ? 255 - average : average;
    if (rule_.mode == MapMode::RAW)
      return static_cast<int>(value) <= 100 ? static_cast<std::int8_t>(value) : -1;
    const double occupied = (255 - value) / 255.0;
    if (occupied > rule_.occupied_thresh) return 100;
    if (occupied < rule_.free_thresh) return 0;
    if (rule_.mode == MapMode::TRINARY || transparent) return -1;
    const double range = rule_.occupied_thresh - rule_.free_thresh;
    return range > 0.0 ? static_cast<std::int8_t>(99 * (occupied - rule_.free_thresh) / range) : 0;
  }

  PixelRule rule_;
  std::vector<std::int8_t> opaque_;
  std::vector<std::int8_t> transparent_;
};

std::int8_t occupancyOfPixel(const std::uint8_t* pixel, int averaged, bool has_alpha,
                             const PixelTable& table) {
  int sum = 0;
  for (int channel = 0; channel < averaged; ++channel) sum += pixel[channel];
  return table(sum, has_alpha && pixel[kAlphaChannel] == 0);
}

void warnAboutColour(const std::string& file, int channels, int averaged,
                     const MapFileOptions& options) {
  if (channels == 1) return;
  const std::string with = averaged > kAlphaChannel ? ", the alpha channel among them" : "";
  warnAbout(file,
            "is a colour image: the mean of its " + std::to_string(averaged) + " channels" + with +
                ", is taken for grey",
            options);
}

std::uint8_t greyOf(std::int8_t value, MapMode mode, const OccupancyThresholds& thresholds) {
  if (mode == MapMode::RAW) return value < 0 ? 255 : static_cast<std::uint8_t>(value);
  switch (thresholds.classify(value)) {
    case Occupancy::FREE:
      return 254;
    case Occupancy::OCCUPIED:
      return 0;
    case Occupancy::UNKNOWN:
      break;
  }
  return 205;
}

// One byte a cell, the image's first line first.
std::string greyRows(const OccupancyGrid& map, MapMode mode,
                     const OccupancyThresholds& thresholds) {
  if (mode == MapMode::SCALE)
    throw InputError("a map is written in trinary or raw mode, not in scale");
  std::string grey;
  grey.reserve(map.values().size());
  for (int row = map.height() - 1; row >= 0; --row)
    for (int column = 0; column < map.width(); ++column)
      grey += static_cast<char>(greyOf(map.row(row)[column], mode, thresholds));
  return grey;
}

}  // namespace

OccupancyGrid readImageFile(const std::string& file, const PixelRule& rule, double resolution,
                            const Origin& origin, const MapFileOptions& options) {
  const cv::Mat image = decode(file);
  const int channels = image.channels();
  const bool has_alpha = channels > kAlphaChannel;
  const int averaged = has_alpha && rule.mode != MapMode::TRINARY ? kAlphaChannel : channels;
  warnAboutColour(file, channels, averaged, options);
  OccupancyGrid map(mapGeometry(file, image.cols, image.rows, resolution, origin, options));
  const PixelTable table(rule, averaged);
  for (int row = 0; row < map.height(); ++row) {
    const std::uint8_t* pixel = image.ptr<std::uint8_t>(map.height() - 1 - row);
    std::int8_t* values = map.row(row);
    for (int column = 0; column < map.width(); ++column, pixel += channels)
      values[column] = occupancyOfPixel(pixel, averaged, has_alpha, table);
  }
  return map;
}

std::string pgmOfMap(const OccupancyGrid& map, MapMode mode,
                     const OccupancyThresholds& thresholds) {
  return "P5\n# grid_path_planner " + decimalText(map.geometry().resolution()) + " m/cell\n" +
         std::to_string(map.width()) + " " + std::to_string(map.height()) + "\n255\n" +
         greyRows(map, mode, thresholds);
}

void writeImageFile(const std::string& file, const OccupancyGrid& map, MapMode mode,
                    const OccupancyThresholds& thresholds) {
  const std::string extension = extensionOf(file);
  if (extension == "pgm") return writeFileAtomically(file, pgmOfMap(map, mode, thresholds));
  if (extension != "png")
    throw InputError(file, "must end in .pgm or .png to be written as an image");
  std::string grey = greyRows(map, mode, thresholds);
  std::vector<std::uint8_t> png;
  cv::imencode(".png", cv::Mat(map.height(), map.width(), CV_8UC1, grey.data()), png);
  writeFileAtomically(file, std::string(png.begin(), png.end()));
}

}  // namespace grid_path_planner
