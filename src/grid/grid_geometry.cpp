#include "grid_path_planner/grid/grid_geometry.h"

#include <cmath>
#include <limits>
#include <string>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::grid {

using base::decimalText, base::InputError;

namespace {

constexpr int kMaxSide = 1 << 19;

// Within them a double holds every point of a map to a fraction of its cells.
constexpr double kLeastResolution = 1e-6;   // m
constexpr double kLargestResolution = 1e6;  // m
constexpr double kFarthestOrigin = 1e8;     // m

// Rounding in world -> grid is far below this many cells; a point that close to a cell border
// counts as on it, so that borders given in metres (0.15 at 0.05 m) fall where they are meant.
constexpr double kBorderSlack = 1e-9;

double floorWithSlack(double value) {
  return std::floor(value + kBorderSlack);
}

}  // namespace

GridGeometry::GridGeometry(int width, int height, double resolution, const Origin& origin)
    : width_(width), height_(height), resolution_(resolution), origin_(origin) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  if (width < 1 || height < 1) throw InputError("a map needs at least one cell, got " + size);
  if (width > kMaxSide || height > kMaxSide ||
      size_t(width) * size_t(height) > size_t(std::numeric_limits<std::int32_t>::max()))
    throw InputError("a map of " + size + " cells is larger than 2^31 - 1 cells or 2^19 a side");
  if (!std::isfinite(resolution) || resolution <= 0.0)
    throw InputError("resolution must be a positive, finite number of metres, got " +
                     decimalText(resolution));
  if (resolution < kLeastResolution || resolution > kLargestResolution)
    throw InputError("resolution must be from 1e-6 to 1e6 m, got " + decimalText(resolution));
  if (!(std::abs(origin.x) <= kFarthestOrigin && std::abs(origin.y) <= kFarthestOrigin &&
        std::isfinite(origin.yaw)))
    throw InputError("a map's origin must be finite and within 1e8 m, got " +
                     decimalText(origin.x) + " " + decimalText(origin.y) + " " +
                     decimalText(origin.yaw));
  cos_yaw_ = std::cos(origin.yaw);
  sin_yaw_ = std::sin(origin.yaw);
}

Eigen::Vector2d GridGeometry::worldFromGrid(const Eigen::Vector2d& cells) const {
  const double x = cells.x() * resolution_;
  const double y = cells.y() * resolution_;
  return {origin_.x + cos_yaw_ * x - sin_yaw_ * y, origin_.y + sin_yaw_ * x + cos_yaw_ * y};
}

Eigen::Vector2d GridGeometry::gridFromWorld(const Eigen::Vector2d& metres) const {
  const double x = metres.x() - origin_.x;
  const double y = metres.y() - origin_.y;
  return {(cos_yaw_ * x + sin_yaw_ * y) / resolution_, (cos_yaw_ * y - sin_yaw_ * x) / resolution_};
}

std::optional<Cell> GridGeometry::cellAt(const Eigen::Vector2d& metres) const {
  const Eigen::Vector2d point = gridFromWorld(metres);
  const double column = floorWithSlack(point.x());
  const double row = floorWithSlack(point.y());
  const bool inside = column >= 0.0 && column < width_ && row >= 0.0 && row < height_;
  if (!inside) return std::nullopt;  // NaN fails the comparisons
  return Cell{static_cast<int>(column), static_cast<int>(row)};
}

bool operator==(const GridGeometry& a, const GridGeometry& b) {
  return a.width_ == b.width_ && a.height_ == b.height_ && a.resolution_ == b.resolution_ &&
         a.origin_.x == b.origin_.x && a.origin_.y == b.origin_.y && a.origin_.yaw == b.origin_.yaw;
}

}  // namespace grid_path_planner::grid
