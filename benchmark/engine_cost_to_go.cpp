// The whole map's cost-to-go, for benchmark/engine_table.
//
//   grid_path_planner_engine_cost_to_go [--goal X,Y] [--threads N] [--side CELLS] [--weights KIND]
//                                       [--write-costs FILE]
//
//     --weights KIND       what c is, of which a cell weighs 50 + 0.8 c, as navfn weighs a costmap_2d's
//                          cells. noise (default): random from 0 to 252; smooth: waves of 400 cells;
//                          uniform: 0; with every twentieth cell blocked. open: 0, none blocked.
//                          one: as uniform, but all weigh 1
//     --write-costs FILE   writes c, or 254 where blocked, as an 8-bit PGM, and computes nothing
//
// Prints "nanoseconds N labelled L reachable R bytes B", R counted by a search that knows no costs.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <random>
#include <string>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/planners/reachable_cells.h"
#include "planners/tables/cost_to_go.h"

namespace {

using namespace grid_path_planner::base;
using namespace grid_path_planner::costmap;
using namespace grid_path_planner::grid;
using namespace grid_path_planner::planners;
using Clock = std::chrono::steady_clock;

constexpr int kLethal = 254, kMost = 252;

using Arguments = std::map<std::string, std::string>;

Arguments argumentsFrom(int argc, char** argv) {
  Arguments values = {{"--goal", "2048,2048"},
                      {"--threads", "1"},
                      {"--side", "4096"},
                      {"--weights", "noise"},
                      {"--write-costs", ""}};
  for (int i = 1; i + 1 < argc; i += 2) values.at(argv[i]) = argv[i + 1];
  return values;
}

Cell cellFrom(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) throw InputError("--goal must be X,Y, got '" + text + "'");
  return {static_cast<int>(numberFromText("--goal", text.substr(0, comma))),
          static_cast<int>(numberFromText("--goal", text.substr(comma + 1)))};
}

int costAt(const std::string& kind, Cell cell, unsigned random) {
  if (kind == "noise") return static_cast<int>(random % (kMost + 1));
  if (kind != "smooth") return 0;
  constexpr double kPerCell = 2.0 * M_PI / 400.0;
  return static_cast<int>(0.25 * kMost *
                          (2.0 + std::sin(kPerCell * cell.column) + std::sin(kPerCell * cell.row)));
}

// The goal's neighbourhood is free.
Grid<std::uint8_t> costsOf(const std::string& kind, int side, Cell goal) {
  Grid<std::uint8_t> costs(GridGeometry(side, side, 1.0));
  std::mt19937 random(1);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const bool blocked = kind != "open" && random() % 20 == 0;
      const int cost = blocked ? kLethal : costAt(kind, {column, row}, random());
      costs[Cell{column, row}] = static_cast<std::uint8_t>(cost);
    }
  for (int row = goal.row - 2; row <= goal.row + 2; ++row)
    for (int column = goal.column - 2; column <= goal.column + 2; ++column)
      if (costs.contains({column, row})) costs[Cell{column, row}] = 0;
  return costs;
}

std::shared_ptr<const CostGrid> mapOf(const Grid<std::uint8_t>& costs, bool one) {
  Grid<CostGrid::Weight> weights(costs.geometry());
  std::transform(costs.values().begin(), costs.values().end(), weights.values().begin(),
                 [one](std::uint8_t cost) {
                   const int weight = cost == kLethal ? 0 : one ? 1 : 50 + cost * 4 / 5;
                   return static_cast<CostGrid::Weight>(weight);
                 });
  Grid<Occupancy> classes(costs.geometry(), Occupancy::FREE);
  return std::make_shared<const CostGrid>(std::move(weights), std::move(classes), MotionModel());
}

void writeCosts(const Grid<std::uint8_t>& costs, const std::string& file) {
  std::ofstream out(file, std::ios::binary);
  out << "P5\n" << costs.width() << ' ' << costs.height() << "\n255\n";
  out.write(reinterpret_cast<const char*>(costs.values().data()),
            static_cast<std::streamsize>(costs.values().size()));
  if (!out.flush()) throw InputError(file, "cannot be written");
}

void compute(const Arguments& arguments, const Grid<std::uint8_t>& costs, Cell goal) {
  const auto map = mapOf(costs, arguments.at("--weights") == "one");
  const auto threads = static_cast<int>(numberFromText("--threads", arguments.at("--threads")));
  const Clock::time_point begin = Clock::now();
  const CostToGo field(map, {goal}, threads, StopToken());
  const auto time = std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin);
  std::size_t labelled = 0, reachable = 0;
  const auto reached = reachableFrom(*map, goal, StopToken());
  for (std::uint32_t i = 0; i < reached.size(); ++i) {
    reachable += reached[i] != 0 ? 1 : 0;
    labelled += field.reached(map->geometry().cell(CellIndex(i))) ? 1 : 0;
  }
  std::printf("nanoseconds %lld labelled %zu reachable %zu bytes %zu\n",
              static_cast<long long>(time.count()), labelled, reachable, field.bytes());
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments arguments = argumentsFrom(argc, argv);
  const Cell goal = cellFrom(arguments.at("--goal"));
  const auto side = static_cast<int>(numberFromText("--side", arguments.at("--side")));
  const auto costs = costsOf(arguments.at("--weights"), side, goal);
  if (!arguments.at("--write-costs").empty())
    writeCosts(costs, arguments.at("--write-costs"));
  else
    compute(arguments, costs, goal);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
