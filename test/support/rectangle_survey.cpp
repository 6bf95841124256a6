#include "support/rectangle_survey.h"

#include <tuple>

namespace grid_path_planner::test {

using grid::Cell;
using grid::CellRect;

namespace {

// Whether `a` is taken before `b`.
bool before(const CellRect& a, const CellRect& b) {
  const auto key = [](const CellRect& rect) {
    return std::make_tuple(-std::int64_t{rect.width} * rect.height, rect.column,
                           rect.row + rect.height - 1, -rect.width);
  };
  return key(a) < key(b);
}

void keepBetter(std::optional<CellRect>& best, const CellRect& rect) {
  if (rect.empty()) return;
  if (!best || before(rect, *best)) best = rect;
}

}  // namespace

std::optional<CellRect> largestRectangle(const FreeCells& free) {
  struct Bar {
    int column;
    int height;
  };
  std::optional<CellRect> best;
  int best_area = 1;
  const int width = free.width();
  std::vector<int> heights(static_cast<std::size_t>(width) + 1, 0);
  std::vector<Bar> bars(heights.size() + 1);
  for (int row = 0; row < free.height(); ++row) {
    const std::uint8_t* cells = free.row(row);
    for (int column = 0; column < width; ++column)
      heights[std::size_t(column)] = cells[column] != 0 ? heights[std::size_t(column)] + 1 : 0;
    Bar* top = bars.data();
    *top = {0, -1};
    for (int column = 0; column <= width; ++column) {
      const int height = heights[std::size_t(column)];
      int start = column;
      for (; top->height >= height; --top) {
        start = top->column;
        const int area = (column - start) * top->height;
        if (area < best_area) continue;
        best_area = area;
        keepBetter(best, {start, row - top->height + 1, column - start, top->height});
      }
      *++top = {start, height};
    }
  }
  return best;
}

std::optional<CellRect> largestRectangleByTrying(const FreeCells& free) {
  std::optional<CellRect> best;
  const auto isFree = [&free](const CellRect& rect) {
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      for (int column = rect.column; column < rect.column + rect.width; ++column)
        if (free[Cell{column, row}] == 0) return false;
    return true;
  };
  CellRect rect;
  for (rect.row = 0; rect.row < free.height(); ++rect.row)
    for (rect.column = 0; rect.column < free.width(); ++rect.column)
      for (rect.height = 1; rect.row + rect.height <= free.height(); ++rect.height)
        for (rect.width = 1; rect.column + rect.width <= free.width(); ++rect.width)
          if (isFree(rect)) keepBetter(best, rect);
  return best;
}

std::vector<CellRect> surveyRectangles(FreeCells free, std::size_t count) {
  std::vector<CellRect> rectangles;
  while (rectangles.size() < count) {
    const std::optional<CellRect> rect = largestRectangle(free);
    if (!rect) break;
    rectangles.push_back(*rect);
    for (int row = rect->row; row < rect->row + rect->height; ++row)
      for (int column = rect->column; column < rect->column + rect->width; ++column)
        free[Cell{column, row}] = 0;
  }
  return rectangles;
}

}  // namespace grid_path_planner::test
