// The largest-first decomposition against the plain survey of the whole map for every rectangle.
//
//   grid_path_planner_rectangle_decomposition MAP [SURVEYED]
//
// The survey runs for its first SURVEYED rectangles (default 200), which must be the same as ours,
// and its time for all of them is extrapolated. Unknown cells are not free. Prints CPU times and
// their ratio; exit code 1 where a rectangle differs.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/planners/decomposition.h"
#include "support/free_cells.h"
#include "support/rectangle_survey.h"

namespace {

using namespace grid_path_planner::base;
using namespace grid_path_planner::costmap;
using namespace grid_path_planner::grid;
using namespace grid_path_planner::planners;
namespace test = grid_path_planner::test;

test::FreeCells freeCellsOf(const OccupancyGrid& map) {
  test::FreeCells free(map.geometry());
  const OccupancyThresholds thresholds;
  std::transform(map.values().begin(), map.values().end(), free.values().begin(),
                 [&thresholds](std::int8_t value) {
                   return thresholds.classify(value) == Occupancy::FREE ? 1 : 0;
                 });
  return free;
}

// CPU time of this thread, ms: other programs on the machine count less than on the wall clock.
double now() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

template <class Work>
double shortestOf(int runs, Work&& work) {
  double shortest = 0.0;
  for (int run = 0; run < runs; ++run) {
    const double begin = now();
    work();
    shortest = run == 0 ? now() - begin : std::min(shortest, now() - begin);
  }
  return shortest;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s MAP [SURVEYED]\n", argv[0]);
    return 2;
  }
  const test::FreeCells free = freeCellsOf(readMapFile(argv[1]));
  const BitMaps bits = test::bitMapsOf(free);
  std::vector<CellRect> all, runs;
  const double ours = shortestOf(5, [&] { all = largestFirst(bits, {}, StopToken()); });
  const double merged = shortestOf(5, [&] { runs = mergedRuns(bits.rows, StopToken()); });

  const std::size_t surveyed =
      std::min<std::size_t>(all.size(), argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 200);
  std::vector<CellRect> first;
  const double survey = shortestOf(1, [&] { first = test::surveyRectangles(free, surveyed); });
  const bool same = std::equal(first.begin(), first.end(), all.begin());

  const double whole = survey / static_cast<double>(surveyed) * static_cast<double>(all.size());
  std::printf("%s: %dx%d cells, %zu free\n", argv[1], free.width(), free.height(),
              free.values().size() - static_cast<std::size_t>(std::count(free.values().begin(),
                                                                         free.values().end(), 0)));
  std::printf("largest first: %zu rectangles in %.2f ms; merged runs: %zu in %.2f ms\n", all.size(),
              ours, runs.size(), merged);
  std::printf("plain survey: %.2f ms for %zu, %.0f ms for all: %.0f times as long; the %s\n",
              survey, surveyed, whole, whole / ours,
              same ? "same rectangles" : "RECTANGLES DIFFER");
  return same ? 0 : 1;
}
