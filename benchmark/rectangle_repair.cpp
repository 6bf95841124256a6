// Edits of a rectangle map: what a toggled cell takes, and how far the number of rectangles drifts
// from that of a fresh decomposition.
//
//   grid_path_planner_rectangle_repair MAP [EDITS]
//
// Unknown cells are not free. Four kinds of edits, each on its own copy of the map: cells toggled
// anywhere, cells toggled beside obstacles, blocks of up to 12x12 cells that come and go, and all
// three in turn. Prints CPU times of RectangleGraph::edit (mean, 99th percentile, longest) and the
// count beside that of largestFirst, at ten moments.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <deque>
#include <random>

#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/planners/decomposition.h"
#include "grid_path_planner/planners/rectangle_graph.h"

namespace {

using namespace grid_path_planner::base;
using namespace grid_path_planner::costmap;
using namespace grid_path_planner::grid;
using namespace grid_path_planner::planners;

constexpr unsigned kSeed = 20261121;

double now() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) * 1e-3;
}

using Weights = Grid<std::uint16_t>;

Weights weightsOf(const OccupancyGrid& map) {
  Weights weights(map.geometry());
  const OccupancyThresholds thresholds;
  std::transform(map.values().begin(), map.values().end(), weights.values().begin(),
                 [&thresholds](std::int8_t value) -> std::uint16_t {
                   return thresholds.classify(value) == Occupancy::FREE ? 1 : 0;
                 });
  return weights;
}

class Editing {
 public:
  Editing(Weights weights, const char* name, int kind)
      : weights_(std::move(weights)),
        bits_(weights_, StopToken()),
        map_(weights_.geometry(), largestFirst(bits_, {}, StopToken()), Touching::BORDERS),
        name_(name),
        kind_(kind) {}

  void run(int edits) {
    std::printf("%s\n", name_);
    std::vector<double> times;
    for (int i = 1; i <= edits; ++i) {
      const CellRect changed = change(kind_ == 3 ? i % 3 : kind_);
      bits_.update(weights_, changed, StopToken());
      const double begin = now();
      const RectangleEdit edit = map_.edit(bits_.rows, changed, StopToken());
      times.push_back(now() - begin);
      if (i % std::max(1, edits / 10) == 0) tell(i);
    }
    std::sort(times.begin(), times.end());
    double sum = 0.0;
    for (const double time : times) sum += time;
    std::printf("  us an edit: mean %.2f, median %.2f, p99 %.2f, longest %.2f\n",
                sum / static_cast<double>(times.size()), times[times.size() / 2],
                times[times.size() * 99 / 100], times.back());
  }

 private:
  Cell anyCell() {
    std::uniform_int_distribution<int> column(0, weights_.width() - 1);
    const int drawn = column(random_);
    return {drawn, std::uniform_int_distribution<int>(0, weights_.height() - 1)(random_)};
  }

  CellRect change(int kind) {
    switch (kind) {
      case 0:
        return toggle(anyCell());
      case 1:
        return toggle(cellBesideAnObstacle());
      default:
        return blockThatComesOrGoes();
    }
  }

  CellRect toggle(Cell cell) {
    weights_[cell] = weights_[cell] == 0 ? 1 : 0;
    return {cell.column, cell.row, 1, 1};
  }

  Cell cellBesideAnObstacle() {
    while (true) {
      const Cell cell = anyCell();
      int blocked = 0;
      for (int row = cell.row - 1; row <= cell.row + 1; ++row)
        for (int column = cell.column - 1; column <= cell.column + 1; ++column)
          if (weights_.contains({column, row}) && weights_[Cell{column, row}] == 0) ++blocked;
      if (blocked > 0 && blocked < 9) return cell;
    }
  }

  CellRect blockThatComesOrGoes() {
    if (blocks_.size() >= 30) {
      const auto [rect, before] = std::move(blocks_.front());
      blocks_.pop_front();
      auto value = before.begin();
      for (int row = rect.row; row < rect.row + rect.height; ++row)
        for (int column = rect.column; column < rect.column + rect.width; ++column)
          weights_[Cell{column, row}] = *value++;
      return rect;
    }
    std::uniform_int_distribution<int> side(1, 12);
    const Cell low = anyCell();
    const int width = side(random_);
    const CellRect rect = CellRect{low.column, low.row, width, side(random_)}.intersection(
        weights_.geometry().rect());
    std::vector<std::uint16_t> before;
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      for (int column = rect.column; column < rect.column + rect.width; ++column) {
        before.push_back(weights_[Cell{column, row}]);
        weights_[Cell{column, row}] = 0;
      }
    blocks_.emplace_back(rect, std::move(before));
    return rect;
  }

  void tell(int edits) const {
    const std::size_t fresh = largestFirst(bits_, {}, StopToken()).size();
    const std::size_t runs = mergedRuns(bits_.rows, StopToken()).size();
    std::printf("  after %5d: %zu rectangles, fresh %zu, ratio %.3f (merged runs %zu)\n", edits,
                map_.count(), fresh, static_cast<double>(map_.count()) / static_cast<double>(fresh),
                runs);
  }

  std::mt19937 random_{kSeed};
  Weights weights_;
  BitMaps bits_;
  RectangleGraph map_;
  const char* name_;
  int kind_;
  std::deque<std::pair<CellRect, std::vector<std::uint16_t>>> blocks_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s MAP [EDITS]\n", argv[0]);
    return 2;
  }
  const Weights weights = weightsOf(readMapFile(argv[1]));
  const int edits = argc > 2 ? std::atoi(argv[2]) : 10000;
  const char* names[] = {"cells toggled anywhere", "cells toggled beside obstacles",
                         "blocks that come and go", "all three in turn"};
  for (int kind = 0; kind < 4; ++kind) Editing(weights, names[kind], kind).run(edits);
  return 0;
}
