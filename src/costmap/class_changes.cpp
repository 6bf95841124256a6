#include "costmap/class_changes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

namespace grid_path_planner::costmap {

using base::StopPoll, base::StopToken;
using grid::Cell, grid::CellRect, grid::Grid, grid::Occupancy, grid::OccupancyGrid,
    grid::OccupancyThresholds;

namespace {

constexpr int kTogether = 16;
using Sixteen = std::int8_t __attribute__((vector_size(kTogether)));
static_assert(sizeof(Occupancy) == 1 && int(Occupancy::FREE) == 0);

// OccupancyThresholds::classify() of sixteen values.
class Classifier {
 public:
  explicit Classifier(const OccupancyThresholds& thresholds)
      : free_max_(Sixteen{} + static_cast<std::int8_t>(thresholds.free_max)),
        occupied_min_(Sixteen{} + static_cast<std::int8_t>(thresholds.occupied_min)) {}

  Sixteen operator()(const std::int8_t* values) const {
    Sixteen value;
    std::memcpy(&value, values, sizeof value);
    const Sixteen occupied = value >= occupied_min_;
    const Sixteen free = (value >= Sixteen{}) & (value <= free_max_);
    return (occupied & static_cast<std::int8_t>(Occupancy::OCCUPIED)) |
           (~occupied & ~free & static_cast<std::int8_t>(Occupancy::UNKNOWN));
  }

 private:
  Sixteen free_max_;
  Sixteen occupied_min_;
};

void add(CellRect& hull, Cell cell) {
  hull = hull.hull({cell.column, cell.row, 1, 1});
}

// The changes in one square.
struct Square {
  CellRect all, filled, vacated, other;

  void addCell(Cell cell, Occupancy before, Occupancy now) {
    if (now == before) return;
    add(all, cell);
    const bool was_occupied = before == Occupancy::OCCUPIED;
    add(now == Occupancy::OCCUPIED ? filled : was_occupied ? vacated : other, cell);
  }
};

// Calls compare(first column, cells) for all cells of a row of `rect`, up to sixteen at a time.
template <class Compare>
void forEachSixteen(const CellRect& rect, const Compare& compare) {
  const int end = rect.column + rect.width;
  for (int column = rect.column; column < end; column += kTogether)
    compare(column, std::min(kTogether, end - column));
}

void appendFilled(const CellRect& rect, std::vector<CellRect>& rects) {
  if (!rect.empty()) rects.push_back(rect);
}

}  // namespace

void classify(const OccupancyGrid& map, const OccupancyThresholds& thresholds, const CellRect& rect,
              Grid<Occupancy>& classes, const StopToken& stop) {
  const Classifier classifier(thresholds);
  StopPoll poll(stop, 64);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    const std::int8_t* from = map.row(row);
    Occupancy* to = classes.row(row);
    forEachSixteen(rect, [&](int column, int cells) {
      if (cells == kTogether) {
        const Sixteen now = classifier(from + column);
        std::memcpy(to + column, &now, sizeof now);
      } else {
        for (int i = column; i < column + cells; ++i) to[i] = thresholds.classify(from[i]);
      }
    });
  }
}

ClassChanges::ClassChanges(const OccupancyGrid& map, const OccupancyThresholds& thresholds,
                           const std::vector<CellRect>& changed, const Grid<Occupancy>& before,
                           const StopToken& stop) {
  static_assert(kSide == kTogether);
  const Classifier classifier(thresholds);
  StopPoll poll(stop, 64);
  std::vector<Square> squares;
  for (const CellRect& rect : changed) {
    for (int first = rect.row; first < rect.row + rect.height; first += kSide) {
      squares.assign(static_cast<std::size_t>((rect.width + kSide - 1) / kSide), {});
      for (int row = first; row < std::min(first + kSide, rect.row + rect.height); ++row) {
        poll();
        const std::int8_t* values = map.row(row);
        const Occupancy* was = before.row(row);
        forEachSixteen(rect, [&](int column, int cells) {
          if (cells == kTogether) {
            const Sixteen now = classifier(values + column);
            if (std::memcmp(&now, was + column, sizeof now) == 0) return;
          }
          Square& square = squares[static_cast<std::size_t>((column - rect.column) / kSide)];
          for (int i = column; i < column + cells; ++i)
            square.addCell({i, row}, was[i], thresholds.classify(values[i]));
        });
      }
      for (const Square& square : squares) {
        appendFilled(square.all, all);
        appendFilled(square.filled, filled);
        appendFilled(square.vacated, vacated);
        appendFilled(square.other, other);
      }
    }
  }
}

// Squares of twice the side, and again: what lies in one becomes one rectangle where that pays.
std::vector<CellRect> joinedRects(std::vector<CellRect> rects, int margin) {
  const auto cellsAround = [margin](const CellRect& rect) {
    const CellRect grown = rect.grown(margin);
    return std::int64_t{grown.width} * grown.height;
  };
  for (int side = 2 * ClassChanges::kSide; rects.size() > 1; side *= 2) {
    const auto square = [side](const CellRect& rect) {
      return std::make_pair(rect.row / side, rect.column / side);
    };
    std::sort(rects.begin(), rects.end(),
              [&](const CellRect& a, const CellRect& b) { return square(a) < square(b); });
    std::vector<CellRect> joined;
    for (auto first = rects.begin(); first != rects.end();) {
      CellRect hull;
      std::int64_t cells = 0;
      auto last = first;
      for (; last != rects.end() && square(*last) == square(*first); ++last) {
        hull = hull.hull(*last);
        cells += cellsAround(*last);
      }
      if (cellsAround(hull) <= cells)
        joined.push_back(hull);
      else
        joined.insert(joined.end(), first, last);
      first = last;
    }
    if (joined.size() == rects.size()) break;
    rects = std::move(joined);
  }
  return rects;
}

}  // namespace grid_path_planner::costmap
