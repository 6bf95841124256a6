// What a change of the map takes until there is a new path, stage by stage, in the library.
//
//   grid_path_planner_map_updates MAP [--side N] [--planner NAME] [--rounds N] [--radius R] [--decay D]
//
// MAP (any map file) is repeated until it has N x N cells (1024). Radius and decay are in cells and
// 1/cells (6, 0.436: back to a free cell's weight after 10). Each round toggles cells, between a
// path's ends some 300 cells apart, and prints the median of
//
//   compare  the whole new map with the last one, and the copy of what differs
//   costmap  CostmapBuilder
//   planner  Planner::update, its background work excluded
//   plan     the search
//
// in CPU time of the thread, of: nothing changed, one cell, one near a corner, two near opposite
// corners, 16 and 256 anywhere, 0.1 % of all. The costs of the last path of each are compared with
// those of a planner made anew. Before these: the first of 100 plans on the new map with its
// preparation, the others, and the same plans once all is prepared.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "cpu_time.h"
#include "grid/map_differences.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/planners/planner_factory.h"

namespace {

using grid_path_planner::base::InputError;
using grid_path_planner::base::numberFromText;
using grid_path_planner::base::Status;
using grid_path_planner::base::StopToken;
using grid_path_planner::benchmark::milliseconds;
using grid_path_planner::costmap::CostmapBuilder;
using grid_path_planner::costmap::CostmapOptions;
using grid_path_planner::costmap::Outside;
using grid_path_planner::grid::Cell;
using grid_path_planner::grid::CellRect;
using grid_path_planner::grid::copyCells;
using grid_path_planner::grid::differences;
using grid_path_planner::grid::DoubleBuffered;
using grid_path_planner::grid::GridGeometry;
using grid_path_planner::grid::OccupancyGrid;
using grid_path_planner::grid::readMapFile;
using grid_path_planner::planners::makePlanner;
using grid_path_planner::planners::Planner;
using grid_path_planner::planners::SearchRequest;
using grid_path_planner::planners::SearchResult;

struct Arguments {
  std::string map;
  std::string planner = "weighted_jump_point";
  int side = 1024;
  int rounds = 15;
  double radius = 6.0;
  double decay = 0.436;
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name.rfind("--", 0) != 0) {
      arguments.map = name;
      continue;
    }
    if (++i == argc) throw InputError(name + " needs a value");
    if (name == "--planner") {
      arguments.planner = argv[i];
      continue;
    }
    const double value = numberFromText(name, argv[i]);
    if (name == "--side")
      arguments.side = static_cast<int>(value);
    else if (name == "--rounds")
      arguments.rounds = static_cast<int>(value);
    else if (name == "--radius")
      arguments.radius = value;
    else if (name == "--decay")
      arguments.decay = value;
    else
      throw InputError("unknown option " + name);
  }
  if (arguments.map.empty()) throw InputError("which map?");
  return arguments;
}

OccupancyGrid repeated(const OccupancyGrid& map, int side) {
  OccupancyGrid all(GridGeometry(side, side, 1.0));
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      all[Cell{column, row}] = map[Cell{column % map.width(), row % map.height()}];
  return all;
}

double median(std::vector<double> times) {
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2),
                   times.end());
  return times[times.size() / 2];
}

double sum(const std::vector<double>& times) {
  return std::accumulate(times.begin(), times.end(), 0.0);
}

CostmapOptions costmapOptions(const Arguments& arguments) {
  CostmapOptions options;
  options.radius = arguments.radius;
  options.decay = arguments.decay;
  options.outside = Outside::FREE;
  return options;
}

// A map whose cells come and go, and what follows it.
class Robot {
 public:
  explicit Robot(const Arguments& arguments)
      : arguments_(arguments),
        received_(repeated(readMapFile(arguments.map), arguments.side)),
        builder_(costmapOptions(arguments)),
        planner_(makePlanner(arguments.planner, {})) {
    maps_.reset(std::make_unique<OccupancyGrid>(received_));
    builder_.setMap(maps_.current());
    std::printf("first costmap %.1f ms", milliseconds([&] { builder_.downsampled(StopToken()); }));
    std::printf(", preparation %.1f ms\n", milliseconds([&] {
                  planner_->prepare(builder_.downsampled(StopToken()), StopToken());
                }));
    chooseEnds();
  }

  // Between ends as far apart as those of the path, anywhere.
  void measurePlans() {
    const auto costs = builder_.downsampled(StopToken());
    std::vector<SearchRequest> requests;
    while (requests.size() < 100) {
      const Cell start = anywhere(), goal{start.column + 220, start.row + 200};
      if (costs->passable(start) && costs->passable(goal))
        requests.push_back({start, {goal}, false});
    }
    const auto planner = makePlanner(arguments_.planner, {});
    const double preparation = milliseconds([&] { planner->prepare(costs, StopToken()); });
    std::vector<double> before, after;
    for (const SearchRequest& request : requests)
      before.push_back(milliseconds([&] { planner->search(request, StopToken()); }));
    const double rest = milliseconds([&] { planner->finishBackgroundWork(StopToken()); });
    for (const SearchRequest& request : requests)
      after.push_back(milliseconds([&] { planner->search(request, StopToken()); }));
    const double first = before.front();
    std::printf(
        "first plan %.2f ms with preparation, plans 2 to 100 %.3f ms; all prepared in %.1f ms "
        "more, then %.3f ms a plan\n",
        preparation + first, (sum(before) - first) / 99.0, rest, sum(after) / 100.0);
  }

  void measure(const char* name, const std::function<std::vector<Cell>()>& choose) {
    std::vector<double> compare, costmap, planner, plan, all;
    for (int round = 0; round < arguments_.rounds; ++round) {
      for (const Cell cell : choose()) received_[cell] = received_[cell] == 100 ? 0 : 100;
      const std::uint64_t before = builder_.downsampledChanges().newest();
      compare.push_back(milliseconds([this] { compareMaps(); }));
      costmap.push_back(milliseconds([this] { builder_.downsampled(StopToken()); }));
      planner.push_back(milliseconds([this, before] {
        planner_->update(builder_.downsampled(StopToken()),
                         builder_.downsampledChanges().since(before).value().weights, StopToken());
      }));
      plan.push_back(milliseconds([this] { result_ = planner_->search(request_, StopToken()); }));
      all.push_back(compare.back() + costmap.back() + planner.back() + plan.back());
    }
    std::printf("%-14s%10.3f%10.3f%10.3f%10.3f%10.3f\n", name, median(compare), median(costmap),
                median(planner), median(plan), median(all));
    check();
  }

  std::vector<Cell> someCells(std::size_t count) {
    std::vector<Cell> cells;
    while (cells.size() < count) {
      const Cell cell = anywhere();
      if (!nearEnds(cell)) cells.push_back(cell);
    }
    return cells;
  }

  std::vector<Cell> corners(std::size_t count) {
    const int low = static_cast<int>(random_() % 40), high = arguments_.side - 1 - low;
    std::vector<Cell> cells = {{low, low}, {high, high}};
    cells.resize(count);
    return cells;
  }

 private:
  bool nearEnds(Cell cell) const {
    const int reach = 3 * static_cast<int>(arguments_.radius) + 3;
    const auto near = [&](Cell end) {
      return std::abs(cell.column - end.column) < reach && std::abs(cell.row - end.row) < reach;
    };
    return near(request_.start) || near(request_.goals.front());
  }

  Cell anywhere() {
    std::uniform_int_distribution<int> position(0, arguments_.side - 1);
    return {position(random_), position(random_)};
  }

  void chooseEnds() {
    const auto costs = builder_.downsampled(StopToken());
    for (int trial = 0; trial < 100000; ++trial) {
      const Cell start = anywhere(), goal{start.column + 220, start.row + 200};
      request_ = {start, {goal}, false};
      if (!costs->passable(start) || !costs->passable(goal)) continue;
      if (planner_->search(request_, StopToken()).status == Status::FOUND) return;
    }
    throw InputError("no path of 300 cells was found in this map");
  }

  void compareMaps() {
    const std::vector<CellRect> changed = differences(*maps_.current(), received_.values());
    if (changed.empty()) return;
    maps_.advance(changed, [&](OccupancyGrid& next) { copyCells(received_, changed, next); });
    builder_.updateMap(maps_.current(), changed);
  }

  void check() {
    CostmapBuilder builder(builder_.options());
    builder.setMap(maps_.current());
    const auto planner = makePlanner(arguments_.planner, {});
    planner->prepare(builder.downsampled(StopToken()), StopToken());
    const SearchResult fresh = planner->search(request_, StopToken());
    if (fresh.status == result_.status && fresh.cost == result_.cost) return;
    std::printf("THE COSTS DIFFER\n");
    std::exit(1);
  }

  Arguments arguments_;
  std::mt19937 random_{20261122};
  OccupancyGrid received_;
  DoubleBuffered<OccupancyGrid> maps_;
  CostmapBuilder builder_;
  std::unique_ptr<Planner> planner_;
  SearchRequest request_;
  SearchResult result_;
};

void run(const Arguments& arguments) {
  Robot robot(arguments);
  robot.measurePlans();
  const auto cells = static_cast<std::size_t>(arguments.side) * arguments.side;
  std::printf("%-14s%10s%10s%10s%10s%10s\n", "ms, median", "compare", "costmap", "planner", "plan",
              "all");
  const auto some = [&robot](std::size_t count) {
    return [&robot, count] { return robot.someCells(count); };
  };
  robot.measure("nothing", some(0));
  robot.measure("one cell", some(1));
  robot.measure("one corner", [&robot] { return robot.corners(1); });
  robot.measure("two corners", [&robot] { return robot.corners(2); });
  robot.measure("16 cells", some(16));
  robot.measure("256 cells", some(256));
  robot.measure("0.1 % of all", some(cells / 1000));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse(argc, argv));
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
