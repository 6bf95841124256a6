// The time of every query of a MovingAI scenario file, for benchmark/engine_table.
//
//   grid_path_planner_engine_queries --scen FILE --map FILE --planner NAME[:HEURISTIC] [options]
//
//     --limit N            queries, spread evenly over the file
//     --radius R --decay D inflation of the map, in cells and 1/cells (inflation_weight 40)
//     --weights KIND       inflated: by the distance to obstacles (default)
//                          noise: 1 to 40, random in every passable cell
//                          costmap: as navfn sees the cost map, 50 + 0.8 x (0 to 252)
//     --write-costs FILE   the same map as costmap_2d has it (0 to 252, 254 blocked), an 8-bit PGM
//     --lazily yes         nothing is waited for before the first query
//     --rounds N           the planners take turns N times in this process, all queries at a time
//     --fresh N            with --rounds: every N queries a planner is made anew, whose preparation
//                          counts; nothing is waited for
//     --idle yes           with --rounds: idle time after each query, as in a node, whose CPU time of the process
//                          stands apart
//     --list all           prints the planners, the heuristics and the default planner instead
//
// What a planner makes in the background is waited for. Prints "map", "planner" and, a line each,
// "query INDEX NANOSECONDS STATUS COST EXPANDED": CPU time of search() alone. NAME may be repeated by commas;
// the planners take turns, all queries at a time. With --rounds a planner's lines are "round ROUND NANOSECONDS" of
// all queries, and a query's time is the least of its rounds.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/planning/path_planner.h"
#include "grid_path_planner/study/scenario_file.h"

namespace {

using grid_path_planner::base::choiceFromName;
using grid_path_planner::base::InputError;
using grid_path_planner::base::numberFromText;
using grid_path_planner::base::StopToken;
using grid_path_planner::costmap::CostGrid;
using grid_path_planner::costmap::CostmapBuilder;
using grid_path_planner::costmap::CostmapOptions;
using grid_path_planner::costmap::Outside;
using grid_path_planner::grid::Cell;
using grid_path_planner::grid::CellRect;
using grid_path_planner::grid::Grid;
using grid_path_planner::grid::GridGeometry;
using grid_path_planner::grid::OccupancyGrid;
using grid_path_planner::grid::readMapFile;
using grid_path_planner::planners::BackgroundWork;
using grid_path_planner::planners::Heuristic;
using grid_path_planner::planners::makePlanner;
using grid_path_planner::planners::Planner;
using grid_path_planner::planners::plannerNames;
using grid_path_planner::planners::SearchOptions;
using grid_path_planner::planners::SearchResult;
using grid_path_planner::planning::PlannerOptions;
using grid_path_planner::study::readScenarioFile;
using grid_path_planner::study::ScenarioQuery;
using grid_path_planner::study::spreadOver;
using Clock = std::chrono::steady_clock;

constexpr int kInflationWeight = 40;
constexpr int kMostCost = 252;       // of a passable cell in a costmap_2d
constexpr int kLethalCost = 254;     // of a blocked one
constexpr int kNeutralCost = 50;     // what navfn adds
constexpr double kCostFactor = 0.8;  // and what it multiplies by

class Arguments {
 public:
  Arguments(int argc, char** argv) {
    for (int i = 1; i < argc; i += 2) {
      if (i + 1 == argc) throw InputError(std::string(argv[i]) + " needs a value");
      values_[argv[i]] = argv[i + 1];
    }
  }
  std::string text(const std::string& name, const std::string& otherwise = "") const {
    const auto found = values_.find(name);
    return found == values_.end() ? otherwise : found->second;
  }
  double number(const std::string& name) const { return numberFromText(name, text(name, "0")); }

 private:
  std::map<std::string, std::string> values_;
};

// 0 to 252 for 1 to the inflation weight, as costmap_2d scales it.
int costOf(CostGrid::Weight weight) {
  if (weight == CostGrid::kBlocked) return kLethalCost;
  return static_cast<int>(std::lround(kMostCost * (weight - 1.0) / (kInflationWeight - 1.0)));
}

std::shared_ptr<const CostGrid> inflated(const Arguments& arguments) {
  const auto map = std::make_shared<const OccupancyGrid>(readMapFile(arguments.text("--map")));
  CostmapOptions options;
  options.radius = arguments.number("--radius") * map->geometry().resolution();
  options.decay = arguments.number("--decay") / map->geometry().resolution();
  options.inflation_weight = kInflationWeight;
  options.outside = Outside::FREE;
  CostmapBuilder builder(options);
  builder.setMap(map);
  return builder.downsampled(StopToken());
}

std::shared_ptr<const CostGrid> withWeights(const CostGrid& map, const std::string& kind) {
  Grid<CostGrid::Weight> weights = map.weights();
  std::mt19937 random(20261121);
  std::uniform_int_distribution<int> noise(1, kInflationWeight);
  for (auto& weight : weights.values()) {
    if (weight == CostGrid::kBlocked) continue;
    const int value = kind == "noise" ? noise(random)
                      : kind == "costmap"
                          ? kNeutralCost + static_cast<int>(kCostFactor * costOf(weight))
                          : weight;
    weight = static_cast<CostGrid::Weight>(value);
  }
  return std::make_shared<const CostGrid>(std::move(weights), map.classes(), map.motion());
}

void writeCosts(const CostGrid& map, const std::string& file) {
  std::ofstream out(file, std::ios::binary);
  out << "P5\n" << map.geometry().width() << ' ' << map.geometry().height() << "\n255\n";
  for (const CostGrid::Weight weight : map.weights().values())
    out.put(static_cast<char>(costOf(weight)));
  if (!out.flush()) throw InputError(file, "cannot be written");
}

std::unique_ptr<Planner> plannerOf(const std::string& subject) {
  SearchOptions options;
  const std::size_t colon = subject.find(':');
  if (colon != std::string::npos)
    options.heuristic = choiceFromName<Heuristic>("--planner", subject.substr(colon + 1));
  return makePlanner(subject.substr(0, colon), options);
}

// CPU time of this thread: the machine may be shared.
long long threadNanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec * 1000000000LL + now.tv_nsec;
}

double millisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// The median of what nine small changes of the map cost the planner.
double repairMilliseconds(Planner& planner, std::shared_ptr<const CostGrid>& map) {
  std::vector<double> times;
  std::mt19937 random(7);
  for (int i = 0; i < 9; ++i) {
    const GridGeometry& geometry = map->geometry();
    const CellRect changed = CellRect{static_cast<int>(random() % geometry.width()),
                                      static_cast<int>(random() % geometry.height()), 9, 9}
                                 .intersection(geometry.rect());
    Grid<CostGrid::Weight> weights = map->weights();
    for (int row = changed.row; row < changed.row + changed.height; ++row)
      for (int column = changed.column; column < changed.column + changed.width; ++column) {
        auto& weight = weights[Cell{column, row}];
        weight = weight == CostGrid::kBlocked ? map->minWeight() : CostGrid::kBlocked;
      }
    auto next = std::make_shared<CostGrid>(std::move(weights), map->classes(), map->motion());
    next->setRevision(map->revision() + 1);
    map = std::move(next);
    const auto begin = Clock::now();
    planner.update(map, {changed}, StopToken());
    planner.finishBackgroundWork(StopToken());
    times.push_back(millisecondsSince(begin));
  }
  std::nth_element(times.begin(), times.begin() + 4, times.end());
  return times[4];
}

void run(const Arguments& arguments, const std::string& subject,
         std::shared_ptr<const CostGrid> map, const std::vector<ScenarioQuery>& queries) {
  const std::unique_ptr<Planner> planner = plannerOf(subject);
  const auto begin = Clock::now();
  planner->prepare(map, StopToken());
  const double prepared = millisecondsSince(begin);
  const bool lazily = !arguments.text("--lazily").empty();
  if (!lazily) planner->finishBackgroundWork(StopToken());
  const double finished = millisecondsSince(begin);
  const BackgroundWork tables = planner->backgroundWork();
  std::size_t search_bytes = 0;
  std::ostringstream lines;
  lines.precision(17);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const long long before = threadNanoseconds();
    const SearchResult result =
        planner->search({queries[i].start, {queries[i].goal}, false}, StopToken());
    const long long taken = threadNanoseconds() - before;
    search_bytes = std::max(search_bytes, result.statistics.search_bytes);
    lines << "query " << i << ' ' << taken << ' ' << toString(result.status) << ' '
          << result.costValue() << ' ' << result.statistics.expanded << '\n';
  }
  std::cout << "planner " << subject << " prepare_ms " << prepared << " repair_ms "
            << repairMilliseconds(*planner, map) << " search_bytes " << search_bytes
            << " tables_ms " << tables.time_s * 1e3 << " table_bytes " << tables.bytes
            << " optimal " << planner->optimalFor(*map) << " finished_ms " << finished << '\n'
            << lines.str();
}

// A planner that takes turns with others.
struct Turn {
  std::string subject;
  std::unique_ptr<Planner> planner;
  double prepare_ms = 0, finished_ms = 0;
  double idle_ms = 0;  // CPU time of the process
  std::vector<long long> rounds;
  std::vector<long long> least;  // of each query
  std::vector<SearchResult> results;
};

// Makes the planner anew. Returns the CPU time of its preparation.
long long makeAnew(Turn& turn, const std::shared_ptr<const CostGrid>& map, bool wait) {
  turn.planner = plannerOf(turn.subject);
  const auto begin = Clock::now();
  const long long before = threadNanoseconds();
  turn.planner->prepare(map, StopToken());
  const long long taken = threadNanoseconds() - before;
  turn.prepare_ms = millisecondsSince(begin);
  if (wait) turn.planner->finishBackgroundWork(StopToken());
  turn.finished_ms = millisecondsSince(begin);
  return taken;
}

void giveIdleTime(Turn& turn) {
  const std::clock_t begin = std::clock();
  turn.planner->finishBackgroundWork(StopToken());
  turn.idle_ms += 1e3 * double(std::clock() - begin) / CLOCKS_PER_SEC;
}

void ask(Turn& turn, std::size_t i, const ScenarioQuery& query, long long prepared) {
  const long long before = threadNanoseconds();
  SearchResult result = turn.planner->search({query.start, {query.goal}, false}, StopToken());
  const long long taken = threadNanoseconds() - before + prepared;
  turn.rounds.back() += taken;
  turn.least[i] = std::min(turn.least[i], taken);
  turn.results[i] = std::move(result);
}

void print(const Turn& turn) {
  std::cout << "planner " << turn.subject << " prepare_ms " << turn.prepare_ms << " finished_ms "
            << turn.finished_ms << " idle_ms " << turn.idle_ms << '\n';
  for (std::size_t i = 0; i < turn.rounds.size(); ++i)
    std::cout << "round " << i << ' ' << turn.rounds[i] << '\n';
  for (std::size_t i = 0; i < turn.least.size(); ++i)
    std::cout << "query " << i << ' ' << turn.least[i] << ' ' << toString(turn.results[i].status)
              << ' ' << turn.results[i].costValue() << ' ' << turn.results[i].statistics.expanded
              << '\n';
}

void runInTurns(const Arguments& arguments, const std::vector<std::string>& subjects,
                const std::shared_ptr<const CostGrid>& map,
                const std::vector<ScenarioQuery>& queries) {
  const auto rounds = static_cast<std::size_t>(arguments.number("--rounds"));
  const auto fresh = static_cast<std::size_t>(arguments.number("--fresh"));
  const bool idle = !arguments.text("--idle").empty();
  std::vector<Turn> turns(subjects.size());
  for (std::size_t i = 0; i < turns.size(); ++i) {
    turns[i].subject = subjects[i];
    turns[i].least.assign(queries.size(), std::numeric_limits<long long>::max());
    turns[i].results.resize(queries.size());
    makeAnew(turns[i], map, fresh == 0);
  }
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < turns.size(); ++k) {
      Turn& turn = turns[(k + round) % turns.size()];
      turn.rounds.push_back(0);
      for (std::size_t i = 0; i < queries.size(); ++i) {
        const bool anew = fresh > 0 && i % fresh == 0;
        ask(turn, i, queries[i], anew ? makeAnew(turn, map, false) : 0);
        if (idle) giveIdleTime(turn);
      }
    }
  }
  std::cout.precision(17);
  for (const Turn& turn : turns) print(turn);
}

int list() {
  std::cout << "planners";
  for (const std::string& name : plannerNames()) std::cout << ' ' << name;
  std::cout << "\nheuristics";
  for (const auto& choice : choicesOf(Heuristic{})) std::cout << ' ' << choice.first;
  std::cout << "\ndefault " << PlannerOptions().planner << '\n';
  return 0;
}

int runAll(const Arguments& arguments) {
  if (!arguments.text("--list").empty()) return list();
  const auto inflated_map = inflated(arguments);
  const auto map = withWeights(*inflated_map, arguments.text("--weights", "inflated"));
  if (!arguments.text("--write-costs").empty())
    writeCosts(*inflated_map, arguments.text("--write-costs"));
  const std::vector<ScenarioQuery> queries =
      spreadOver(readScenarioFile(arguments.text("--scen")),
                 static_cast<std::size_t>(arguments.number("--limit")));
  std::cout << "map cells " << map->geometry().size() << " min weight " << map->minWeight() << '\n';
  std::istringstream names(arguments.text("--planner"));
  std::vector<std::string> subjects;
  for (std::string subject; std::getline(names, subject, ',');) subjects.push_back(subject);
  if (arguments.number("--rounds") > 0)
    runInTurns(arguments, subjects, map, queries);
  else
    for (const std::string& subject : subjects) run(arguments, subject, map, queries);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return runAll(Arguments(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "engine_queries: " << error.what() << '\n';
    return 2;
  }
}
