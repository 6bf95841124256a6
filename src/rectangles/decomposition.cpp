#include "grid_path_planner/rectangles/decomposition.h"

#include <algorithm>
#include <utility>

#include "grid_path_planner/terrain/bit_scan.h"

namespace grid_path_planner {
namespace {

int nextFree(const BitMap& bits, int row, int column) {
  return std::min(bits.width(), oneFrom(bits.row(row), column, bits.width()));
}

int nextBlocked(const BitMap& bits, int row, int column) {
  return zeroFrom(bits.row(row), column);
}

void fill(BitMaps& bits, const CellRect& rect, bool value) {
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    fillBits(bits.rows.row(row), rect.column, rect.column + rect.width, value);
  for (int column = rect.column; column < rect.column + rect.width; ++column)
    fillBits(bits.columns.row(column), rect.row, rect.row + rect.height, value);
}

// The columns or rows of a bit map as the map's: each stands for one.
struct EvenLines {
  int between(int first, int end) const { return end - first; }
  int firstOf(int end, int length) const { return end - length; }
};

// The same where each may stand for several: number i begins at edges[i].
struct UnevenLines {
  std::vector<int> edges;

  int between(int first, int end) const {
    return edges[std::size_t(end)] - edges[std::size_t(first)];
  }
  // The number of the line from which on there are `length` up to `end`.
  int firstOf(int end, int length) const { return indexOf(edges[std::size_t(end)] - length); }
  int indexOf(int edge) const {
    return static_cast<int>(std::lower_bound(edges.begin(), edges.end(), edge) - edges.begin());
  }
};

// The largest rectangle that has its last row in a run of free cells: what a heap entry promises.
struct Entry {
  std::uint32_t area;
  std::int32_t first_column;
  std::int32_t last_row;
  std::int32_t width;
  std::int32_t run_first;  // of the run in last_row that the rectangle was looked for in
  std::int32_t run_end;
};

struct TakenLater {
  bool operator()(const Entry& a, const Entry& b) const {
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
  GreedyCut(BitMaps free, Lines columns, Lines rows, const DecompositionLimits& limits,
            const StopToken& stop)
      : left_(std::move(free)),
        columns_(std::move(columns)),
        rows_(std::move(rows)),
        limits_(limits),
        poll_(stop, 1024) {}

  std::vector<CellRect> run() {
    measureAll();
    std::vector<CellRect> rectangles;
    while (!heap_.empty() && rectangles.size() < limits_.count) {
      poll_();
      std::pop_heap(heap_.begin(), heap_.end(), TakenLater());
      const Entry entry = heap_.back();
      heap_.pop_back();
      const CellRect rect = rectOf(entry);
      if (isFree(rect)) {
        rectangles.push_back(rect);
        fill(left_, rect, false);
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
    std::make_heap(heap_.begin(), heap_.end(), TakenLater());
  }

  // What is left of a run.
  void measureAgain(int row, int first, int end) {
    const BitMap& rows = left_.rows;
    for (first = nextFree(rows, row, first); first < end; first = nextFree(rows, row, first)) {
      const int run_end = std::min(end, nextBlocked(rows, row, first));
      const std::size_t before = heap_.size();
      add(row, first, run_end, [this, row](int column) {
        return rows_.between(zeroBefore(left_.columns.row(column), row + 1) + 1, row + 1);
      });
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

  void keepBetter(Entry& best, const Bar& bar, int end) const {
    Entry entry = best;
    entry.first_column = bar.first_column;
    entry.width = end - bar.first_column;
    entry.area = static_cast<std::uint32_t>(columns_.between(bar.first_column, end)) *
                 static_cast<std::uint32_t>(bar.height);
    if (TakenLater()(best, entry)) best = entry;
  }

  bool isFree(const CellRect& rect) const {
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      if (!allOnes(left_.rows.row(row), rect.column, rect.column + rect.width)) return false;
    return true;
  }

  CellRect rectOf(const Entry& entry) const {
    const int width = columns_.between(entry.first_column, entry.first_column + entry.width);
    const int end = entry.last_row + 1;
    const int first =
        rows_.firstOf(end, static_cast<int>(entry.area / static_cast<std::uint32_t>(width)));
    return {entry.first_column, first, entry.width, end - first};
  }

  BitMaps left_;
  Lines columns_;
  Lines rows_;
  DecompositionLimits limits_;
  StopPoll poll_;
  std::vector<Entry> heap_;
  std::vector<Bar> bars_;
};

// The edges along one axis, ascending.
UnevenLines linesOf(const std::vector<CellRect>& free, const std::vector<CellRect>& blocked,
                    int CellRect::*first, int CellRect::*size) {
  std::vector<int> edges;
  edges.reserve(2 * (free.size() + blocked.size()));
  for (const auto* rectangles : {&free, &blocked})
    for (const CellRect& rect : *rectangles) {
      edges.push_back(rect.*first);
      edges.push_back(rect.*first + rect.*size);
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return {std::move(edges)};
}

}  // namespace

std::vector<CellRect> largestFirst(const BitMaps& free, const DecompositionLimits& limits,
                                   const StopToken& stop) {
  return GreedyCut<EvenLines>(free, {}, {}, limits, stop).run();
}

std::vector<CellRect> largestFirst(const std::vector<CellRect>& free,
                                   const std::vector<CellRect>& blocked, const StopToken& stop) {
  const UnevenLines columns = linesOf(free, blocked, &CellRect::column, &CellRect::width);
  const UnevenLines rows = linesOf(free, blocked, &CellRect::row, &CellRect::height);
  if (free.empty()) return {};
  const int width = static_cast<int>(columns.edges.size()) - 1;
  const int height = static_cast<int>(rows.edges.size()) - 1;
  BitMaps bits;
  bits.rows = BitMap(width, height);
  bits.columns = BitMap(height, width);
  const auto mark = [&](const std::vector<CellRect>& rectangles, bool value) {
    for (const CellRect& rect : rectangles) {
      const int column = columns.indexOf(rect.column), row = rows.indexOf(rect.row);
      fill(bits,
           {column, row, columns.indexOf(rect.column + rect.width) - column,
            rows.indexOf(rect.row + rect.height) - row},
           value);
    }
  };
  mark(free, true);
  mark(blocked, false);

  std::vector<CellRect> rectangles =
      GreedyCut<UnevenLines>(std::move(bits), columns, rows, {}, stop).run();
  for (CellRect& rect : rectangles)
    rect = {columns.edges[std::size_t(rect.column)], rows.edges[std::size_t(rect.row)],
            columns.between(rect.column, rect.column + rect.width),
            rows.between(rect.row, rect.row + rect.height)};
  return rectangles;
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
