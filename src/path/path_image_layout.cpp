#include <algorithm>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/path_image.h"

namespace grid_path_planner::path {

using base::InputError;
using grid::GridGeometry;

namespace {

constexpr int kLargestPicture = 16384;  // pixels a side
constexpr int kNarrowest = 320;         // pixels: room for the scale bar

int roundedUp(int value, int divisor) {
  return (value + divisor - 1) / divisor;
}

}  // namespace

PictureLayout::PictureLayout(const GridGeometry& geometry, const PictureOptions& options)
    : geometry_(geometry) {
  if (geometry.size() == 0) throw InputError("a map without cells cannot be drawn");
  if (options.smallest_side < 1 || options.largest_side < options.smallest_side ||
      options.largest_side > kLargestPicture)
    throw InputError("a picture's sides must be 1 <= smallest_side <= largest_side <= " +
                     std::to_string(kLargestPicture) + ", got " +
                     std::to_string(options.smallest_side) + " and " +
                     std::to_string(options.largest_side));
  const int shorter = std::min(geometry.width(), geometry.height());
  const int longer = std::max(geometry.width(), geometry.height());
  reduced_ = roundedUp(longer, options.largest_side);
  enlarged_ = std::max(
      1, std::min(roundedUp(options.smallest_side, shorter), options.largest_side / longer));
  const int map_width = roundedUp(geometry.width(), reduced_) * enlarged_;
  const int map_height = roundedUp(geometry.height(), reduced_) * enlarged_;
  const int margin = 24 + std::max(map_width, map_height) / 64;
  width_ = std::max(map_width, kNarrowest) + 2 * margin;
  height_ = map_height + 3 * margin;
  map_area_ = {(width_ - map_width) / 2, margin, map_width, map_height};
}

Eigen::Vector2d PictureLayout::pixelAt(const Eigen::Vector2d& metres) const {
  const Eigen::Vector2d cells = geometry_.gridFromWorld(metres);
  const double pixels = static_cast<double>(enlarged_) / reduced_;
  return {map_area_.column + cells.x() * pixels,
          map_area_.row + map_area_.height - cells.y() * pixels};
}

}  // namespace grid_path_planner::path
