// A grey image, and four corners in it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

namespace grid_path_planner::vision {

// Pixels, whose centres are at whole numbers: column, row.
using PixelCorners = std::array<Eigen::Vector2d, 4>;

// Pixels of one byte, row by row; not owned.
struct GreyImage {
  const std::uint8_t* pixels = nullptr;
  int width = 0;
  int height = 0;
  std::size_t row_step = 0;  // bytes

  int at(int column, int row) const { return pixels[row * row_step + column]; }
};

}  // namespace grid_path_planner::vision
