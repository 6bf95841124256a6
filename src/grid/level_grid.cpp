#include "grid/level_grid.h"

#include <Eigen/Geometry>
#include <string>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::grid {

namespace {

constexpr double kLevel = 1e-9;       // rad
constexpr double kStrip = 1e-6;       // cells
constexpr double kMostGrowth = 10.0;  // of the number of cells
constexpr double kFewCells = 1e6;     // that may be exceeded all the same

// As small as holds the map: its corner of least x and y is a corner of the grid.
GridGeometry levelled(const GridGeometry& from) {
  Eigen::AlignedBox2d box;
  for (const int column : {0, from.width()})
    for (const int row : {0, from.height()})
      box.extend(from.worldFromGrid(Eigen::Vector2d(column, row)));
  const Eigen::Vector2d cells = box.sizes() / from.resolution();
  const double width = std::ceil(cells.x() - kStrip);
  const double height = std::ceil(cells.y() - kStrip);
  if (width * height > kMostGrowth * static_cast<double>(from.size()) + kFewCells)
    throw base::InputError(
        "a map of " + std::to_string(from.width()) + "x" + std::to_string(from.height()) +
        " cells turned by " + base::decimalText(from.origin().yaw) +
        " rad has too many cells on a grid without a yaw: " + base::decimalText(width) + "x" +
        base::decimalText(height));
  return GridGeometry(static_cast<int>(width), static_cast<int>(height), from.resolution(),
                      {box.min().x(), box.min().y(), 0.0});
}

}  // namespace

bool hasYaw(const GridGeometry& geometry) {
  return std::abs(geometry.origin().yaw) > kLevel;
}

LevelGrid::LevelGrid(const GridGeometry& from)
    : from_(from),
      level_(levelled(from)),
      cos_(std::cos(from.origin().yaw)),
      sin_(std::sin(from.origin().yaw)),
      reach_(0.5 * (1.0 + std::abs(cos_) + std::abs(sin_)) - kStrip) {}

}  // namespace grid_path_planner::grid
