// How time and memory grow with the map's side and with obstacle density, for every planner.
//
//   grid_path_planner_engine_growth [--sides 256,512,…] [--densities 0.05,0.1,…]
//       [--density-side 1024] [--planners a_star,…] [--weights uniform|rings] [--limit-s 60]
//       [--csv OUT] [--html OUT]
//   grid_path_planner_engine_growth --from CSV,CSV --html OUT    draws what such runs wrote
//
// Each planner plans from corner to corner among random rectangles (10 % of the area while the side
// grows), in a process of its own, so that its peak of memory is its own: of the whole process, the
// map and its making included. "rings" adds weights 1 to 40 that fall off around each rectangle, as
// inflation does. "second" is a query between neighbours in the middle of the map after that: it
// shows whether a query costs time proportional to the map. Prints Markdown, writes CSV and charts.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "engine_growth_report.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/planners/planner_factory.h"

namespace {

using grid_path_planner::base::InputError;
using grid_path_planner::base::numberFromText;
using grid_path_planner::base::Status;
using grid_path_planner::base::StopSource;
using grid_path_planner::base::StopToken;
using grid_path_planner::benchmark::Case;
using grid_path_planner::benchmark::csvOf;
using grid_path_planner::benchmark::Growth;
using grid_path_planner::benchmark::htmlOf;
using grid_path_planner::benchmark::partsOf;
using grid_path_planner::benchmark::print;
using grid_path_planner::benchmark::printHead;
using grid_path_planner::benchmark::readCsv;
using grid_path_planner::costmap::CostGrid;
using grid_path_planner::costmap::MotionModel;
using grid_path_planner::grid::Cell;
using grid_path_planner::grid::CellRect;
using grid_path_planner::grid::Grid;
using grid_path_planner::grid::GridGeometry;
using grid_path_planner::grid::Occupancy;
using grid_path_planner::planners::makePlanner;
using grid_path_planner::planners::plannerNames;
using grid_path_planner::planners::SearchRequest;
using grid_path_planner::planners::SearchResult;
using Clock = std::chrono::steady_clock;

constexpr double kUsualDensity = 0.1;
constexpr std::size_t kMemoryLimit = 8'000'000'000;  // with the map; planners that need more refuse
constexpr int kLargestObstacle = 32;                 // cells a side
constexpr int kFreeCorner = 40;                      // cells; so that both ends are in the open
constexpr int kRingWidth = 20;                       // cells
constexpr double kLong = 10.0;                       // s; a plan that is faster is measured again

struct Options {
  std::vector<double> sides = {256, 512, 1024, 2048, 4096, 8192, 16384};
  std::vector<double> densities = {0.02, 0.05, 0.1, 0.2, 0.3, 0.4};
  double density_side = 1024;
  std::vector<std::string> planners = plannerNames();
  std::string weights = "uniform";
  double limit_s = 60.0;
  std::string csv;
  std::string html;
  std::vector<std::string> from;
};

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Paints `rect` blocked, and around it what inflation would make of it.
void paint(Grid<CostGrid::Weight>& weights, const CellRect& rect, bool rings) {
  const CellRect around =
      rect.grown(rings ? kRingWidth : 0).intersection(weights.geometry().rect());
  for (int row = around.row; row < around.row + around.height; ++row)
    for (int column = around.column; column < around.column + around.width; ++column) {
      auto& weight = weights[Cell{column, row}];
      const int dx = std::max({rect.column - column, column - rect.column - rect.width + 1, 0});
      const int dy = std::max({rect.row - row, row - rect.row - rect.height + 1, 0});
      if (weight == CostGrid::kBlocked) continue;
      const double ring = 1.0 + 39.0 * std::exp(-std::max(dx, dy) / 4.0);
      weight = dx == 0 && dy == 0
                   ? CostGrid::kBlocked
                   : std::max(weight, static_cast<CostGrid::Weight>(std::lround(ring)));
    }
}

std::shared_ptr<const CostGrid> mapOf(const Case& which) {
  const GridGeometry geometry(which.side, which.side, 1.0);
  Grid<CostGrid::Weight> weights(geometry, 1);
  std::mt19937 random(20261121);
  const auto below = [&random](int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(limit));
  };
  // Rectangles lie over each other: this many cover the share `density`.
  const double mean_area = std::pow((kLargestObstacle + 1) / 2.0, 2);
  const auto count = static_cast<long>(-std::log(1.0 - which.density) *
                                       static_cast<double>(geometry.size()) / mean_area);
  for (long i = 0; i < count; ++i) {
    const CellRect rect{below(which.side), below(which.side), 1 + below(kLargestObstacle),
                        1 + below(kLargestObstacle)};
    const bool at_an_end = rect.column < kFreeCorner && rect.row < kFreeCorner;
    const bool at_the_other = rect.column + rect.width > which.side - kFreeCorner &&
                              rect.row + rect.height > which.side - kFreeCorner;
    if (!at_an_end && !at_the_other)
      paint(weights, rect.intersection(geometry.rect()), which.weights == "rings");
  }
  return std::make_shared<const CostGrid>(
      std::move(weights), Grid<Occupancy>(geometry, Occupancy::FREE), MotionModel());
}

// A passable cell near the middle whose right neighbour is passable too.
Cell middleOf(const CostGrid& map) {
  Cell cell{map.geometry().width() / 2, map.geometry().height() / 2};
  while (!map.passable(cell) || !map.passable({cell.column + 1, cell.row})) ++cell.column;
  return cell;
}

// In the child: what it measures, as text.
std::string measured(const Case& which, double limit_s) {
  const auto map = mapOf(which);
  const auto planner = makePlanner(which.planner);
  planner->limitMemory(kMemoryLimit - std::min(kMemoryLimit, map->bytes()));
  auto begin = Clock::now();
  planner->prepare(map, StopToken());
  planner->finishBackgroundWork(StopToken());
  const double prepare_s = secondsSince(begin);

  const SearchRequest across{{0, 0}, {{which.side - 1, which.side - 1}}, false};
  const Cell middle = middleOf(*map);
  const SearchRequest near{middle, {{middle.column + 1, middle.row}}, false};
  const StopSource stop;
  SearchResult result;
  double first_s = 0.0;
  double plan_s = std::numeric_limits<double>::max(), second_s = plan_s;
  for (int i = 0; i < 4; ++i) {  // another query in between, for planners that go on from the last
    result = planner->search(across, stop.token(std::chrono::duration<double>(limit_s)));
    plan_s = std::min(plan_s, result.statistics.time_s);
    if (i == 0) first_s = plan_s;
    second_s = std::min(second_s, planner->search(near, stop.token()).statistics.time_s);
    if (plan_s > kLong || result.status != Status::FOUND) break;
  }

  std::ostringstream out;
  out << toString(result.status) << ' ' << prepare_s << ' ' << first_s << ' ' << plan_s << ' '
      << second_s << ' ' << result.costValue() << ' ' << result.statistics.expanded << ' '
      << result.statistics.search_bytes << ' ' << result.message;
  return out.str();
}

// Measures in a child process, whose peak of memory the system tells when it ends.
Growth measure(const Case& which, double limit_s) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  std::cout.flush();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    std::string text = "failed 0 0 0 0 0 0 0 ";
    try {
      text = measured(which, limit_s);
    } catch (const std::exception& error) {
      text += error.what();
    }
    const bool written = write(ends[1], text.data(), text.size()) >= 0;
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  std::string text(4096, '\0');
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read(ends[0], &text[0], text.size()))));
  close(ends[0]);
  int code = 0;
  rusage usage{};
  wait4(child, &code, 0, &usage);

  Growth growth;
  growth.of = which;
  std::istringstream in(text);
  in >> growth.status >> growth.prepare_s >> growth.first_s >> growth.plan_s >> growth.second_s >>
      growth.cost >> growth.expanded >> growth.search_bytes >> std::ws;
  std::getline(in, growth.message);
  growth.peak_bytes = static_cast<double>(usage.ru_maxrss) * 1024.0;
  return growth;
}

void writeText(const std::string& file, const std::string& text) {
  if (file.empty()) return;
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw InputError(file, "cannot be written");
}

// A planner that took longer than the limit is not asked on a larger map.
std::vector<Growth> grow(const std::vector<Case>& cases, double limit_s) {
  std::vector<Growth> all;
  for (const Case& which : cases) {
    const bool gave_up = !all.empty() && all.back().of.planner == which.planner &&
                         all.back().status == "TIMEOUT" && all.back().of.side < which.side;
    if (gave_up) continue;
    all.push_back(measure(which, limit_s));
    print(std::cout, all.back());
  }
  return all;
}

std::vector<double> numbersOf(const std::string& name, const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : partsOf(text)) numbers.push_back(numberFromText(name, part));
  return numbers;
}

Options optionsFrom(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (i + 1 == argc) throw InputError(name + " needs a value");
    const std::string value = argv[i + 1];
    if (name == "--sides")
      options.sides = numbersOf(name, value);
    else if (name == "--densities")
      options.densities = numbersOf(name, value);
    else if (name == "--density-side")
      options.density_side = numberFromText(name, value);
    else if (name == "--planners")
      options.planners = partsOf(value);
    else if (name == "--weights" && (value == "uniform" || value == "rings"))
      options.weights = value;
    else if (name == "--limit-s")
      options.limit_s = numberFromText(name, value);
    else if (name == "--csv")
      options.csv = value;
    else if (name == "--html")
      options.html = value;
    else if (name == "--from")
      options.from = partsOf(value);
    else
      throw InputError("there is no " + name + " " + value);
  }
  return options;
}

void draw(const Options& options) {
  std::vector<Growth> by_side, by_density;
  for (const std::string& file : options.from)
    for (const Growth& growth : readCsv(file)) {
      if (growth.of.density == kUsualDensity) by_side.push_back(growth);
      if (growth.of.side == options.density_side) by_density.push_back(growth);
    }
  writeText(options.html, htmlOf(by_side, by_density, options.weights, options.density_side));
}

void run(const Options& options) {
  if (!options.from.empty()) return draw(options);
  std::vector<Case> by_side, by_density;
  for (const std::string& planner : options.planners) {
    for (const double side : options.sides)
      by_side.push_back({planner, static_cast<int>(side), kUsualDensity, options.weights});
    for (const double density : options.densities)
      by_density.push_back(
          {planner, static_cast<int>(options.density_side), density, options.weights});
  }
  printHead(std::cout);
  const std::vector<Growth> sides = grow(by_side, options.limit_s);
  printHead(std::cout);
  const std::vector<Growth> densities = grow(by_density, options.limit_s);
  std::vector<Growth> all = sides;
  all.insert(all.end(), densities.begin(), densities.end());
  writeText(options.csv, csvOf(all));
  writeText(options.html, htmlOf(sides, densities, options.weights, options.density_side));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(optionsFrom(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "engine_growth: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
