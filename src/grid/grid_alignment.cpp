#include "grid/grid_alignment.h"

#include <algorithm>
#include <cmath>

#include "grid/level_grid.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::grid {

namespace {

constexpr double kStrip = 1e-6;  // cells

}  // namespace

void checkUnrotated(const GridGeometry& geometry) {
  if (hasYaw(geometry))
    throw base::InputError("a map whose origin is turned by " +
                           base::decimalText(geometry.origin().yaw) +
                           " rad cannot be merged with others: only maps without a yaw can");
}

GridAlignment::GridAlignment(const GridGeometry& from, const GridGeometry& to)
    : scale_(from.resolution() / to.resolution()),
      column_offset_((from.origin().x - to.origin().x) / to.resolution()),
      row_offset_((from.origin().y - to.origin().y) / to.resolution()),
      width_(to.width()),
      height_(to.height()) {
  checkUnrotated(from);
  checkUnrotated(to);
  columns_ = spansOf(to.width(), -column_offset_ / scale_, 1.0 / scale_, from.width());
  rows_ = spansOf(to.height(), -row_offset_ / scale_, 1.0 / scale_, from.height());
}

GridAlignment::Span GridAlignment::spanOf(double first, double end, double offset, double scale,
                                          int most) {
  const double low = std::floor(offset + first * scale + kStrip);
  const double high = std::ceil(offset + end * scale - kStrip);
  const auto clamped = [most](double value) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  return {clamped(low), clamped(high), low >= 0.0 && high <= most};
}

std::vector<GridAlignment::Span> GridAlignment::spansOf(int count, double offset, double scale,
                                                        int most) {
  std::vector<Span> spans;
  spans.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) spans.push_back(spanOf(i, i + 1.0, offset, scale, most));
  return spans;
}

CellRect GridAlignment::touched(const CellRect& rect) const {
  const Span columns =
      spanOf(rect.column, rect.column + rect.width, column_offset_, scale_, width_);
  const Span rows = spanOf(rect.row, rect.row + rect.height, row_offset_, scale_, height_);
  if (columns.first >= columns.end || rows.first >= rows.end) return {};
  return {columns.first, rows.first, columns.end - columns.first, rows.end - rows.first};
}

}  // namespace grid_path_planner::grid
