// grid_path scenarios: MovingAI queries, each cost compared with the file's, or with another
// planner's where inflation, weights or other steps make the file's optima wrong.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "command_line/path_hash.h"
#include "command_line/progress_bar.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/planning/smooth_result.h"
#include "grid_path_planner/planning/unused_options.h"
#include "grid_path_planner/ros/bag.h"
#include "grid_path_planner/study/scenario_file.h"

namespace grid_path_planner::command_line {

using base::InputError, base::Status, base::StopToken, base::writeFileAtomically;
using costmap::CostGrid, costmap::CostmapBuilder, costmap::CostmapOptions, costmap::MotionModel,
    costmap::Outside;
using grid::Cell, grid::GridGeometry, grid::OccupancyGrid;
using nodes::readAnyMapFile;
using planners::BackgroundWork, planners::makePlanner, planners::Planner, planners::PlannerTraits,
    planners::SearchRequest, planners::SearchResult;
using planning::changedOptions, planning::PlannerOptions, planning::smoothResult;
using study::checkScenarioQuery, study::readScenarioFile, study::ScenarioQuery, study::spreadOver;

namespace {

namespace po = boost::program_options;

constexpr double kRelativeError = 1e-5;  // the files' costs are sums of single precision
constexpr double kRounding = 1e-12;      // a planner's once, by exact integers
constexpr double kRootsRounding = 1e-9;

constexpr char kFile[] = "file";  // as reference: the file's own costs

struct Totals {
  std::size_t queries = 0;     // without the unsolvable ones
  std::size_t unsolvable = 0;  // there is no path, says the reference
  std::size_t solved = 0;
  std::size_t wrong = 0;
  std::uint64_t expanded = 0;
  double time_s = 0.0;
  double cost = 0.0;            // of the solved ones
  double reference_cost = 0.0;  // of the same

  double costOverReference() const { return reference_cost > 0.0 ? cost / reference_cost : 1.0; }

  void add(const SearchResult& result, double least) {
    if (result.status == Status::FOUND) {
      cost += result.costValue();
      reference_cost += least;
    }
    ++queries;
    solved += result.status == Status::FOUND ? 1 : 0;
    expanded += result.statistics.expanded;
    time_s += result.statistics.time_s;
  }
};

// Benchmark maps end where the queries' world ends: nothing is kept from their border. The costs of
// their files are those of paths over the grid.
PlannerOptions defaultOptions() {
  PlannerOptions options;
  options.costmap.outside = Outside::FREE;
  options.smooth = false;
  return options;
}

po::options_description scenariosOptions() {
  po::options_description known("Options");
  known.add_options()("scen", po::value<std::string>()->required(), "MovingAI scenario file")(
      "map", po::value<std::string>(), "map file; default: the one the scenario names, beside it")(
      "limit", po::value<std::int64_t>(), "how many queries, spread evenly over the file")(
      "csv", po::value<std::string>(), "write a line a query")(
      "hash-paths", "print a hash of every query's status, path and cost, before the last line")(
      "reference", po::value<std::string>(),
      "what costs are compared with: file, or a planner's answers; default: file where its optima "
      "hold, dijkstra where inflation, a kernel, weights or other steps change them");
  describePlannerOptions(known, defaultOptions());
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

// Whether the costs of scenario files are the least ones on a map that is made with these options.
bool fileOptimaHold(const CostmapOptions& costmap) {
  return costmap.radius == 0.0 && costmap.decay == 0.0 && costmap.kernel == 1 &&
         costmap.free_weight == 1 && costmap.motion == MotionModel();
}

// Queries are from cell to cell: options of poses and of the time around the search have no effect.
void warnAboutOptionsOfPoses(const PlannerOptions& options) {
  for (const std::string& name : changedOptions(options))
    for (const char* unused :
         {"tolerance", "start_escape_radius", "retry_finer", "timeout", "heading", "path_z",
          "fixed_z", "waypoint_tolerance", "waypoint_spacing"})
      if (name == unused) warnAboutUnusedOption(name, "scenarios");
}

std::string referenceNameOf(const po::variables_map& values, const CostmapOptions& costmap) {
  if (values.count("reference") != 0) return values["reference"].as<std::string>();
  return fileOptimaHold(costmap) ? kFile : "dijkstra";
}

// The query's cells, or their blocks on a map of a kernel.
SearchRequest requestOf(const ScenarioQuery& query, int kernel) {
  const auto block = [kernel](Cell cell) { return Cell{cell.column / kernel, cell.row / kernel}; };
  return {block(query.start), {block(query.goal)}, false};
}

// Throws InputError for an invalid request: a planner that refuses the map refuses every query.
SearchResult searchOrThrow(Planner& planner, const SearchRequest& request) {
  SearchResult result = planner.search(request, StopToken());
  if (result.status == Status::INVALID_REQUEST) throw InputError(result.message);
  return result;
}

// The least costs of the queries, from the scenario file or by a planner.
class Reference {
 public:
  // Throws InputError for a name that is neither "file" nor a planner's, and for a planner whose
  // costs cannot be compared with those of `judged`.
  Reference(const std::string& name, const std::shared_ptr<const CostGrid>& map,
            const PlannerTraits& judged)
      : name_(name), kernel_(map->kernel()) {
    if (name_ != kFile) planner_ = plannerNamed(name_);
    const bool any_angle = planner_ && planner_->traits().any_angle;
    if (any_angle && !judged.any_angle)
      throw InputError("--reference " + name_ +
                       " finds paths of any angle, which no path over the grid can be as short as");
    if (planner_ && !(any_angle ? planner_->traits().shortest : planner_->optimalFor(*map)))
      throw InputError("--reference " + name_ + " does not promise the least cost on this map");
    correct_ = any_angle == judged.any_angle && any_angle == judged.shortest ? Comparison::EQUAL
               : any_angle                                                   ? Comparison::NOT_LESS
                                                                             : Comparison::NOT_MORE;
    if (planner_) planner_->prepare(map, StopToken());
  }

  const std::string& name() const { return name_; }

  struct Cost {
    double value;
    double error;  // at most, up or down
  };

  // None where there is no path.
  std::optional<Cost> costOf(const ScenarioQuery& query) const {
    if (!planner_)
      return Cost{query.optimum, std::max(kRelativeError * query.optimum, query.rounding)};
    const SearchResult result = searchOrThrow(*planner_, requestOf(query, kernel_));
    if (result.status != Status::FOUND) return std::nullopt;
    // The lengths of any angle are sums of roots.
    const double relative = planner_->traits().any_angle ? kRootsRounding : kRounding;
    return Cost{result.costValue(), relative * result.costValue()};
  }

  bool contradicts(const SearchResult& result, const std::optional<Cost>& least) const {
    if ((result.status == Status::FOUND) != least.has_value()) return true;
    if (!least) return false;
    const double more = result.costValue() - least->value;
    return (correct_ != Comparison::NOT_MORE && more < -least->error) ||
           (correct_ != Comparison::NOT_LESS && more > least->error);
  }

 private:
  // How a correct cost compares: any-angle paths may cost less than paths over the grid.
  enum class Comparison { EQUAL, NOT_MORE, NOT_LESS };

  static std::unique_ptr<Planner> plannerNamed(const std::string& name) {
    try {
      return makePlanner(name);
    } catch (const InputError& error) {
      throw InputError(std::string("--reference must be file or a planner; ") + error.what());
    }
  }

  std::string name_;
  int kernel_;
  Comparison correct_;
  std::unique_ptr<Planner> planner_;  // none: the file
};

std::string csvLine(const ScenarioQuery& query, const SearchResult& result, double least,
                    bool wrong) {
  std::ostringstream out;
  out.precision(12);
  out << query.start.column << ',' << query.start.row << ',' << query.goal.column << ','
      << query.goal.row << ',' << toString(result.status) << ',' << result.costValue() << ','
      << least << ',' << wrong << ',' << result.cells.size() << ',' << result.statistics.expanded
      << ',' << result.statistics.generated << ',' << result.statistics.time_s * 1e3 << ','
      << result.statistics.search_bytes << '\n';
  return out.str();
}

// The map and the planner of a run, ready for queries.
struct PreparedPlanner {
  GridGeometry geometry;  // of the full map
  std::shared_ptr<const CostGrid> costs;
  std::unique_ptr<Planner> planner;
  double preparation_ms = 0.0;
};

PreparedPlanner prepare(const OccupancyGrid& map, const PlannerOptions& options) {
  PreparedPlanner prepared;
  prepared.geometry = map.geometry();
  CostmapBuilder builder(options.costmap);
  builder.setMap(std::make_shared<const OccupancyGrid>(map));
  const auto begin = std::chrono::steady_clock::now();
  prepared.costs = builder.downsampled(StopToken());
  prepared.planner = makePlanner(options.planner, options.search);
  prepared.planner->prepare(prepared.costs, StopToken());
  prepared.planner->finishBackgroundWork(StopToken());
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
  prepared.preparation_ms = time.count();
  return prepared;
}

// What all queries gave.
struct Results {
  Totals totals;
  PathHash paths;
  std::string csv =
      "start_x,start_y,goal_x,goal_y,status,cost,optimum,wrong,cells,expanded,generated,time_ms,"
      "search_bytes\n";

  void add(const ScenarioQuery& query, const SearchResult& result, const Reference& reference) {
    paths.add(result);
    const std::optional<Reference::Cost> least = reference.costOf(query);
    const bool wrong = reference.contradicts(result, least);
    totals.wrong += wrong ? 1 : 0;
    if (least)
      totals.add(result, least->value);
    else
      ++totals.unsolvable;
    if (least || wrong) csv += csvLine(query, result, least ? least->value : -1.0, wrong);
  }
};

Results runQueries(const std::vector<ScenarioQuery>& queries, const std::string& file,
                   const PreparedPlanner& prepared, bool smooth, const Reference& reference) {
  Results results;
  ProgressBar bar(queries.size());
  for (const ScenarioQuery& query : queries) {
    checkScenarioQuery(query, prepared.geometry, file);
    SearchResult result =
        searchOrThrow(*prepared.planner, requestOf(query, prepared.costs->kernel()));
    if (result.status == Status::FOUND && smooth)
      smoothResult(*prepared.costs, result, StopToken());
    results.add(query, result, reference);
    bar.done(results.totals.queries + results.totals.unsolvable);
  }
  return results;
}

void printTotals(const Totals& totals) {
  std::printf("queries=%zu solved=%zu wrong=%zu total_s=%.6f mean_ms=%.6f expanded=%llu\n",
              totals.queries, totals.solved, totals.wrong, totals.time_s,
              totals.time_s * 1e3 / static_cast<double>(std::max<std::size_t>(totals.queries, 1)),
              static_cast<unsigned long long>(totals.expanded));
}

std::string mapFileOf(const po::variables_map& values, const std::string& scenario_file,
                      const ScenarioQuery& query) {
  if (values.count("map") != 0) return values["map"].as<std::string>();
  return besideFile(scenario_file, query.map);
}

// The planner that answers, with `smooth` as one of any angle.
PlannerTraits judgedTraits(const PreparedPlanner& prepared, const PlannerOptions& options) {
  PlannerTraits judged = prepared.planner->traits();
  judged.any_angle |= options.smooth;
  return judged;
}

void printResults(const po::variables_map& values, const std::string& map_file,
                  const PlannerOptions& options, const PreparedPlanner& prepared,
                  const Reference& reference, const Results& results) {
  std::printf(
      "map=%s planner=%s smooth=%s preparation_ms=%.3f reference=%s unsolvable=%zu "
      "cost_over_reference=%.6f\n",
      map_file.c_str(), options.planner.c_str(), options.smooth ? "true" : "false",
      prepared.preparation_ms, reference.name().c_str(), results.totals.unsolvable,
      results.totals.costOverReference());
  const BackgroundWork work = prepared.planner->backgroundWork();
  if (work.bytes > 0)
    std::printf("background_ms=%.3f background_bytes=%zu\n", work.time_s * 1e3, work.bytes);
  if (values.count("hash-paths") != 0) std::printf("path_hash=%s\n", results.paths.text().c_str());
  printTotals(results.totals);
}

// Whether every path of the planner has the least cost, or is the shortest.
bool guarantees(const PreparedPlanner& prepared) {
  return prepared.planner->optimalFor(*prepared.costs) || prepared.planner->traits().shortest;
}

}  // namespace

int runScenarios(int argc, char** argv) {
  po::variables_map values;
  if (!parseArguments(argc, argv, scenariosOptions(), "grid_path scenarios --scen FILE [options]",
                      values))
    return 0;
  const std::string file = values["scen"].as<std::string>();
  const PlannerOptions options = plannerOptionsFrom(values, defaultOptions());
  warnAboutUnusedOptions(options, defaultOptions());
  warnAboutOptionsOfPoses(options);
  const std::vector<ScenarioQuery> all = readScenarioFile(file);
  const std::vector<ScenarioQuery> queries = spreadOver(all, limitOf(values));
  const std::string map_file = mapFileOf(values, file, all.front());

  const PreparedPlanner prepared =
      prepare(readAnyMapFile(map_file, readingOptionsFrom(values)), options);
  const Reference reference(referenceNameOf(values, options.costmap), prepared.costs,
                            judgedTraits(prepared, options));
  const Results results = runQueries(queries, file, prepared, options.smooth, reference);
  if (values.count("csv") != 0) writeFileAtomically(values["csv"].as<std::string>(), results.csv);
  printResults(values, map_file, options, prepared, reference, results);
  return results.totals.wrong > 0 && guarantees(prepared) ? 1 : 0;
}

}  // namespace grid_path_planner::command_line
