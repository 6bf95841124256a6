#include "grid/polygon_cover.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::grid {

namespace {

using Eigen::Vector2d;

constexpr double kStrip = 1e-9;  // cells

// What the edges do in one row.
struct EdgesOfRow {
  std::vector<RowSpan> spans;     // that they touch
  std::vector<double> crossings;  // columns where they cross the line through the centres
};

int clamped(double value, int least, int most) {
  return static_cast<int>(std::clamp(value, static_cast<double>(least), static_cast<double>(most)));
}

// The columns of `within` whose interiors meet what lies between `low` and `high`.
RowSpan columnsBetween(double low, double high, int row, const CellRect& within) {
  const int end = within.column + within.width;
  return {row, clamped(std::floor(low + kStrip), within.column, end),
          clamped(std::ceil(high - kStrip), within.column, end)};
}

void addEdge(const Vector2d& a, const Vector2d& b, const CellRect& within,
             std::vector<EdgesOfRow>& rows) {
  const Vector2d& low = a.y() <= b.y() ? a : b;
  const Vector2d& high = a.y() <= b.y() ? b : a;
  const int end_row = within.row + within.height;
  const int first = clamped(std::floor(low.y() + kStrip), within.row, end_row);
  const int end = clamped(std::ceil(high.y() - kStrip), within.row, end_row);
  const auto columnAt = [&](double y) {
    const double height = high.y() - low.y();
    const double share = height > 0.0 ? std::clamp((y - low.y()) / height, 0.0, 1.0) : 0.0;
    return low.x() + share * (high.x() - low.x());
  };
  for (int row = first; row < end; ++row) {
    EdgesOfRow& edges = rows[static_cast<std::size_t>(row - within.row)];
    const bool level = high.y() - low.y() <= kStrip;
    const double from = level ? low.x() : columnAt(row);
    const double to = level ? high.x() : columnAt(row + 1.0);
    edges.spans.push_back(columnsBetween(std::min(from, to), std::max(from, to), row, within));
    const double centre = row + 0.5;
    if ((low.y() > centre) != (high.y() > centre)) edges.crossings.push_back(columnAt(centre));
  }
}

// Cells that no edge meets are inside or outside as a whole: their centres tell.
void addInside(EdgesOfRow& edges, int row, const CellRect& within) {
  std::sort(edges.crossings.begin(), edges.crossings.end());
  const int end = within.column + within.width;
  for (std::size_t i = 0; i + 1 < edges.crossings.size(); i += 2)
    edges.spans.push_back(
        {row, clamped(std::ceil(edges.crossings[i] - 0.5), within.column, end),
         clamped(std::floor(edges.crossings[i + 1] - 0.5) + 1.0, within.column, end)});
}

void join(std::vector<RowSpan>& spans, std::vector<RowSpan>& joined) {
  std::sort(spans.begin(), spans.end(),
            [](const RowSpan& a, const RowSpan& b) { return a.first < b.first; });
  const std::size_t before = joined.size();
  for (const RowSpan& span : spans) {
    if (span.first >= span.end) continue;
    if (joined.size() > before && span.first <= joined.back().end)
      joined.back().end = std::max(joined.back().end, span.end);
    else
      joined.push_back(span);
  }
}

}  // namespace

std::vector<RowSpan> touchedCells(const std::vector<Vector2d>& corners, const CellRect& within) {
  if (within.empty()) return {};
  std::vector<EdgesOfRow> rows(static_cast<std::size_t>(within.height));
  for (std::size_t i = 0, before = corners.size() - 1; i < corners.size(); before = i++)
    addEdge(corners[before], corners[i], within, rows);
  std::vector<RowSpan> spans;
  for (int row = 0; row < within.height; ++row) {
    EdgesOfRow& edges = rows[static_cast<std::size_t>(row)];
    addInside(edges, within.row + row, within);
    join(edges.spans, spans);
  }
  return spans;
}

}  // namespace grid_path_planner::grid
