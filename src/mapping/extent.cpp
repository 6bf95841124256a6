#include "mapping/extent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "mapping/column_values.h"

namespace grid_path_planner::mapping {

using grid::CellRect;

namespace {

constexpr int kBricks = 65536 / 8;  // along a side
constexpr int kBrickCells = 64;

std::int64_t areaOf(const CellRect& rect) {
  return std::int64_t{rect.width} * rect.height;
}

bool contains(const CellRect& outer, const CellRect& inner) {
  return inner.empty() || outer.hull(inner) == outer;
}

CellRect brickOf(BrickColumn column) {
  return {column.x, column.y, 1, 1};
}

CellRect cellsOfBricks(const CellRect& bricks) {
  return {8 * bricks.column - kKeyOfZero, 8 * bricks.row - kKeyOfZero, 8 * bricks.width,
          8 * bricks.height};
}

CellRect cellsOf(const std::vector<BrickColumn>& columns) {
  CellRect bricks;
  for (const BrickColumn column : columns) bricks = bricks.hull(brickOf(column));
  return bricks.empty() ? CellRect{} : cellsOfBricks(bricks);
}

// By how many cells one side grows that lacks `wanted` cells: with spare ones, at most `room`.
int growthOf(int wanted, int length, int room) {
  if (wanted <= 0) return 0;
  const int spare = std::max(length / 64 * 8, 32);
  return std::min(wanted + spare, room);
}

// `present` grown so that it holds `wanted`, with spare cells on the sides that grow.
CellRect grown(const CellRect& present, const CellRect& wanted) {
  const int left =
      growthOf(present.column - wanted.column, present.width, present.column + kKeyOfZero);
  const int below = growthOf(present.row - wanted.row, present.height, present.row + kKeyOfZero);
  const int right = growthOf(wanted.column + wanted.width - present.column - present.width,
                             present.width, kKeyOfZero - present.column - present.width);
  const int above = growthOf(wanted.row + wanted.height - present.row - present.height,
                             present.height, kKeyOfZero - present.row - present.height);
  return {present.column - left, present.row - below, present.width + left + right,
          present.height + below + above};
}

// The first of no more than `most` cells, else the last.
CellRect firstWithin(int most, const std::array<CellRect, 3>& rects) {
  return *std::find_if(rects.begin(), rects.end() - 1,
                       [most](const CellRect& rect) { return areaOf(rect) <= most; });
}

// Of the densest part, which leaves room to grow.
std::int64_t wantedBricks(const ProjectionOptions& options) {
  const std::int64_t most = options.max_cells / kBrickCells;
  return most - most / 4;
}

// The brick columns inside a rectangle of bricks that loses strips at its sides.
class Strips {
 public:
  explicit Strips(const std::vector<BrickColumn>& columns)
      : rows_(kBricks), columns_(kBricks), in_column_(kBricks), in_row_(kBricks) {
    for (const BrickColumn column : columns) {
      rect_ = rect_.hull(brickOf(column));
      rows_[column.x].push_back(column.y);
      columns_[column.y].push_back(column.x);
      ++in_column_[column.x];
      ++in_row_[column.y];
    }
  }

  const CellRect& rect() const { return rect_; }

  // Leaves out the sparsest strip that `kept` does not touch. Returns whether there was one.
  bool leaveOneOut(const CellRect& kept) {
    const Strip* sparsest = nullptr;
    const std::array<Strip, 4> sides = {
        columnStrip(rect_.column), columnStrip(rect_.column + rect_.width - 1), rowStrip(rect_.row),
        rowStrip(rect_.row + rect_.height - 1)};
    for (const Strip& side : sides) {
      if (side.place == rect_ || !side.place.intersection(kept).empty()) continue;
      if (!sparsest || side.sparserThan(*sparsest)) sparsest = &side;
    }
    if (sparsest) leaveOut(*sparsest);
    return sparsest != nullptr;
  }

 private:
  struct Strip {
    CellRect place;
    bool is_column;
    std::int64_t bricks;  // in it
    bool sparserThan(const Strip& other) const {
      return bricks * areaOf(other.place) < other.bricks * areaOf(place);
    }
  };

  Strip columnStrip(int column) const {
    return {
        {column, rect_.row, 1, rect_.height}, true, in_column_[static_cast<std::size_t>(column)]};
  }
  Strip rowStrip(int row) const {
    return {{rect_.column, row, rect_.width, 1}, false, in_row_[static_cast<std::size_t>(row)]};
  }

  void leaveOut(const Strip& strip) {
    const CellRect& place = strip.place;
    if (strip.is_column) {
      for (const std::uint16_t row : rows_[static_cast<std::size_t>(place.column)]) --in_row_[row];
      rect_.column += place.column == rect_.column;
      --rect_.width;
    } else {
      for (const std::uint16_t column : columns_[static_cast<std::size_t>(place.row)])
        --in_column_[column];
      rect_.row += place.row == rect_.row;
      --rect_.height;
    }
  }

  CellRect rect_;
  std::vector<std::vector<std::uint16_t>> rows_, columns_;  // of each column, of each row
  std::vector<std::int64_t> in_column_, in_row_;            // inside of rect_
};

}  // namespace

CellRect cellsOf(BrickColumn column) {
  return cellsOfBricks(brickOf(column));
}

void Extent::setSensor(double x, double y) {
  const auto cell = [this](double metres) {
    const double cells = std::floor(metres / resolution_);
    return static_cast<int>(std::clamp(cells, -1.0 * kKeyOfZero, kKeyOfZero - 1.0));
  };
  sensor_x_ = cell(x);
  sensor_y_ = cell(y);
}

CellRect Extent::fit(const CellRect& present, const std::vector<BrickColumn>& changed,
                     const OccupancyBricks& bricks, const ProjectionOptions& options) {
  const CellRect needed = cellsOf(changed);
  const CellRect kept = cellsOfBricks(keptBricks(options)).intersection(all_);
  const bool as_before =
      sized_ && contains(present, needed) && (left_out_ == 0 || contains(present, kept));
  if (as_before && areaOf(present) <= options.max_cells) return present;
  if (needed.empty() && left_out_ == 0) return present;
  if (left_out_ > 0) return cropped(present, bricks, options);
  const CellRect all = sized_ ? needed.hull(present) : needed;
  const CellRect cells =
      firstWithin(options.max_cells, {sized_ ? grown(present, all) : all, all, {}});
  if (cells.empty()) return cropped(present, bricks, options);
  sized_ = true;
  return cells;
}

CellRect Extent::cropped(const CellRect& present, const OccupancyBricks& bricks,
                         const ProjectionOptions& options) {
  const std::vector<BrickColumn> columns = bricks.columns();
  left_out_ = 0;
  if (columns.empty()) return present;
  Strips strips(columns);
  all_ = cellsOfBricks(strips.rect());
  const CellRect kept = keptBricks(options);
  while (areaOf(strips.rect()) > wantedBricks(options) && strips.leaveOneOut(kept)) {
  }
  CellRect cells = cellsOfBricks(strips.rect());
  if (sized_) {
    const CellRect both = cells.hull(present);
    cells = firstWithin(options.max_cells, {grown(present, both), both, cells});
  }
  for (const BrickColumn column : columns) left_out_ += !contains(cells, cellsOf(column));
  sized_ = true;
  return cells;
}

// A square of bricks around the sensor, which fits.
CellRect Extent::keptBricks(const ProjectionOptions& options) const {
  const double side = std::sqrt(static_cast<double>(wantedBricks(options)));
  const double reach = std::min(std::ceil(options.keep_around / (8.0 * resolution_)),
                                std::floor((side - 1.0) / 2.0));
  const CellRect brick{(sensor_x_ + kKeyOfZero) / 8, (sensor_y_ + kKeyOfZero) / 8, 1, 1};
  return brick.grown(static_cast<int>(reach));
}

}  // namespace grid_path_planner::mapping
