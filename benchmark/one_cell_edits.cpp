// What a search takes after one cell changed, while a vehicle drives to one goal across a city.
//
//   grid_path_planner_one_cell_edits [--side N] [--edits N] [--seed N] [--planner NAME] [--kind KIND] [--stay] [--pause MS]
//
// The city of benchmark/node_latency: blocks between streets of 1.5 m, cells of 0.05 m, radius 0.3 m, decay 3
// per metre. The vehicle moves by 15 cells along its path between edits, but with --stay, and each edit
// toggles one cell: in turn anywhere, in the middle of the path, near the vehicle and near the goal. --kind
// takes one of them only ("anywhere", "middle", "vehicle", "goal"), or "near": within 60 cells of the
// vehicle, a third of them on the path. Between edits the planner does its background work, with --pause for
// so many milliseconds of the clock at most. Prints, for each kind, means of the CPU time of the thread, in
// ms: of Planner::update(), of the search and of the background work; and who answered. Every cost is
// compared with that of A* made for the map; exit code 1 where one differs. The first two edits are not
// counted: no planner knows yet that the goal stays. The path of A* decides where edits are, so that all
// planners meet the same.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "cpu_time.h"
#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/grid/double_buffered.h"
#include "grid_path_planner/planners/planner_factory.h"

namespace {

using grid_path_planner::base::Stopped;
using grid_path_planner::base::StopSource;
using grid_path_planner::base::StopToken;
using grid_path_planner::benchmark::milliseconds;
using grid_path_planner::costmap::CostGrid;
using grid_path_planner::costmap::CostmapBuilder;
using grid_path_planner::costmap::CostmapOptions;
using grid_path_planner::grid::Cell;
using grid_path_planner::grid::CellRect;
using grid_path_planner::grid::DoubleBuffered;
using grid_path_planner::grid::GridGeometry;
using grid_path_planner::grid::OccupancyGrid;
using grid_path_planner::planners::Heuristic;
using grid_path_planner::planners::makePlanner;
using grid_path_planner::planners::Planner;
using grid_path_planner::planners::SearchOptions;
using grid_path_planner::planners::SearchResult;

constexpr int kStreet = 30, kBlock = 90;  // cells
constexpr int kEnd = 12;                  // from the map's corner to an end of the path
constexpr std::size_t kStride = 15;       // of the vehicle between edits
constexpr int kNear = 60;                 // of an edit near the vehicle
constexpr int kClear = 20;                // between the vehicle and an edit
constexpr int kNotCounted = 2;            // first edits

struct Arguments {
  int side = 1024;
  int edits = 42;
  unsigned seed = 1;
  std::string planner = "weighted_jump_point";
  bool stay = false;
  std::string kind;
  double pause = -1.0;
};

int between(std::mt19937& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
}

OccupancyGrid city(int side) {
  OccupancyGrid map(GridGeometry(side, side, 0.05), 0);
  std::mt19937 random(20261122);
  for (int row = kStreet; row < side - kStreet; row += kBlock + kStreet)
    for (int column = kStreet; column < side - kStreet; column += kBlock + kStreet) {
      const int width = between(random, kBlock / 2, kBlock);
      const int height = between(random, kBlock / 2, kBlock);
      for (int i = row; i < std::min(row + height, side - kStreet); ++i)
        std::fill_n(map.row(i) + column, std::min(width, side - kStreet - column), 100);
    }
  return map;
}

CostmapOptions inflated() {
  CostmapOptions options;
  options.radius = 0.3;
  options.decay = 3.0;
  options.outside = grid_path_planner::costmap::Outside::FREE;
  return options;
}

SearchOptions blocks() {
  SearchOptions options;
  options.heuristic = Heuristic::BLOCKS;
  return options;
}

int apart(Cell a, Cell b) {
  return std::max(std::abs(a.column - b.column), std::abs(a.row - b.row));
}

struct Times {
  int edits = 0;
  double update = 0.0, search = 0.0, longest = 0.0, idle = 0.0;

  void add(double updating, double searching, double idling) {
    ++edits;
    update += updating;
    search += searching;
    longest = std::max(longest, searching);
    idle += idling;
  }
};

class Drive {
 public:
  explicit Drive(const Arguments& arguments)
      : arguments_(arguments),
        random_(arguments.seed),
        vehicle_{kEnd, kEnd},
        goal_{arguments.side - 1 - kEnd, arguments.side - 1 - kEnd},
        builder_(inflated()),
        planner_(makePlanner(arguments.planner, {})),
        a_star_(makePlanner("a_star", blocks())) {
    maps_.reset(std::make_unique<OccupancyGrid>(city(arguments.side)));
    builder_.setMap(maps_.current());
    for (Planner* planner : {planner_.get(), a_star_.get()})
      planner->prepare(builder_.downsampled(StopToken()), StopToken());
    plan(*planner_);
    rest();
    path_ = plan(*a_star_).cells;
  }

  void edit(int number) {
    const char* kinds[] = {"anywhere", "middle", "vehicle", "goal"};
    const std::string kind = !arguments_.kind.empty() ? arguments_.kind : kinds[number % 4];
    const std::uint64_t before = builder_.downsampledChanges().newest();
    toggle(cellOf(kind));
    const auto costs = builder_.downsampled(StopToken());
    const auto changed = builder_.downsampledChanges().since(before).value().weights;
    SearchResult result;
    const double update = milliseconds([&] { planner_->update(costs, changed, StopToken()); });
    const double search = milliseconds([&] { result = plan(*planner_); });
    const double idle = milliseconds([this] { rest(); });
    a_star_->update(costs, changed, StopToken());
    check(result, plan(*a_star_));
    if (number >= kNotCounted) times_[kind].add(update, search, idle);
    if (number >= kNotCounted) ++answers_[result.answered_by];
    if (!arguments_.stay) vehicle_ = path_[std::min(kStride, path_.size() - 1)];
    path_ = plan(*a_star_).cells;
  }

  void print() const {
    for (const auto& [kind, times] : times_)
      std::printf("%-9s%4d edits: update %.2f, search %.3f (longest %.2f), background %.1f ms\n",
                  kind.c_str(), times.edits, times.update / times.edits, times.search / times.edits,
                  times.longest, times.idle / times.edits);
    for (const auto& [planner, number] : answers_)
      std::printf("%s answered %d\n", planner.c_str(), number);
  }

 private:
  SearchResult plan(Planner& planner) {
    return planner.search({vehicle_, {goal_}, false}, StopToken());
  }

  void rest() {
    try {
      planner_->finishBackgroundWork(pauseToken());
    } catch (const Stopped&) {
    }
  }

  StopToken pauseToken() const {
    if (arguments_.pause < 0.0) return StopToken();
    return StopSource().token(std::chrono::duration<double>(1e-3 * arguments_.pause));
  }

  Cell cellOf(const std::string& kind) {
    const int length = static_cast<int>(path_.size());
    const auto along = [&](int at) { return path_[std::clamp(at, 0, length - 1)]; };
    if (kind == "middle") return along(length * between(random_, 30, 70) / 100);
    if (kind == "vehicle") return along(between(random_, kClear, kNear));
    if (kind == "goal") return along(length - 1 - between(random_, kClear, kNear));
    const CellRect map{0, 0, arguments_.side, arguments_.side};
    while (true) {
      Cell cell{between(random_, 0, map.width - 1), between(random_, 0, map.height - 1)};
      if (kind == "near")
        cell = between(random_, 0, 2) == 0 ? along(between(random_, kClear, kNear))
                                           : Cell{vehicle_.column + between(random_, -kNear, kNear),
                                                  vehicle_.row + between(random_, -kNear, kNear)};
      if (map.contains(cell) && apart(cell, vehicle_) >= kClear && apart(cell, goal_) >= kClear)
        return cell;
    }
  }

  void toggle(Cell cell) {
    const CellRect rect{cell.column, cell.row, 1, 1};
    maps_.advance({rect}, [cell](OccupancyGrid& map) { map[cell] = map[cell] == 100 ? 0 : 100; });
    builder_.updateMap(maps_.current(), {rect});
  }

  // Ends the program where the planner is wrong, or nothing is left to measure.
  void check(const SearchResult& result, const SearchResult& reference) {
    if (result.status != reference.status || result.cost != reference.cost) {
      std::printf("THE COSTS DIFFER\n");
      std::exit(1);
    }
    path_ = reference.cells;
    if (!path_.empty()) return;
    std::printf("%s: another seed, please\n", result.message.c_str());
    std::exit(2);
  }

  Arguments arguments_;
  std::mt19937 random_;
  Cell vehicle_, goal_;
  DoubleBuffered<OccupancyGrid> maps_;
  CostmapBuilder builder_;
  std::unique_ptr<Planner> planner_, a_star_;
  std::vector<Cell> path_;
  std::map<std::string, Times> times_;
  std::map<std::string, int> answers_;
};

Arguments parsed(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const auto value = [&] { return ++i < argc ? argv[i] : ""; };
    if (name == "--side") arguments.side = std::atoi(value());
    if (name == "--edits") arguments.edits = std::atoi(value());
    if (name == "--seed") arguments.seed = static_cast<unsigned>(std::atoi(value()));
    if (name == "--planner") arguments.planner = value();
    if (name == "--kind") arguments.kind = value();
    if (name == "--pause") arguments.pause = std::atof(value());
    if (name == "--stay") arguments.stay = true;
  }
  return arguments;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = parsed(argc, argv);
  Drive drive(arguments);
  for (int number = 0; number < arguments.edits; ++number) drive.edit(number);
  drive.print();
  return 0;
}
