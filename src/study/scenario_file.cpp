#include "grid_path_planner/study/scenario_file.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"

namespace grid_path_planner::study {

using base::dropByteOrderMark, base::InputError, base::readWholeFile;
using grid::GridGeometry;

namespace {

constexpr std::size_t kLargestScenarioFile = std::size_t{1} << 28;  // bytes

// How many decimals a number is printed with.
std::size_t decimalsOf(const std::string& number) {
  const std::size_t point = number.find('.');
  return point == std::string::npos ? 0 : number.size() - point - 1;
}

ScenarioQuery queryOf(const std::string& file, int line, const std::string& text) {
  ScenarioQuery query;
  query.line = line;
  std::istringstream parts(text);
  int bucket = 0;
  parts >> bucket >> query.map >> query.width >> query.height >> query.start.column >>
      query.start.row >> query.goal.column >> query.goal.row >> query.optimum;
  std::string rest;
  const bool complete = static_cast<bool>(parts) && !(parts >> rest);
  if (!complete || !std::isfinite(query.optimum) || query.optimum < 0.0)
    throw InputError(file, line,
                     "a query is 'bucket map width height start-x start-y goal-x goal-y "
                     "optimal-length', got '" +
                         text.substr(0, 80) + "'");
  return query;
}

}  // namespace

namespace {

std::vector<ScenarioQuery> queriesWithin(const std::string& file, base::ReadLimits& limits) {
  std::string content = readWholeFile(file, kLargestScenarioFile, limits);
  dropByteOrderMark(content);
  std::istringstream in(content);
  base::ReadPoll poll(limits, file);
  std::vector<ScenarioQuery> queries;
  int line = 0;
  std::size_t decimals = 0;
  for (std::string text; std::getline(in, text);) {
    ++line;
    text.erase(text.find_last_not_of(" \t\r") + 1);
    if (line == 1) {
      if (text.rfind("version", 0) != 0)
        throw InputError(file, line, "a scenario file begins with 'version 1'");
      continue;
    }
    if (text.empty()) continue;
    poll();
    limits.take(file, 2 * sizeof(ScenarioQuery) + text.size());  // the list grows by doubling
    queries.push_back(queryOf(file, line, text));
    decimals = std::max(decimals, decimalsOf(text.substr(text.find_last_of(" \t") + 1)));
  }
  if (queries.empty()) throw InputError(file, "has no queries");
  for (ScenarioQuery& query : queries) query.rounding = 0.5 * std::pow(10.0, -double(decimals));
  return queries;
}

}  // namespace

std::vector<ScenarioQuery> readScenarioFile(const std::string& file,
                                            const base::ReadLimits& limits) {
  return base::readWithin(file, limits,
                          [&](base::ReadLimits& within) { return queriesWithin(file, within); });
}

std::vector<ScenarioQuery> spreadOver(const std::vector<ScenarioQuery>& queries,
                                      std::size_t limit) {
  if (limit == 0 || limit >= queries.size()) return queries;
  std::vector<ScenarioQuery> chosen;
  for (std::size_t i = 0; i < limit; ++i) chosen.push_back(queries[i * queries.size() / limit]);
  return chosen;
}

void checkScenarioQuery(const ScenarioQuery& query, const GridGeometry& geometry,
                        const std::string& file) {
  if (query.width == geometry.width() && query.height == geometry.height()) return;
  throw InputError(file, query.line,
                   "the query is for a map of " + std::to_string(query.width) + "x" +
                       std::to_string(query.height) + " cells, the map has " +
                       std::to_string(geometry.width()) + "x" + std::to_string(geometry.height()));
}

}  // namespace grid_path_planner::study
