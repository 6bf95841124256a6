#include "grid_path_planner/planners/map_sizes.h"

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "base/deflate.h"
#include "grid_path_planner/planners/rectangle_file.h"

namespace grid_path_planner::planners {

using base::deflated;
using grid::CellRect, grid::GridGeometry;

namespace {

// Of numbers 0 ... count - 1.
std::size_t bitsFor(int count) {
  std::size_t bits = 1;
  while (std::size_t{1} << bits < static_cast<std::size_t>(count)) ++bits;
  return bits;
}

std::size_t wholeBytes(std::size_t bits) {
  return (bits + 7) / 8;
}

// White where it is free.
cv::Mat imageOf(const RectangleGraph& map) {
  cv::Mat image = cv::Mat::zeros(map.geometry().height(), map.geometry().width(), CV_8UC1);
  for (const CellRect& rect : map.rectangles())
    if (!rect.empty()) image(cv::Rect(rect.column, rect.row, rect.width, rect.height)).setTo(255);
  return image;
}

std::string bitsOf(const cv::Mat& image) {
  const std::size_t row_bytes = wholeBytes(static_cast<std::size_t>(image.cols));
  std::string bits(row_bytes * static_cast<std::size_t>(image.rows), '\0');
  for (int row = 0; row < image.rows; ++row) {
    char* bytes = &bits[row_bytes * static_cast<std::size_t>(row)];
    const std::uint8_t* pixels = image.ptr<std::uint8_t>(row);
    for (int column = 0; column < image.cols; ++column)
      if (pixels[column] != 0)
        bytes[column / 8] = static_cast<char>(bytes[column / 8] | 1 << column % 8);
  }
  return bits;
}

std::size_t pngSize(const cv::Mat& image) {
  std::vector<std::uint8_t> png;
  cv::imencode(".png", image, png, {cv::IMWRITE_PNG_BILEVEL, 1, cv::IMWRITE_PNG_COMPRESSION, 9});
  return png.size();
}

}  // namespace

MapSizes mapSizes(const RectangleGraph& map) {
  const GridGeometry& geometry = map.geometry();
  MapSizes sizes;
  sizes.file = rectangleFileContent(map).size();
  sizes.entire_map = wholeBytes(geometry.size());
  // A width is written less 1, so it needs no more bits than a column.
  const std::size_t place_bits = bitsFor(geometry.width()) + bitsFor(geometry.height());
  sizes.empty_cells = wholeBytes(map.freeCells() * place_bits);
  sizes.rectangles = wholeBytes(map.count() * 2 * place_bits);
  const cv::Mat image = imageOf(map);
  sizes.png = pngSize(image);
  sizes.zlib = deflated(bitsOf(image)).size();
  return sizes;
}

}  // namespace grid_path_planner::planners
