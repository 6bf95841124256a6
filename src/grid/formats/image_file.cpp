#include "grid/formats/image_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <vector>

#include "grid/formats/image_formats.h"
#include "grid/formats/map_warning.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

using base::decimalText, base::dropByteOrderMark, base::extensionOf, base::InputError,
    base::PartState, base::partState, base::readWholeFile, base::writeFileAtomically;

namespace {

constexpr int kAlphaChannel = 3;

constexpr std::size_t kMostPixels = std::size_t{1} << 30;

bool startsWith(const std::string& content, std::string_view start) {
  return content.compare(0, start.size(), start) == 0;
}

bool isPnm(const std::string& content) {
  return content.size() > 1 && content[0] == 'P' && content[1] >= '1' && content[1] <= '6';
}

bool isTiff(const std::string& content) {
  using namespace std::literals;
  return startsWith(content, "II*\0"sv) || startsWith(content, "MM\0*"sv);
}

cv::Mat decode(const std::string& content, const std::string& file, const ImageLimits& limits) {
  if (startsWith(content, "\x89PNG\r\n\x1a\n")) return decodePng(content, file, limits);
  if (startsWith(content, "\xff\xd8\xff")) return decodeJpeg(content, file, limits);
  if (startsWith(content, "BM")) return decodeBmp(content, file, limits);
  if (isPnm(content)) return decodePnm(content, file, limits);
  if (isTiff(content)) return decodeTiff(content, file, limits);
  throw InputError(file, "is not an image that can be read: no PNG, JPEG, BMP, PNM or TIFF");
}

cv::Mat readPixels(const std::string& file, const ImageLimits& limits,
                   const MapFileOptions& options) {
  std::string content = readWholeFile(file, kLargestMapFile, limits.limits);
  if (partState(file, content) == PartState::CHANGED)
    warnAbout(file, "was changed since it was written with its map", options);
  dropByteOrderMark(content);
  return decode(content, file, limits);
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
    if (range <= 0.0) return 1;
    return static_cast<std::int8_t>(1 + 98 * ((occupied - rule_.free_thresh) / range));
  }

  PixelRule rule_;
  std::vector<std::int8_t> opaque_;
  std::vector<std::int8_t> transparent_;
};

int sumOf(const std::uint8_t* pixel, int averaged) {
  int sum = 0;
  for (int channel = 0; channel < averaged; ++channel) sum += pixel[channel];
  return sum;
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

// The pixels nearest the middles of cells.
class Sampling {
 public:
  // `columns`: of cells; 0: a cell a pixel.
  Sampling(const cv::Mat& image, int columns)
      : image_(image),
        offsets_(static_cast<std::size_t>(columns > 0 ? columns : image.cols)),
        rows_(std::max(
            1, static_cast<int>(std::lround(double(image.rows) * this->columns() / image.cols)))) {
    for (int column = 0; column < this->columns(); ++column)
      offsets_[static_cast<std::size_t>(column)] =
          std::ptrdiff_t{nearest(column, this->columns(), image.cols)} * image.channels();
  }

  int columns() const { return static_cast<int>(offsets_.size()); }
  int rows() const { return rows_; }
  // Row 0 is the image's last.
  const std::uint8_t* line(int row) const {
    return image_.ptr<std::uint8_t>(nearest(rows_ - 1 - row, rows_, image_.rows));
  }
  // From the line's begin to the pixel.
  std::ptrdiff_t offset(int column) const { return offsets_[static_cast<std::size_t>(column)]; }

 private:
  static int nearest(int cell, int cells, int pixels) {
    return static_cast<int>((2 * std::int64_t{cell} + 1) * pixels / (2 * std::int64_t{cells}));
  }

  const cv::Mat& image_;
  std::vector<std::ptrdiff_t> offsets_;
  int rows_;
};

struct GreyImage {
  cv::Mat pixels;
  int averaged;  // channels of a pixel that make its grey
  bool has_alpha;
};

GreyImage readGrey(const std::string& file, MapMode mode, double resolution, const Origin& origin,
                   MapFileOptions& options) {
  const auto checkSize = [&](int width, int height) {
    if (mapGeometry(file, width, height, resolution, origin, options).size() > kMostPixels)
      throw InputError(file, "is an image of " + std::to_string(width) + "x" +
                                 std::to_string(height) + " pixels, more than 2^30");
  };
  GreyImage image{readPixels(file, {checkSize, options.limits}, options), 0, false};
  const int channels = image.pixels.channels();
  image.has_alpha = channels > kAlphaChannel;
  image.averaged = image.has_alpha && mode != MapMode::TRINARY ? kAlphaChannel : channels;
  warnAboutColour(file, channels, image.averaged, options);
  return image;
}

// 0 or 100 for each cell, by the threshold between the greys of all cells.
OccupancyGrid byOtsu(const GreyImage& image, const Sampling& sampling,
                     const GridGeometry& geometry) {
  cv::Mat grey(sampling.rows(), sampling.columns(), CV_8UC1);
  for (int row = 0; row < sampling.rows(); ++row)
    for (int column = 0; column < sampling.columns(); ++column) {
      const int sum = sumOf(sampling.line(row) + sampling.offset(column), image.averaged);
      grey.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(sum / image.averaged);
    }
  cv::threshold(grey, grey, 0.0, 100.0, cv::THRESH_BINARY_INV | cv::THRESH_OTSU);
  OccupancyGrid map(geometry);
  for (int row = 0; row < map.height(); ++row)
    std::copy_n(grey.ptr<std::int8_t>(row), map.width(), map.row(row));
  return map;
}

// Of a picture with several greys between the thresholds, and no class on one side of these. A single grey is unknown, as
// map_server writes it.
void warnAboutThresholds(const std::string& file, const OccupancyGrid& map,
                         const std::vector<bool>& sums, const PixelTable& table,
                         const PixelRule& rule, const MapFileOptions& options) {
  std::size_t greys = 0;
  for (std::size_t sum = 0; sum < sums.size(); ++sum)
    greys += sums[sum] && table(static_cast<int>(sum), false) < 0 ? 1 : 0;
  const auto has = [&](std::int8_t value) {
    return std::find(map.values().begin(), map.values().end(), value) != map.values().end();
  };
  if (rule.mode != MapMode::TRINARY || greys < 2 || (has(0) && has(100))) return;
  const char* const none = has(100) ? "free" : has(0) ? "occupied" : "free or occupied";
  warnAbout(file,
            std::string("no pixel is ") + none + " by free_thresh " +
                decimalText(rule.free_thresh) + " and occupied_thresh " +
                decimalText(rule.occupied_thresh) + ": its greys count as unknown",
            options);
}

OccupancyGrid byRule(const GreyImage& image, const std::string& file, const Sampling& sampling,
                     const PixelRule& rule, const GridGeometry& geometry,
                     const MapFileOptions& options) {
  OccupancyGrid map(geometry);
  const PixelTable table(rule, image.averaged);
  std::vector<bool> sums(static_cast<std::size_t>(255 * image.averaged) + 1);
  for (int row = 0; row < map.height(); ++row) {
    const std::uint8_t* line = sampling.line(row);
    std::int8_t* values = map.row(row);
    for (int column = 0; column < map.width(); ++column) {
      const std::uint8_t* pixel = line + sampling.offset(column);
      const int sum = sumOf(pixel, image.averaged);
      sums[static_cast<std::size_t>(sum)] = true;
      values[column] = table(sum, image.has_alpha && pixel[kAlphaChannel] == 0);
    }
  }
  warnAboutThresholds(file, map, sums, table, rule, options);
  return map;
}

}  // namespace

OccupancyGrid readImageFile(const std::string& file, const PixelRule& rule, double resolution,
                            const Origin& origin, MapFileOptions& options) {
  const GreyImage image = readGrey(file, rule.mode, resolution, origin, options);
  const Sampling sampling(image.pixels, 0);
  const GridGeometry geometry =
      mapGeometry(file, sampling.columns(), sampling.rows(), resolution, origin, options);
  options.limits.take(file, geometry.size());
  options.limits.goOn(file);
  return byRule(image, file, sampling, rule, geometry, options);
}

OccupancyGrid readPlainImage(const std::string& file, MapFileOptions& options) {
  if (options.images_need_resolution && !options.resolution)
    throw InputError(file,
                     "is an image without a YAML, and nothing says how wide a pixel is: "
                     "give it in metres, as in --resolution 0.05");
  if (options.warn_of_cells_of_images && options.warn && !options.resolution)
    options.warn(
        file +
        ": is an image without a YAML, so each pixel is taken for a cell of 1 m: a YAML of "
        "map_server's form says how wide it is (image: NAME, resolution: 0.05, origin: [0, 0, 0])");
  const PlainImageOptions& wanted = options.plain_image;
  const GreyImage image = readGrey(file, MapMode::TRINARY, 1.0, {}, options);
  if (wanted.columns > image.pixels.cols)
    throw InputError(file, "has " + std::to_string(image.pixels.cols) +
                               " columns of pixels, fewer than the " +
                               std::to_string(wanted.columns) + " asked for");
  const Sampling sampling(image.pixels, wanted.columns);
  const GridGeometry geometry =
      mapGeometry(file, sampling.columns(), sampling.rows(), 1.0, {}, options);
  options.limits.take(file, (wanted.otsu ? 2 : 1) * geometry.size());
  options.limits.goOn(file);
  return wanted.otsu ? byOtsu(image, sampling, geometry)
                     : byRule(image, file, sampling, {}, geometry, options);
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

}  // namespace grid_path_planner::grid
