// The published tables of the rectangle map, again, on this project's own drawings.
//
//   grid_path_planner_rectangle_tables MAPS_FOLDER [PICTURES_FOLDER]
//
// MAPS_FOLDER holds indoor, campus, complex and simple.yaml. Prints Markdown: free cells and
// rectangles at growing resolutions beside the published counts, bytes in every form, and
// elements, connections, times and lengths of planning on cells and on rectangles. Lengths are in
// cells; times are of the thread's CPU, the least of several. Writes pictures if asked to. Exit
// code 1 where planners disagree about whether there is a path, or a path is shorter than the
// shortest.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "grid_path_planner/path/path_image.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "planners/any_angle/polyanya.h"
#include "planners/rectangles/rectangle_map_planner.h"
#include "rectangle_sizes_report.h"

namespace {

using grid_path_planner::base::Status;
using grid_path_planner::base::StopToken;
using grid_path_planner::benchmark::costmapOf;
using grid_path_planner::benchmark::Drawing;
using grid_path_planner::benchmark::kCampus;
using grid_path_planner::benchmark::kComplex;
using grid_path_planner::benchmark::kIndoor;
using grid_path_planner::benchmark::kSimple;
using grid_path_planner::benchmark::printBytes;
using grid_path_planner::benchmark::printCounts;
using grid_path_planner::benchmark::rectanglesOf;
using grid_path_planner::benchmark::render;
using grid_path_planner::costmap::Connectivity;
using grid_path_planner::costmap::CostGrid;
using grid_path_planner::grid::Cell;
using grid_path_planner::grid::OccupancyGrid;
using grid_path_planner::path::PictureContent;
using grid_path_planner::path::writePicture;
using grid_path_planner::planners::makePlanner;
using grid_path_planner::planners::Planner;
using grid_path_planner::planners::Polyanya;
using grid_path_planner::planners::RectangleMapPlanner;
using grid_path_planner::planners::RectangleWeight;
using grid_path_planner::planners::SearchOptions;
using grid_path_planner::planners::SearchResult;

bool failed = false;

// ---- Planning

double threadMilliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Query {
  Cell start;
  Cell goal;
};

Cell nearestFree(const CostGrid& map, double x, double y) {
  std::optional<Cell> nearest;
  double least = 0.0;
  for (int row = 0; row < map.geometry().height(); ++row)
    for (int column = 0; column < map.geometry().width(); ++column) {
      const Cell cell{column, row};
      const double distance = (map.geometry().centre(cell) - Eigen::Vector2d(x, y)).norm();
      if (!map.passable(cell) || (nearest && distance >= least)) continue;
      nearest = cell;
      least = distance;
    }
  return nearest.value();
}

// The path across the map, and pairs of free cells drawn at random.
std::vector<Query> queriesOn(const CostGrid& map, const Drawing& drawing) {
  constexpr int kRandom = 100;
  std::vector<Query> queries = {{nearestFree(map, drawing.from_x, drawing.from_y),
                                 nearestFree(map, drawing.to_x, drawing.to_y)}};
  std::mt19937 random(20261121);
  const auto draw = [&] {
    while (true) {
      const Cell cell{static_cast<int>(random() % unsigned(map.geometry().width())),
                      static_cast<int>(random() % unsigned(map.geometry().height()))};
      if (map.passable(cell)) return cell;
    }
  };
  for (int i = 0; i < kRandom; ++i) {
    const Cell start = draw();
    queries.push_back({start, draw()});
  }
  return queries;
}

struct Contender {
  std::string name;
  std::string planner;
  SearchOptions options;
  Connectivity connectivity = Connectivity::EIGHT;
};

struct Measured {
  double prepare_ms = 0.0;
  std::size_t elements = 0;
  std::size_t connections = 0;
  std::vector<double> lengths;  // cells; of each query, -1 where there is no path
  std::vector<double> plan_ms;
  std::size_t expanded = 0;  // for the path across the map
};

// Pairs of free cells that share a side.
std::size_t sharedSides(const CostGrid& map) {
  std::size_t sides = 0;
  for (int row = 0; row < map.geometry().height(); ++row)
    for (int column = 0; column < map.geometry().width(); ++column) {
      const Cell cell{column, row}, east{column + 1, row}, north{column, row + 1};
      if (!map.passable(cell)) continue;
      sides += map.geometry().contains(east) && map.passable(east) ? 1 : 0;
      sides += map.geometry().contains(north) && map.passable(north) ? 1 : 0;
    }
  return sides;
}

// What the planner searches: polyanya cuts rectangles of its own.
void count(const Planner& planner, const CostGrid& map, Measured& measured) {
  if (const auto* mesh = dynamic_cast<const Polyanya*>(&planner)) {
    measured.elements = mesh->mesh().rectangles();
    measured.connections = mesh->mesh().borders() / 2;
  } else if (const auto* rectangles = dynamic_cast<const RectangleMapPlanner*>(&planner)) {
    measured.elements = rectangles->rectangles().count();
    measured.connections = rectangles->rectangles().connections().count() / 2;
  } else {
    const auto& weights = map.weights().values();
    measured.elements = weights.size() - static_cast<std::size_t>(std::count(
                                             weights.begin(), weights.end(), CostGrid::kBlocked));
    measured.connections = sharedSides(map);
  }
}

Measured measure(const Contender& contender, const OccupancyGrid& map,
                 const std::vector<Query>& queries) {
  constexpr int kRounds = 7;
  const auto costmap = costmapOf(map, contender.connectivity);
  costmap->bitMaps(StopToken());
  const std::unique_ptr<Planner> planner = makePlanner(contender.planner, contender.options);
  Measured measured;
  for (int round = 0; round < kRounds; ++round) {
    const double begin = threadMilliseconds();
    planner->prepare(costmap, StopToken());
    const double taken = threadMilliseconds() - begin;
    measured.prepare_ms = round == 0 ? taken : std::min(measured.prepare_ms, taken);
  }
  count(*planner, *costmap, measured);
  for (const Query& query : queries) {
    SearchResult result;
    double least = 0.0;
    for (int round = 0; round < kRounds; ++round) {
      const double begin = threadMilliseconds();
      result = planner->search({query.start, {query.goal}}, StopToken());
      const double taken = threadMilliseconds() - begin;
      least = round == 0 ? taken : std::min(least, taken);
    }
    if (measured.lengths.empty()) measured.expanded = result.statistics.expanded;
    measured.plan_ms.push_back(least);
    measured.lengths.push_back(result.status == Status::FOUND ? result.costValue() : -1.0);
  }
  return measured;
}

Contender dijkstraOnCells() {
  return {"Dijkstra on cells, 4-connected", "dijkstra", {}, Connectivity::FOUR};
}

std::vector<Contender> gridContenders() {
  return {dijkstraOnCells(), {"`jump_point`", "jump_point", {}}, {"`anya`", "anya", {}}};
}

std::vector<Contender> rectangleContenders() {
  std::vector<Contender> contenders;
  for (const auto& [name, weight] : choicesOf(RectangleWeight{})) {
    contenders.push_back({std::string("`rectangle_map` ") + name, "rectangle_map", {}});
    contenders.back().options.rectangle_weight = weight;
  }
  contenders.push_back({"`polyanya`", "polyanya", {}});
  return contenders;
}

// The same through the middles of the borders, as published, instead of pulled taut.
Contender throughTheMiddles(Contender contender) {
  contender.options.rectangle_funnel = false;
  return contender;
}

// Over the queries that have a path.
double meanOf(const std::vector<double>& values, const Measured& measured) {
  double sum = 0.0;
  int number = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (measured.lengths[i] >= 0.0) {
      sum += values[i];
      ++number;
    }
  return sum / std::max(1, number);
}

// The mean of length over the shortest.
double meanExcess(const Measured& measured, const Measured& shortest) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < measured.lengths.size(); ++i) {
    if ((measured.lengths[i] < 0.0) != (shortest.lengths[i] < 0.0)) failed = true;
    if (measured.lengths[i] < shortest.lengths[i] - 1e-9) failed = true;
    ratios.push_back(shortest.lengths[i] > 0.0 ? measured.lengths[i] / shortest.lengths[i] : 1.0);
  }
  return meanOf(ratios, measured);
}

// How many plans (of the mean time) the preparation and the plans take less time from than those of
// `other`.
std::string breakEven(const Measured& measured, const Measured& other) {
  const double saved = meanOf(other.plan_ms, other) - meanOf(measured.plan_ms, measured);
  const double spent = measured.prepare_ms - other.prepare_ms;
  if (saved <= 0.0) return "never";
  return std::to_string(std::max(0L, static_cast<long>(spent / saved)) + 1);
}

void printPlanning(const std::string& folder, const Drawing& drawing, int cells,
                   const std::vector<Contender>& contenders) {
  const OccupancyGrid map = render(folder, drawing, cells);
  const auto costmap = costmapOf(map);
  const std::vector<Query> queries = queriesOn(*costmap, drawing);
  const Measured shortest = measure({"", "anya", {}}, map, queries);

  std::printf("### %s, %d×%d\n\n", drawing.name, cells, cells);
  std::printf(
      "| | elements | connections | prepared | across: expanded | time | prepared and planned once "
      "| ahead of Dijkstra from plan | length | through the middles | 100 pairs: mean time | "
      "length "
      "÷ shortest | through the middles "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  const Measured cells_searched = measure(dijkstraOnCells(), map, queries);
  for (const Contender& contender : contenders) {
    const Measured measured = measure(contender, map, queries);
    std::printf("| %s | %zu | %zu | %.3f ms | %zu | %.1f µs | %.3f ms | %s | %.1f | ",
                contender.name.c_str(), measured.elements, measured.connections,
                measured.prepare_ms, measured.expanded, 1e3 * measured.plan_ms.front(),
                measured.prepare_ms + measured.plan_ms.front(),
                contender.planner == "dijkstra" ? "" : breakEven(measured, cells_searched).c_str(),
                measured.lengths.front());
    std::optional<Measured> plain;
    if (contender.planner == "rectangle_map")
      plain = measure(throughTheMiddles(contender), map, queries);
    if (plain) std::printf("%.1f", plain->lengths.front());
    std::printf(" | %.1f µs | %.3f | ", 1e3 * meanOf(measured.plan_ms, measured),
                meanExcess(measured, shortest));
    if (plain) std::printf("%.3f", meanExcess(*plain, shortest));
    std::printf(" |\n");
  }
  std::printf("\n");
}

void drawRectangleMap(const std::string& file, const std::string& folder, const Drawing& drawing,
                      int cells) {
  const OccupancyGrid map = render(folder, drawing, cells);
  PictureContent content;
  content.rectangles = rectanglesOf(map).rectangles();
  writePicture(file, map, {}, content);
}

void printAll(const std::string& folder) {
  std::printf("## Growth with resolution\n\nIndoor:\n\n");
  printCounts(folder, kIndoor, {{16, 153, 25}, {32, 562, 44}, {64, 2325, 86}, {128, 9331, 156}});
  std::printf("Outdoor (campus):\n\n");
  printCounts(folder, kCampus,
              {{20, 292, 53}, {40, 1240, 154}, {80, 4859, 302}, {160, 19397, 552}});
  std::printf("## Bytes\n\nIndoor:\n\n");
  printBytes(folder, kIndoor);
  std::printf("Outdoor (campus):\n\n");
  printBytes(folder, kCampus);

  std::printf("## Planning\n\n");
  std::vector<Contender> all = gridContenders();
  const std::vector<Contender> on_rectangles = rectangleContenders();
  all.insert(all.end(), on_rectangles.begin(), on_rectangles.end());
  for (const Drawing& drawing : {kIndoor, kCampus})
    for (const int cells : {64, 256}) printPlanning(folder, drawing, cells, all);
  std::printf("## The weights on a complex and a simple map\n\n");
  for (const Drawing& drawing : {kComplex, kSimple})
    for (const int cells : {64, 256}) printPlanning(folder, drawing, cells, on_rectangles);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: %s MAPS_FOLDER [PICTURES_FOLDER]\n", argv[0]);
    return 2;
  }
  try {
    printAll(argv[1]);
    if (argc == 3)
      for (const Drawing& drawing : {kIndoor, kCampus, kComplex, kSimple})
        drawRectangleMap(std::string(argv[2]) + "/rectangles_" + drawing.name + ".png", argv[1],
                         drawing, 64);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  if (failed) std::fprintf(stderr, "planners disagree about a path, or one is too short\n");
  return failed ? 1 : 0;
}
