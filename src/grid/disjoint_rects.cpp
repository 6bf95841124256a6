#include <algorithm>
#include <optional>

#include "grid/fewer_rects.h"
#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::grid {

namespace {

// The first side of tiles; larger ones follow until the list is short enough.
constexpr int kTileSide = 32;
constexpr int kMostTilesAcross = 64;

std::int64_t areaOf(const CellRect& rect) {
  return std::int64_t{rect.width} * rect.height;
}

// Around two rectangles, where that adds few cells to theirs.
std::optional<CellRect> joinedRect(const CellRect& a, const CellRect& b) {
  const CellRect hull = a.hull(b);
  const std::int64_t cells = areaOf(a) + areaOf(b);
  return areaOf(hull) <= cells + cells / 4 ? std::optional<CellRect>(hull) : std::nullopt;
}

bool areDisjoint(std::vector<CellRect> rects) {
  std::sort(rects.begin(), rects.end(),
            [](const CellRect& a, const CellRect& b) { return a.row < b.row; });
  for (auto rect = rects.begin(); rect != rects.end(); ++rect)
    for (auto next = rect + 1; next != rects.end() && next->row < rect->row + rect->height; ++next)
      if (!rect->intersection(*next).empty()) return false;
  return true;
}

// Rectangles by the square tiles that they lie in. What lies in one tile has one hull; hulls in
// neighbouring tiles are joined, first along a row of tiles, then across rows where they span the
// same tiles. So no two overlap.
class Tiles {
 public:
  Tiles(const CellRect& all, int side)
      : all_(all),
        side_(side),
        across_((all.width + side - 1) / side),
        hulls_(std::size_t(across_) * std::size_t((all.height + side - 1) / side)) {}

  void add(const CellRect& rect) {
    const int first_column = (rect.column - all_.column) / side_;
    const int last_column = (rect.column + rect.width - 1 - all_.column) / side_;
    const int last_row = (rect.row + rect.height - 1 - all_.row) / side_;
    for (int row = (rect.row - all_.row) / side_; row <= last_row; ++row)
      for (int column = first_column; column <= last_column; ++column) {
        CellRect& hull = hulls_[std::size_t(row) * across_ + column];
        hull = hull.hull(rect.intersection(
            {all_.column + column * side_, all_.row + row * side_, side_, side_}));
      }
  }

  std::vector<CellRect> joined() const {
    std::vector<CellRect> done;
    std::vector<Run> open;  // of the last row
    for (std::size_t row = 0; row < hulls_.size(); row += across_) {
      std::vector<Run> runs = runsOf(row);
      std::size_t i = 0;
      for (const Run& before : open) {
        while (i < runs.size() && runs[i].first < before.first) ++i;
        const bool same =
            i < runs.size() && runs[i].first == before.first && runs[i].last == before.last;
        const auto hull = same ? joinedRect(before.rect, runs[i].rect) : std::nullopt;
        if (hull)
          runs[i].rect = *hull;
        else
          done.push_back(before.rect);
      }
      open = std::move(runs);
    }
    for (const Run& run : open) done.push_back(run.rect);
    return done;
  }

 private:
  // Of tiles in one row of them, and the rectangle in them.
  struct Run {
    int first;
    int last;
    CellRect rect;
  };

  std::vector<Run> runsOf(std::size_t row) const {
    std::vector<Run> runs;
    for (int column = 0; column < across_; ++column) {
      const CellRect& hull = hulls_[row + column];
      if (hull.empty()) continue;
      const auto longer = runs.empty() ? std::nullopt : joinedRect(runs.back().rect, hull);
      if (longer)
        runs.back() = {runs.back().first, column, *longer};
      else
        runs.push_back({column, column, hull});
    }
    return runs;
  }

  CellRect all_;
  int side_;
  int across_;
  std::vector<CellRect> hulls_;  // of each tile
};

}  // namespace

std::vector<CellRect> disjointRects(const std::vector<CellRect>& rects) {
  return fewerRects(rects, kMostRects);
}

std::vector<CellRect> fewerRects(const std::vector<CellRect>& rects, std::size_t most) {
  std::vector<CellRect> filled;
  CellRect all;
  for (const CellRect& rect : rects)
    if (!rect.empty()) {
      filled.push_back(rect);
      all = all.hull(rect);
    }
  if (filled.size() <= most && areDisjoint(filled)) return filled;
  int side = kTileSide;
  while (std::max(all.width, all.height) / side > kMostTilesAcross) side *= 2;
  for (;; side *= 2) {
    Tiles tiles(all, side);
    for (const CellRect& rect : filled) tiles.add(rect);
    std::vector<CellRect> joined = tiles.joined();
    if (joined.size() <= most) return joined;
  }
}

std::vector<CellRect> grownRects(const std::vector<CellRect>& rects, int margin,
                                 const CellRect& within) {
  std::vector<CellRect> grown;
  for (const CellRect& rect : rects)
    if (!rect.empty()) grown.push_back(rect.grown(margin).intersection(within));
  return disjointRects(grown);
}

}  // namespace grid_path_planner::grid
