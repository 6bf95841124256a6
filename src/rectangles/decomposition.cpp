#include "grid_path_planner/rectangles/decomposition.h"

#include <algorithm>
#include <cassert>

#include "grid_path_planner/terrain/bit_scan.h"

namespace grid_path_planner {
namespace {

int nextFree(const BitMap& bits, int row, int column) {
  return std::min(bits.width(), oneFrom(bits.row(row), column, bits.width()));
}

int nextBlocked(const BitMap& bits, int row, int column) {
  return zeroFrom(bits.row(row), column);
}

// Makes the bits of [first, end) in a row 0.
void block(BitMap& bits, int row, int first, int end) {
  BitMap::Word* words = bits.row(row);
  while (first < end) {
    const int next = std::min(end, (first | 63) + 1);
    const BitMap::Word ones = ~BitMap::Word{0} >> (64 - (next - first));
    words[first >> 6] &= ~(ones << (first & 63));
    first = next;
  }
}

// The largest rectangle that has its last row in a run of free cells: what a heap entry promises.
struct Entry {
  std::uint32_t area;
  std::int32_t first_column;
  std::int32_t last_row;
  std::int32_t width;
  std::int32_t run_first;  // of the run in last_row that the rectangle was looked for in
  std::int32_t run_end;

  CellRect rect() const {
    const auto height = static_cast<int>(area / static_cast<std::uint32_t>(width));
    return {first_column, last_row - height + 1, width, height};
  }
};

struct TakenLater {
  bool operator()(const Entry& a, const Entry& b) const {
    if (a.area != b.area) return a.area < b.area;
    if (a.first_column != b.first_column) return a.first_column > b.first_column;
    if (a.last_row != b.last_row) return a.last_row > b.last_row;
    return a.width < b.width;
  }
};

class GreedyCut {
 public:
  GreedyCut(const BitMaps& free, const DecompositionLimits& limits, const StopToken& stop)
      : left_(free), limits_(limits), poll_(stop, 1024) {}

  std::vector<CellRect> run() {
    measureAll();
    std::vector<CellRect> rectangles;
    while (!heap_.empty() && rectangles.size() < limits_.count) {
      poll_();
      std::pop_heap(heap_.begin(), heap_.end(), TakenLater());
      const Entry entry = heap_.back();
      heap_.pop_back();
      const CellRect rect = entry.rect();
      if (isFree(rect)) {
        rectangles.push_back(rect);
        take(rect);
      }
      measureAgain(entry.last_row, entry.run_first, entry.run_end);
    }
    return rectangles;
  }

 private:
  // A bar of the histogram of free cells above a row that is still open to the right.
  struct Bar {
    int first_column;
    int height;
  };

  // Every run of every row; the heights grow from row to row.
  void measureAll() {
    const BitMap& rows = left_.rows;
    std::vector<int> heights(static_cast<std::size_t>(rows.width()), 0);
    for (int row = 0; row < rows.height(); ++row) {
      int end = 0;
      for (int first = nextFree(rows, row, 0);; first = nextFree(rows, row, end)) {
        std::fill(heights.begin() + end, heights.begin() + first, 0);
        if (first == rows.width()) break;
        end = nextBlocked(rows, row, first);
        for (int column = first; column < end; ++column) ++heights[std::size_t(column)];
        add(row, first, end, [&heights](int column) { return heights[std::size_t(column)]; });
      }
    }
    std::make_heap(heap_.begin(), heap_.end(), TakenLater());
  }

  // What is left of a run.
  void measureAgain(int row, int first, int end) {
    const BitMap& rows = left_.rows;
    for (first = nextFree(rows, row, first); first < end; first = nextFree(rows, row, first)) {
      const int run_end = std::min(end, nextBlocked(rows, row, first));
      const std::size_t before = heap_.size();
      add(row, first, run_end,
          [this, row](int column) { return row - zeroBefore(left_.columns.row(column), row + 1); });
      if (heap_.size() > before) std::push_heap(heap_.begin(), heap_.end(), TakenLater());
      first = run_end;
    }
  }

  // Appends the entry of a run, unless its rectangle is below the smallest area that is wanted.
  template <class HeightOf>
  void add(int row, int first, int end, HeightOf&& heightOf) {
    poll_();
    Entry best{0, first, row, 1, first, end};
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
    if (std::int64_t{best.area} >= limits_.smallest_area) heap_.push_back(best);
  }

  static void keepBetter(Entry& best, const Bar& bar, int end) {
    Entry entry = best;
    entry.first_column = bar.first_column;
    entry.width = end - bar.first_column;
    entry.area = static_cast<std::uint32_t>(entry.width) * static_cast<std::uint32_t>(bar.height);
    if (TakenLater()(best, entry)) best = entry;
  }

  bool isFree(const CellRect& rect) const {
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      if (!allOnes(left_.rows.row(row), rect.column, rect.column + rect.width)) return false;
    return true;
  }

  void take(const CellRect& rect) {
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      block(left_.rows, row, rect.column, rect.column + rect.width);
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      block(left_.columns, column, rect.row, rect.row + rect.height);
  }

  BitMaps left_;
  DecompositionLimits limits_;
  StopPoll poll_;
  std::vector<Entry> heap_;
  std::vector<Bar> bars_;
};

}  // namespace

std::vector<CellRect> largestFirst(const BitMaps& free, const DecompositionLimits& limits,
                                   const StopToken& stop) {
  return GreedyCut(free, limits, stop).run();
}

std::vector<CellRect> mergedRuns(const BitMap& free, const StopToken& stop) {
  std::vector<CellRect> rectangles;
  std::vector<std::size_t> above, here;  // those that end in the row before, and in this one
  StopPoll poll(stop, 64);
  for (int row = 0; row < free.height(); ++row) {
    poll();
    here.clear();
    auto candidate = above.begin();
    int end = 0;
    for (int first = nextFree(free, row, 0); first < free.width();
         first = nextFree(free, row, end)) {
      end = nextBlocked(free, row, first);
      while (candidate != above.end() && rectangles[*candidate].column < first) ++candidate;
      const bool joins = candidate != above.end() && rectangles[*candidate].column == first &&
                         rectangles[*candidate].width == end - first;
      here.push_back(joins ? *candidate : rectangles.size());
      if (joins)
        ++rectangles[*candidate].height;
      else
        rectangles.push_back({first, row, end - first, 1});
    }
    above.swap(here);
  }
  return rectangles;
}

std::size_t countRuns(const BitMap& free) {
  std::size_t runs = 0;
  for (int row = 0; row < free.height(); ++row) {
    const BitMap::Word* words = free.row(row);
    for (int i = 0; i < free.words(); ++i)
      runs += static_cast<std::size_t>(
          __builtin_popcountll(words[i] & ~(words[i] << 1 | words[i - 1] >> 63)));
  }
  return runs;
}

std::size_t largestFirstBytes(const GridGeometry& geometry, std::size_t runs) {
  // Runs are cut into more while rectangles are taken, and the vectors double when they grow.
  return BitMaps::bytesFor(geometry) + 2 * runs * (sizeof(Entry) + sizeof(CellRect));
}

}  // namespace grid_path_planner
