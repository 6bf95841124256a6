// grid_path scenarios: MovingAI queries, each cost compared with the file's.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <memory>
#include <sstream>

#include "arguments.h"
#include "commands.h"
#include "grid_path_planner/base/atomic_file.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/planners/catalogue.h"
#include "grid_path_planner/study/scenario_file.h"
#include "grid_path_planner/terrain/terrain.h"
#include "progress_bar.h"

namespace grid_path_planner::tools {
namespace {

namespace po = boost::program_options;

constexpr double kRelativeError = 1e-5;  // the files' costs are rounded

struct Totals {
  std::size_t queries = 0;
  std::size_t solved = 0;
  std::size_t wrong = 0;
  std::uint64_t expanded = 0;
  double time_s = 0.0;
};

po::options_description describe() {
  po::options_description known("Options");
  known.add_options()("scen", po::value<std::string>()->required(), "MovingAI scenario file")(
      "map", po::value<std::string>(), "map file; default: the one the scenario names, beside it")(
      "limit", po::value<std::int64_t>(), "how many queries, spread evenly over the file")(
      "csv", po::value<std::string>(), "write a line a query");
  describePlannerOptions(known);
  return known;
}

std::string besideFile(const std::string& file, const std::string& name) {
  const std::size_t slash = file.rfind('/');
  const std::size_t base = name.rfind('/');
  return (slash == std::string::npos ? "" : file.substr(0, slash + 1)) +
         (base == std::string::npos ? name : name.substr(base + 1));
}

std::size_t limitOf(const po::variables_map& values) {
  if (values.count("limit") == 0) return 0;
  const auto limit = values["limit"].as<std::int64_t>();
  if (limit < 1) throw InputError("--limit must be at least 1");
  return static_cast<std::size_t>(limit);
}

std::string csvLine(const ScenarioQuery& query, const PlanResult& result, bool wrong) {
  std::ostringstream out;
  out.precision(12);
  out << query.start.column << ',' << query.start.row << ',' << query.goal.column << ','
      << query.goal.row << ',' << toString(result.status) << ',' << result.costValue() << ','
      << query.optimum << ',' << wrong << ',' << result.cells.size() << ','
      << result.statistics.expanded << ',' << result.statistics.generated << ','
      << result.statistics.time_s * 1e3 << ',' << result.statistics.search_bytes << '\n';
  return out.str();
}

}  // namespace

int runScenarios(int argc, char** argv) {
  po::variables_map values;
  if (!parseArguments(argc, argv, describe(), "grid_path scenarios --scen FILE [options]", values))
    return 0;
  const std::string file = values["scen"].as<std::string>();
  const PlannerOptions options = plannerOptionsFrom(values);
  const std::vector<ScenarioQuery> all = readScenarioFile(file);
  const std::vector<ScenarioQuery> queries = spreadOver(all, limitOf(values));
  const std::string map_file = values.count("map") != 0 ? values["map"].as<std::string>()
                                                        : besideFile(file, all.front().map);

  Terrain terrain(options.terrain);
  terrain.setMap(std::make_shared<const OccupancyGrid>(readMapFile(map_file)));
  const auto begin = std::chrono::steady_clock::now();
  const std::shared_ptr<const CostGrid> map = terrain.searched(StopToken());
  const std::unique_ptr<Planner> planner = makePlanner(options.planner, options.search);
  planner->prepare(map, StopToken());
  const std::chrono::duration<double> preparation = std::chrono::steady_clock::now() - begin;

  Totals totals;
  std::string csv =
      "start_x,start_y,goal_x,goal_y,status,cost,optimum,wrong,cells,expanded,generated,time_ms,"
      "search_bytes\n";
  ProgressBar bar(queries.size());
  for (const ScenarioQuery& query : queries) {
    checkScenarioQuery(query, terrain.fine(StopToken())->geometry(), file);
    const PlanResult result = planner->plan({query.start, {query.goal}}, StopToken());
    const bool solved = result.status == Status::FOUND;
    const bool wrong =
        !solved || std::abs(result.costValue() - query.optimum) > kRelativeError * query.optimum;
    ++totals.queries;
    totals.solved += solved ? 1 : 0;
    totals.wrong += wrong ? 1 : 0;
    totals.expanded += result.statistics.expanded;
    totals.time_s += result.statistics.time_s;
    csv += csvLine(query, result, wrong);
    bar.done(totals.queries);
  }
  if (values.count("csv") != 0) writeFileAtomically(values["csv"].as<std::string>(), csv);

  std::printf("map=%s planner=%s preparation_ms=%.3f\n", map_file.c_str(), options.planner.c_str(),
              preparation.count() * 1e3);
  std::printf("queries=%zu solved=%zu wrong=%zu total_s=%.6f mean_ms=%.6f expanded=%llu\n",
              totals.queries, totals.solved, totals.wrong, totals.time_s,
              totals.time_s * 1e3 / static_cast<double>(totals.queries),
              static_cast<unsigned long long>(totals.expanded));
  return totals.wrong > 0 && planner->optimalFor(*map) ? 1 : 0;
}

}  // namespace grid_path_planner::tools
