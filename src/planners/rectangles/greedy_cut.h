// The largest-first cut of planners/decomposition.h, over rows and columns that may stand for
// several rows and columns of the map.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "grid_path_planner/costmap/bit_maps.h"
#include "grid_path_planner/planners/decomposition.h"

namespace grid_path_planner::planners {

inline int nextFree(const costmap::BitMap& bits, int row, int column) {
  return std::min(bits.width(), costmap::oneFrom(bits.row(row), column, bits.width()));
}

inline int nextBlocked(const costmap::BitMap& bits, int row, int column) {
  return costmap::zeroFrom(bits.row(row), column);
}

// Of a rectangle of the bit maps' rows and columns.
inline void fillBits(costmap::BitMaps& bits, const grid::CellRect& rect, bool value) {
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    costmap::fillBits(bits.rows.row(row), rect.column, rect.column + rect.width, value);
  for (int column = rect.column; column < rect.column + rect.width; ++column)
    costmap::fillBits(bits.columns.row(column), rect.row, rect.row + rect.height, value);
}

// Each column or row of the bit map stands for one of the map.
struct EvenLines {
  int between(int first, int end) const { return end - first; }
  int firstOf(int end, int length) const { return end - length; }
};

// An upper bound of the largest rectangle that has its last row in a run of free cells.
struct GreedyEntry {
  std::uint32_t area;
  std::int32_t first_column;
  std::int32_t last_row;
  std::int32_t width;
  std::int32_t run_first;  // of the run in last_row
  std::int32_t run_end;
};

struct GreedyOrder {
  bool operator()(const GreedyEntry& a, const GreedyEntry& b) const {
    if (a.area != b.area) return a.area < b.area;
    if (a.first_column != b.first_column) return a.first_column > b.first_column;
    if (a.last_row != b.last_row) return a.last_row > b.last_row;
    return a.width < b.width;
  }
};

// Numbers of rows and columns are the bit maps'; areas and heights are in cells.
template <class Lines>
class GreedyCut {
 public:
  GreedyCut(costmap::BitMaps free, Lines columns, Lines rows, const DecompositionLimits& limits,
            const base::StopToken& stop)
      : left_(std::move(free)),
        columns_(std::move(columns)),
        rows_(std::move(rows)),
        limits_(limits),
        stop_(stop) {
    checkRoomFor(0);
  }

  std::vector<grid::CellRect> run() {
    measureAll();
    while (!heap_.empty() && rectangles_.size() < limits_.count) {
      countWork(1);
      std::pop_heap(heap_.begin(), heap_.end(), GreedyOrder());
      const GreedyEntry entry = heap_.back();
      heap_.pop_back();
      const grid::CellRect rect = rectOf(entry);
      if (isFree(rect)) {
        push(rectangles_, rect);
        fillBits(left_, rect, false);
      }
      remeasure(entry.last_row, entry.run_first, entry.run_end);
    }
    return std::move(rectangles_);
  }

 private:
  // Some milliseconds.
  static constexpr int kColumnsBetweenPolls = 1 << 14;

  // A bar of the histogram of free cells above a row that is still open to the right.
  struct Bar {
    int first_column;
    int height;
  };

  // Adds the entries of all runs of all rows, by the histogram of free cells above each row.
  void measureAll() {
    const costmap::BitMap& rows = left_.rows;
    std::vector<int> heights(static_cast<std::size_t>(rows.width()), 0);
    for (int row = 0; row < rows.height(); ++row) {
      const int height = rows_.between(row, row + 1);
      int end = 0;
      for (int first = nextFree(rows, row, 0);; first = nextFree(rows, row, end)) {
        std::fill(heights.begin() + end, heights.begin() + first, 0);
        if (first == rows.width()) break;
        end = nextBlocked(rows, row, first);
        for (int column = first; column < end; ++column) heights[std::size_t(column)] += height;
        add(row, first, end, [&heights](int column) { return heights[std::size_t(column)]; });
      }
    }
    std::make_heap(heap_.begin(), heap_.end(), [this](const GreedyEntry& a, const GreedyEntry& b) {
      countWork(1);
      return GreedyOrder()(a, b);
    });
  }

  // Polls the token once in kColumnsBetweenPolls columns.
  void countWork(int columns) {
    work_ += columns;
    if (work_ < kColumnsBetweenPolls) return;
    work_ = 0;
    const base::StopReason reason = stop_.reason();
    if (reason != base::StopReason::NONE) throw base::Stopped(reason);
  }

  void checkRoomFor(std::size_t bytes) const {
    const std::size_t taken = left_.bytes() + heap_.capacity() * sizeof(GreedyEntry) +
                              rectangles_.capacity() * sizeof(grid::CellRect);
    if (bytes > limits_.bytes || taken > limits_.bytes - bytes) throw DecompositionTooLarge();
  }

  // While a vector grows, both copies take memory.
  template <class T>
  void push(std::vector<T>& values, const T& value) {
    if (values.size() == values.capacity()) checkRoomFor((2 * values.size() + 1) * sizeof(T));
    values.push_back(value);
  }

  // Adds the entries of the runs that are left of a run.
  void remeasure(int row, int first, int end) {
    const costmap::BitMap& rows = left_.rows;
    for (first = nextFree(rows, row, first); first < end; first = nextFree(rows, row, first)) {
      const int run_end = std::min(end, nextBlocked(rows, row, first));
      const std::size_t before = heap_.size();
      add(row, first, run_end, [this, row](int column) {
        return rows_.between(costmap::zeroBefore(left_.columns.row(column), row + 1) + 1, row + 1);
      });
      if (heap_.size() > before) std::push_heap(heap_.begin(), heap_.end(), GreedyOrder());
      first = run_end;
    }
  }

  // Appends the entry of a run, unless its rectangle is smaller than DecompositionLimits allow.
  template <class HeightOf>
  void add(int row, int first, int end, HeightOf&& heightOf) {
    countWork(end - first);
    GreedyEntry best{0, first, row, 1, first, end};
    bars_.clear();
    for (int column = first; column <= end; ++column) {
      const int height = column < end ? heightOf(column) : 0;
      int start = column;
      while (!bars_.empty() && bars_.back().height >= height) {
        start = bars_.back().first_column;
        if (bars_.back().height > height) keepBetter(best, bars_.back(), column);
        bars_.pop_back();
      }
      bars_.push_back({start, height});
    }
    if (std::int64_t{best.area} >= limits_.smallest_area) push(heap_, best);
  }

  void keepBetter(GreedyEntry& best, const Bar& bar, int end) const {
    GreedyEntry entry = best;
    entry.first_column = bar.first_column;
    entry.width = end - bar.first_column;
    entry.area = static_cast<std::uint32_t>(columns_.between(bar.first_column, end)) *
                 static_cast<std::uint32_t>(bar.height);
    if (GreedyOrder()(best, entry)) best = entry;
  }

  bool isFree(const grid::CellRect& rect) const {
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      if (!costmap::allOnes(left_.rows.row(row), rect.column, rect.column + rect.width))
        return false;
    return true;
  }

  grid::CellRect rectOf(const GreedyEntry& entry) const {
    const int width = columns_.between(entry.first_column, entry.first_column + entry.width);
    const int end = entry.last_row + 1;
    const int first =
        rows_.firstOf(end, static_cast<int>(entry.area / static_cast<std::uint32_t>(width)));
    return {entry.first_column, first, entry.width, end - first};
  }

  costmap::BitMaps left_;
  Lines columns_;
  Lines rows_;
  DecompositionLimits limits_;
  const base::StopToken& stop_;
  int work_ = 0;
  std::vector<GreedyEntry> heap_;
  std::vector<grid::CellRect> rectangles_;
  std::vector<Bar> bars_;
};

}  // namespace grid_path_planner::planners
