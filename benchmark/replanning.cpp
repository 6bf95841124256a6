// Replanning while driving: update, inflation and plan after a sensed change, against a fresh A*.
//
//   grid_path_planner_replanning [--side N] [--edits N] [--seed N] [--rounds N] [--planner PLANNER]
//                                [--against PLANNER] [--csv FILE]
//
// A vehicle drives along its path over a map of blocks, posts and unknown patches, inflated by six
// cells and a decay back to free over ten. At every edit an obstacle appears or vanishes within its
// sensor's range, some of them on the path ahead. Timed together: taking the change into the map,
// CostmapBuilder, update() and search() of incremental_a_star or another planner, which does its
// background work between edits, timed by itself; against it the search() alone, on the same map, of
// a_star (octile) or another planner, which has made all that it prepares and is asked for another goal
// between edits, so that it keeps no tree. Every cost is compared, exactly. The first tree, and those after
// the ends were swapped, are told apart. The whole drive is repeated, the same to the last cell (counters
// decide, never a clock), and the least of each time counts: a machine that is busy now and then disturbs
// little. Prints percentiles and ratios, and how many edits took too long in each round by itself; exit code
// 1 where a cost differs. Times are of the thread.
#include <ctime>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/grid/double_buffered.h"
#include "grid_path_planner/planners/planner_factory.h"

namespace {

using grid_path_planner::base::Status;
using grid_path_planner::base::StopToken;
using grid_path_planner::costmap::CostmapBuilder;
using grid_path_planner::costmap::CostmapOptions;
using grid_path_planner::costmap::Outside;
using grid_path_planner::grid::Cell;
using grid_path_planner::grid::CellRect;
using grid_path_planner::grid::copyCells;
using grid_path_planner::grid::DoubleBuffered;
using grid_path_planner::grid::GridGeometry;
using grid_path_planner::grid::OccupancyGrid;
using grid_path_planner::planners::makePlanner;
using grid_path_planner::planners::Planner;
using grid_path_planner::planners::SearchResult;

constexpr int kSensorRange = 60;  // cells
constexpr int kClearOfEnds = 20;  // cells between an obstacle and the vehicle or the goal
constexpr int kLongestSide = 10;  // of an obstacle, cells
constexpr int kBorder = 40;       // of the map, free for the ends

double threadMicroseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

template <class Action>
double timed(Action&& action) {
  const double begin = threadMicroseconds();
  action();
  return threadMicroseconds() - begin;
}

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  int operator()(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
  }

 private:
  std::mt19937 random_;
};

void fill(OccupancyGrid& map, const CellRect& rect, std::int8_t value) {
  const CellRect inside = rect.intersection(map.geometry().rect());
  for (int row = inside.row; row < inside.row + inside.height; ++row)
    std::fill_n(map.row(row) + inside.column, inside.width, value);
}

OccupancyGrid world(int side, Draw& draw) {
  OccupancyGrid map(GridGeometry(side, side, 0.1), 0);
  const int scale = side * side / 40000;
  const auto scatter = [&](int number, int shortest, int longest, std::int8_t value) {
    for (int i = 0; i < number; ++i)
      fill(map, {draw(0, side), draw(0, side), draw(shortest, longest), draw(shortest, longest)},
           value);
  };
  scatter(scale, 20, 60, -1);
  scatter(3 * scale, 8, 60, 100);
  scatter(2 * scale, 1, 3, 100);
  fill(map, {0, 0, kBorder, kBorder}, 0);
  fill(map, {side - kBorder, side - kBorder, kBorder, kBorder}, 0);
  return map;
}

CostmapOptions inflated() {
  CostmapOptions options;
  options.radius = 0.6;
  options.decay = std::log(78.0) / 1.0;  // 1/m: a half above free one metre beyond the radius
  options.outside = Outside::FREE;
  return options;
}

int apart(Cell a, Cell b) {
  return std::max(std::abs(a.column - b.column), std::abs(a.row - b.row));
}

struct Edit {
  CellRect rect;
  bool appears = false;
};

// What a sensor sees come and go around the vehicle.
class Sensor {
 public:
  Sensor(const OccupancyGrid& world, Draw& draw) : world_(world), draw_(draw) {}

  Edit next(const std::vector<Cell>& path, Cell vehicle, Cell goal) {
    const auto near = std::find_if(seen_.begin(), seen_.end(), [&](const CellRect& rect) {
      return apart({rect.column, rect.row}, vehicle) < kSensorRange && draw_(0, 1) == 0;
    });
    if (near != seen_.end()) {
      const CellRect rect = *near;
      seen_.erase(near);
      return {rect, false};
    }
    while (true) {
      Cell at{vehicle.column + draw_(-kSensorRange, kSensorRange),
              vehicle.row + draw_(-kSensorRange, kSensorRange)};
      if (draw_(0, 2) == 0)
        at = path[std::min<std::size_t>(path.size() - 1, draw_(0, kSensorRange))];
      const CellRect rect =
          CellRect{at.column, at.row, draw_(1, kLongestSide), draw_(1, kLongestSide)}.intersection(
              world_.geometry().rect());
      const CellRect kept = rect.grown(kClearOfEnds);
      if (rect.empty() || kept.contains(vehicle) || kept.contains(goal)) continue;
      seen_.push_back(rect);
      return {rect, true};
    }
  }

 private:
  const OccupancyGrid& world_;
  Draw& draw_;
  std::vector<CellRect> seen_;
};

double percentile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// Of one edit, in microseconds.
struct Times {
  double update = 0.0;
  double plan = 0.0;
  double idle = 0.0;
  double fresh = 0.0;
  std::uint64_t expanded = 0;
  std::uint64_t fresh_expanded = 0;

  double replan() const { return update + plan; }
  bool tooLong() const { return replan() > 1.2 * fresh + 50.0; }
};

Times leastOf(const Times& a, const Times& b) {
  return {std::min(a.update, b.update),
          std::min(a.plan, b.plan),
          std::min(a.idle, b.idle),
          std::min(a.fresh, b.fresh),
          a.expanded,
          a.fresh_expanded};
}

long numberTooLong(const std::vector<Times>& all) {
  return std::count_if(all.begin(), all.end(), [](const Times& each) { return each.tooLong(); });
}

struct Arguments {
  int side = 2000;
  int edits = 1000;
  unsigned seed = 2;
  int rounds = 3;
  std::string planner = "incremental_a_star";
  std::string against = "a_star";
  std::string csv;
};

class Run {
 public:
  explicit Run(const Arguments& arguments)
      : arguments_(arguments),
        draw_(arguments.seed),
        world_(world(arguments.side, draw_)),
        sensor_(world_, draw_),
        builder_(inflated()),
        replanner_(makePlanner(arguments.planner, {})),
        vehicle_{kBorder / 2, kBorder / 2},
        goal_{arguments.side - kBorder / 2, arguments.side - kBorder / 2},
        fresh_(makePlanner(arguments.against, {})) {
    maps_.reset(std::make_unique<OccupancyGrid>(world_));
    builder_.setMap(maps_.current());
    const auto costs = builder_.downsampled(StopToken());
    for (Planner* planner : {replanner_.get(), fresh_.get()}) {
      planner->prepare(costs, StopToken());
      planner->finishBackgroundWork(StopToken());
    }
  }

  // One drive; ends the program where a cost is wrong.
  std::vector<Times> drive() {
    std::vector<Times> all;
    trees_.push_back(timed([this] { plan(); }));
    for (int edit = 0; edit < arguments_.edits; ++edit) {
      advance();
      Times times;
      times.update = timed([this] { takeEdit(); });
      times.plan = timed([this] { plan(); });
      times.idle = timed([this] { replanner_->finishBackgroundWork(StopToken()); });
      SearchResult fresh;
      readyFresh();
      times.fresh = timed([&, this] {
        fresh = fresh_->search({vehicle_, {goal_}, false}, StopToken());
      });
      if (fresh.status != result_.status || fresh.cost != result_.cost) {
        std::printf("edit %d: THE COSTS DIFFER\n", edit);
        std::exit(1);
      }
      times.expanded = result_.statistics.expanded;
      times.fresh_expanded = fresh.statistics.expanded;
      all.push_back(times);
    }
    return all;
  }

  // Microseconds of the plans that begin a tree: the first, and one for each swap of the ends.
  const std::vector<double>& trees() const { return trees_; }

 private:
  // Along the path, so that it arrives with the last edit; back again if it is there.
  void advance() {
    const std::size_t step =
        std::max<std::size_t>(1, 3 * static_cast<std::size_t>(arguments_.side) / 2 /
                                     static_cast<std::size_t>(arguments_.edits));
    if (result_.cells.size() <= 2 * kClearOfEnds) {
      std::swap(goal_, other_end_);
      trees_.push_back(timed([this] { plan(); }));
    }
    vehicle_ = result_.cells[std::min(step, result_.cells.size() - 1)];
    edit_ = sensor_.next(result_.cells, vehicle_, goal_);
  }

  void takeEdit() {
    maps_.advance({edit_.rect}, [this](OccupancyGrid& next) {
      edit_.appears ? fill(next, edit_.rect, 100) : copyCells(world_, edit_.rect, next);
    });
    const std::uint64_t before = builder_.downsampledChanges().newest();
    builder_.updateMap(maps_.current(), {edit_.rect});
    const auto costs = builder_.downsampled(StopToken());
    changed_ = builder_.downsampledChanges().since(before).value().weights;
    replanner_->update(costs, changed_, StopToken());
  }

  void readyFresh() {
    fresh_->search({vehicle_, {{goal_.column - 1, goal_.row}}, false}, StopToken());
    fresh_->update(builder_.downsampled(StopToken()), changed_, StopToken());
    fresh_->finishBackgroundWork(StopToken());
  }

  void plan() {
    result_ = replanner_->search({vehicle_, {goal_}, false}, StopToken());
    if (result_.status == Status::FOUND) return;
    std::printf("%s: another seed, please\n", result_.message.c_str());
    std::exit(2);
  }

  Arguments arguments_;
  Draw draw_;
  OccupancyGrid world_;
  Sensor sensor_;
  CostmapBuilder builder_;
  DoubleBuffered<OccupancyGrid> maps_;
  std::vector<CellRect> changed_;  // of the costmap, by the last edit
  std::unique_ptr<Planner> replanner_;
  Cell vehicle_;
  Cell goal_;
  std::unique_ptr<Planner> fresh_;
  Cell other_end_{kBorder / 2, kBorder / 2};
  Edit edit_;
  SearchResult result_;
  std::vector<double> trees_;
};

void print(const Arguments& arguments, const std::vector<Times>& all) {
  std::vector<double> updates, replans, idle, fresh;
  double largest = 0.0;
  for (const Times& each : all) {
    updates.push_back(each.update);
    replans.push_back(each.replan());
    idle.push_back(each.idle);
    fresh.push_back(each.fresh);
    largest = std::max(largest, each.replan() / each.fresh);
  }
  const double mean_fresh = mean(fresh);
  std::printf("%d edits on %dx%d, seed %u, every cost the same; the least of %d rounds\n",
              arguments.edits, arguments.side, arguments.side, arguments.seed, arguments.rounds);
  std::printf("fresh %s: mean %.0f us, median %.0f us, last %.0f us\n", arguments.against.c_str(),
              mean_fresh, percentile(fresh, 0.5), fresh.back());
  std::printf("update and inflation: median %.0f us, p99 %.0f us, longest %.0f us\n",
              percentile(updates, 0.5), percentile(updates, 0.99), percentile(updates, 1.0));
  std::printf(
      "with replanning: median %.0f us, p99 %.0f us (%.3f of the mean fresh), longest %.0f us\n",
      percentile(replans, 0.5), percentile(replans, 0.99), percentile(replans, 0.99) / mean_fresh,
      percentile(replans, 1.0));
  std::printf("background work: mean %.0f us, p99 %.0f us\n", mean(idle), percentile(idle, 0.99));
  std::printf("largest ratio to its own fresh search %.2f; above 1.2 x + 50 us: %ld\n", largest,
              numberTooLong(all));
}

void write(const std::string& file, const std::vector<Times>& all) {
  std::ofstream csv(file);
  csv << "edit,update_us,replan_us,idle_us,fresh_us,expanded,fresh_expanded\n";
  for (std::size_t edit = 0; edit < all.size(); ++edit) {
    const Times& each = all[edit];
    csv << edit << ',' << each.update << ',' << each.plan << ',' << each.idle << ',' << each.fresh
        << ',' << each.expanded << ',' << each.fresh_expanded << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    if (name == "--side") arguments.side = std::atoi(argv[i + 1]);
    if (name == "--edits") arguments.edits = std::atoi(argv[i + 1]);
    if (name == "--seed") arguments.seed = static_cast<unsigned>(std::atoi(argv[i + 1]));
    if (name == "--rounds") arguments.rounds = std::max(1, std::atoi(argv[i + 1]));
    if (name == "--planner") arguments.planner = argv[i + 1];
    if (name == "--against") arguments.against = argv[i + 1];
    if (name == "--csv") arguments.csv = argv[i + 1];
  }
  std::vector<Times> least;
  for (int round = 0; round < arguments.rounds; ++round) {
    Run run(arguments);
    const std::vector<Times> all = run.drive();
    std::printf("round %d: above 1.2 x + 50 us: %ld; %zu trees were begun, in up to %.0f us\n",
                round + 1, numberTooLong(all), run.trees().size(), percentile(run.trees(), 1.0));
    if (round == 0) least = all;
    std::transform(all.begin(), all.end(), least.begin(), least.begin(), leastOf);
  }
  print(arguments, least);
  if (!arguments.csv.empty()) write(arguments.csv, least);
  return 0;
}
