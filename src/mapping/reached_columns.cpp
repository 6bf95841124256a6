#include "mapping/reached_columns.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::mapping {

using grid::CellRect;

namespace {

constexpr int kColumnsOfASide = 65536 / 8;

bool rowByRow(BrickColumn a, BrickColumn b) {
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}

std::vector<BrickColumn> squaresAround(const std::vector<BrickColumn>& places, int reach) {
  std::vector<BrickColumn> columns;
  for (const BrickColumn place : places) {
    const CellRect around = CellRect{place.x, place.y, 1, 1}.grown(reach).intersection(
        {0, 0, kColumnsOfASide, kColumnsOfASide});
    for (int y = around.row; y < around.row + around.height; ++y)
      for (int x = around.column; x < around.column + around.width; ++x)
        columns.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
  }
  return columns;
}

// Goes up row by row with the squares around places that are in order. Of each x it keeps the topmost place whose
// square begins in that row or below and holds the x.
class RowSweep {
 public:
  RowSweep(const std::vector<BrickColumn>& places, int reach) : places_(places), reach_(reach) {}

  // Rows are asked for from the lowest up.
  bool reaches(BrickColumn column) {
    for (; next_ < places_.size() && places_[next_].y <= column.y + reach_; ++next_)
      mark(places_[next_]);
    return topmost_[column.x] >= column.y - reach_;
  }

 private:
  // Each x once a row.
  void mark(BrickColumn place) {
    if (place.y != marked_row_) marked_end_ = 0;
    marked_row_ = place.y;
    const int begin = std::max(place.x - reach_, marked_end_);
    marked_end_ = std::min(place.x + reach_ + 1, kColumnsOfASide);
    std::fill(topmost_.begin() + begin, topmost_.begin() + marked_end_, place.y);
  }

  const std::vector<BrickColumn>& places_;
  const int reach_;
  std::size_t next_ = 0;
  int marked_row_ = -1;
  int marked_end_ = 0;
  std::vector<int> topmost_ =
      std::vector<int>(kColumnsOfASide, std::numeric_limits<int>::min());  // rows
};

}  // namespace

// Few squares are cheaper than a walk through all columns.
std::vector<BrickColumn> reachedColumns(const OccupancyBricks& bricks,
                                        std::vector<BrickColumn> places, int reach) {
  const std::int64_t side = 2 * std::int64_t{std::min(reach, kColumnsOfASide)} + 1;
  if (static_cast<std::int64_t>(places.size()) * side * side <=
      static_cast<std::int64_t>(bricks.mostColumns()))
    return squaresAround(places, reach);
  std::sort(places.begin(), places.end(), rowByRow);
  std::vector<BrickColumn> columns = bricks.columns();
  std::sort(columns.begin(), columns.end(), rowByRow);
  RowSweep sweep(places, std::min(reach, kColumnsOfASide));
  std::vector<BrickColumn> reached;
  for (const BrickColumn column : columns)
    if (sweep.reaches(column)) reached.push_back(column);
  return reached;
}

}  // namespace grid_path_planner::mapping
