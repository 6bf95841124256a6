#include "grid_path_planner/planners/decomposition.h"

#include "planners/rectangles/greedy_cut.h"

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using costmap::BitMap, costmap::BitMaps;
using grid::CellRect, grid::GridGeometry;

std::vector<CellRect> largestFirst(const BitMaps& free, const DecompositionLimits& limits,
                                   const StopToken& stop) {
  if (free.bytes() > limits.bytes) throw DecompositionTooLarge();
  return GreedyCut<EvenLines>(free, {}, {}, limits, stop).run();
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
  // Runs are split as rectangles are cut, and the vectors double when they grow.
  return BitMaps::bytesFor(geometry) + 2 * runs * (sizeof(GreedyEntry) + sizeof(CellRect));
}

}  // namespace grid_path_planner::planners
