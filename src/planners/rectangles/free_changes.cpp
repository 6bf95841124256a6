#include "planners/rectangles/free_changes.h"

#include <algorithm>
#include <utility>

#include "grid_path_planner/costmap/bit_maps.h"
#include "grid_path_planner/planners/decomposition.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::BitMap, costmap::fillBits;
using grid::CellRect;

namespace {

// Bit maps of `changed` alone, from the word on that holds its first column.
struct Window {
  CellRect cells;
  int first_word;

  explicit Window(const CellRect& changed) : cells(changed), first_word(changed.column >> 6) {}

  int columnOf(int column) const { return column - 64 * first_word; }
  CellRect inMap(const CellRect& rect) const {
    return {rect.column + 64 * first_word, rect.row + cells.row, rect.width, rect.height};
  }
};

struct Change {
  CellRect rect;
  bool gained;
};
using Changes = std::vector<Change>::iterator;

FreeChanges joined(Changes first, Changes last) {
  FreeChanges changes;
  for (; first != last; ++first)
    (first->gained ? changes.gained : changes.lost).push_back(first->rect);
  return changes;
}

// Cells, of a group of several changes.
constexpr int kLargestHull = 64;

void group(Changes first, Changes last, std::vector<FreeChanges>& groups) {
  FreeChanges changes = joined(first, last);
  const CellRect hull = changes.hull();
  if (last - first == 1 || std::max(hull.width, hull.height) <= kLargestHull)
    return groups.push_back(std::move(changes));
  const bool wide = hull.width >= hull.height;
  const auto twiceTheMiddle = [wide](const CellRect& rect) {
    return wide ? 2 * rect.column + rect.width : 2 * rect.row + rect.height;
  };
  const Changes half = first + (last - first) / 2;
  std::nth_element(first, half, last, [&](const Change& a, const Change& b) {
    return twiceTheMiddle(a.rect) < twiceTheMiddle(b.rect);
  });
  group(first, half, groups);
  group(half, last, groups);
}

}  // namespace

CellRect FreeChanges::hull() const {
  CellRect hull;
  for (const auto* list : {&gained, &lost})
    for (const CellRect& rect : *list) hull = hull.hull(rect);
  return hull;
}

std::vector<FreeChanges> groupedByPlace(const FreeChanges& changes) {
  std::vector<Change> all;
  for (const CellRect& rect : changes.gained) all.push_back({rect, true});
  for (const CellRect& rect : changes.lost) all.push_back({rect, false});
  std::vector<FreeChanges> groups;
  if (!all.empty()) group(all.begin(), all.end(), groups);
  return groups;
}

FreeChanges freeChanges(const BitMap& free, const std::vector<CellRect>& rectangles,
                        const CellRect& changed, const StopToken& stop) {
  const Window window(changed);
  const int end = window.columnOf(changed.column + changed.width);
  BitMap covered(end, changed.height);
  for (const CellRect& rect : rectangles) {
    const CellRect part = rect.intersection(changed);
    for (int row = part.row; row < part.row + part.height; ++row)
      fillBits(covered.row(row - changed.row), window.columnOf(part.column),
               window.columnOf(part.column + part.width), true);
  }

  BitMap gained(end, changed.height);
  BitMap lost(end, changed.height);
  for (int row = 0; row < changed.height; ++row) {
    const BitMap::Word* now = free.row(changed.row + row) + window.first_word;
    const BitMap::Word* before = covered.row(row);
    for (int word = 0; word < covered.words(); ++word) {
      gained.row(row)[word] = now[word] & ~before[word];
      lost.row(row)[word] = before[word] & ~now[word];
    }
    // Clears the bits of the words outside `changed`.
    for (BitMap* bits : {&gained, &lost}) {
      fillBits(bits->row(row), 0, window.columnOf(changed.column), false);
      fillBits(bits->row(row), end, 64 * covered.words(), false);
    }
  }

  FreeChanges changes{mergedRuns(gained, stop), mergedRuns(lost, stop)};
  for (auto* each : {&changes.gained, &changes.lost})
    for (CellRect& rect : *each) rect = window.inMap(rect);
  return changes;
}

}  // namespace grid_path_planner::planners
