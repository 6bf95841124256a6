// Replanning on the way: update, inflation and plan after a sensed change, against a fresh A*.
//
//   grid_path_planner_replanning [--side N] [--edits N] [--seed N] [--csv FILE]
//
// A vehicle drives along its path over a map of blocks, posts and unknown patches, inflated by six
// cells and a decay back to free over ten. At every edit an obstacle appears or vanishes within its
// sensor's range, some of them on the path ahead. Timed together: taking the change into the map,
// Terrain, IncrementalAStar::update() and plan(); against it a_star's plan() alone, octile, on the
// same map. Every cost is compared, exactly. Prints percentiles and ratios; exit code 1 where a
// cost differs. Times are of the thread, so others may be at work on the machine.
#include <ctime>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "grid_path_planner/grid/map_turns.h"
#include "grid_path_planner/search/a_star.h"
#include "grid_path_planner/search/incremental_a_star.h"
#include "grid_path_planner/terrain/terrain.h"

namespace {

using namespace grid_path_planner;

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

TerrainOptions inflated() {
  TerrainOptions options;
  options.radius = 0.6;
  options.decay = std::log(78.0) / 1.0;  // 1/m: a half above free one metre beyond the radius
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

struct Arguments {
  int side = 2000;
  int edits = 1000;
  unsigned seed = 2;
  std::string csv;
};

class Run {
 public:
  explicit Run(const Arguments& arguments)
      : arguments_(arguments),
        draw_(arguments.seed),
        world_(world(arguments.side, draw_)),
        sensor_(world_, draw_),
        terrain_(inflated()),
        vehicle_{kBorder / 2, kBorder / 2},
        goal_{arguments.side - kBorder / 2, arguments.side - kBorder / 2} {
    maps_.begin(std::make_shared<OccupancyGrid>(world_));
    terrain_.setMap(maps_.current());
    const auto costs = terrain_.searched(StopToken());
    replanner_.prepare(costs, StopToken());
    a_star_.prepare(costs, StopToken());
  }

  // Whether every cost was right.
  bool drive() {
    std::ofstream csv;
    if (!arguments_.csv.empty()) csv.open(arguments_.csv);
    csv << "edit,update_us,replan_us,fresh_us,expanded,fresh_expanded\n";
    plan();
    for (int edit = 0; edit < arguments_.edits; ++edit) {
      advance();
      const double update = timed([this] { takeEdit(); });
      const double replan = timed([this] { plan(); });
      a_star_.update(terrain_.searched(StopToken()), terrain_.searchedChange(), StopToken());
      PlanResult fresh;
      const double fresh_time = timed([&] {
        fresh = a_star_.plan({vehicle_, {goal_}, false}, StopToken());
      });
      if (fresh.status != result_.status || fresh.cost != result_.cost) {
        std::printf("edit %d: THE COSTS DIFFER\n", edit);
        return false;
      }
      updates_.push_back(update);
      replans_.push_back(update + replan);
      fresh_.push_back(fresh_time);
      csv << edit << ',' << update << ',' << replan << ',' << fresh_time << ','
          << result_.statistics.expanded << ',' << fresh.statistics.expanded << '\n';
    }
    return true;
  }

  void print() const {
    const double fresh = mean(fresh_);
    double largest = 0.0;
    int too_long = 0;
    for (std::size_t i = 0; i < fresh_.size(); ++i) {
      largest = std::max(largest, replans_[i] / fresh_[i]);
      too_long += replans_[i] > 1.2 * fresh_[i] + 50.0 ? 1 : 0;
    }
    std::printf("%d edits on %dx%d, seed %u, every cost the same\n", arguments_.edits,
                arguments_.side, arguments_.side, arguments_.seed);
    std::printf("fresh A*: mean %.0f us, median %.0f us, last %.0f us\n", fresh,
                percentile(fresh_, 0.5), fresh_.back());
    std::printf("update and inflation: median %.0f us, p99 %.0f us, longest %.0f us\n",
                percentile(updates_, 0.5), percentile(updates_, 0.99), percentile(updates_, 1.0));
    std::printf(
        "with replanning: median %.0f us, p99 %.0f us (%.3f of the mean fresh), longest %.0f us\n",
        percentile(replans_, 0.5), percentile(replans_, 0.99), percentile(replans_, 0.99) / fresh,
        percentile(replans_, 1.0));
    std::printf("largest ratio to its own fresh search %.2f; above 1.2 x + 50 us: %d\n", largest,
                too_long);
  }

 private:
  // Along the path, so that it arrives with the last edit; back again if it is there.
  void advance() {
    const std::size_t step =
        std::max<std::size_t>(1, 3 * static_cast<std::size_t>(arguments_.side) / 2 /
                                     static_cast<std::size_t>(arguments_.edits));
    if (result_.cells.size() <= 2 * kClearOfEnds) {
      std::swap(goal_, other_end_);
      plan();
    }
    vehicle_ = result_.cells[std::min(step, result_.cells.size() - 1)];
    edit_ = sensor_.next(result_.cells, vehicle_, goal_);
  }

  void takeEdit() {
    maps_.advance(edit_.rect, [this](OccupancyGrid& next) {
      edit_.appears ? fill(next, edit_.rect, 100) : copyCells(world_, edit_.rect, next);
    });
    terrain_.updateMap(maps_.current(), edit_.rect);
    const auto costs = terrain_.searched(StopToken());
    replanner_.update(costs, terrain_.searchedChange(), StopToken());
  }

  void plan() {
    result_ = replanner_.plan({vehicle_, {goal_}, false}, StopToken());
    if (result_.status == Status::FOUND) return;
    std::printf("%s: another seed, please\n", result_.message.c_str());
    std::exit(2);
  }

  Arguments arguments_;
  Draw draw_;
  OccupancyGrid world_;
  Sensor sensor_;
  Terrain terrain_;
  MapTurns<OccupancyGrid> maps_;
  IncrementalAStar replanner_;
  AStar a_star_;
  Cell vehicle_;
  Cell goal_;
  Cell other_end_{kBorder / 2, kBorder / 2};
  Edit edit_;
  PlanResult result_;
  std::vector<double> updates_, replans_, fresh_;
};

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    if (name == "--side") arguments.side = std::atoi(argv[i + 1]);
    if (name == "--edits") arguments.edits = std::atoi(argv[i + 1]);
    if (name == "--seed") arguments.seed = static_cast<unsigned>(std::atoi(argv[i + 1]));
    if (name == "--csv") arguments.csv = argv[i + 1];
  }
  Run run(arguments);
  if (!run.drive()) return 1;
  run.print();
  return 0;
}
