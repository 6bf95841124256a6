#include <algorithm>
#include <map>

#include "study/findings/finding_text.h"
#include "study/findings/findings.h"
#include "study/findings/published_cases.h"

namespace grid_path_planner::study {

using base::choiceName, base::Status;

namespace {

struct Crossing {
  std::string weights;
  ProblemSize size;
  std::size_t paths = 0;
  std::size_t unknown = 0;   // paths that cross unknown cells
  std::size_t occupied = 0;  // paths that cross occupied cells
  std::vector<double> unknown_m, occupied_m, length_m;
};

// The one of these weights and this size, which may be new.
Crossing& crossingOf(const std::string& weights, const ProblemSize& size,
                     std::vector<Crossing>& all) {
  const auto crossing = std::find_if(all.begin(), all.end(), [&](const Crossing& each) {
    return each.weights == weights && each.size == size;
  });
  if (crossing != all.end()) return *crossing;
  all.push_back({weights, size, 0, 0, 0, {}, {}, {}});
  return all.back();
}

std::vector<Crossing> crossingsOf(const StudyData& data, std::size_t variant) {
  std::vector<Crossing> all;
  for (const UnitRow& unit : data.units()) {
    const StudyRun* run = unit[variant];
    if (run == nullptr || run->status != Status::FOUND) continue;
    Crossing& crossing = crossingOf(data.settingOf(*run).weights, data.sizeOf(run->setting), all);
    ++crossing.paths;
    crossing.unknown += run->unknown_m > 0.0 ? 1 : 0;
    crossing.occupied += run->occupied_m > 0.0 ? 1 : 0;
    crossing.unknown_m.push_back(run->unknown_m);
    crossing.occupied_m.push_back(run->occupied_m);
    crossing.length_m.push_back(run->length_m);
  }
  return all;
}

// For every query, the share of the kernels at which its path crosses such cells.
std::map<QueryKey, double> crossingShares(const StudyData& data, std::size_t variant,
                                          const std::string& weights, double StudyRun::*metres) {
  std::map<QueryKey, std::pair<int, int>> counts;
  for (const UnitRow& unit : data.units()) {
    const StudyRun* run = unit[variant];
    if (run == nullptr || run->status != Status::FOUND || data.settingOf(*run).weights != weights)
      continue;
    auto& [crossing, all] = counts[data.queryOf(*run)];
    crossing += run->*metres > 0.0 ? 1 : 0;
    ++all;
  }
  std::map<QueryKey, double> shares;
  for (const auto& count : counts)
    shares[count.first] = static_cast<double>(count.second.first) / count.second.second;
  return shares;
}

// "" where one of the two weights has no paths.
std::string publishedAnswer(const StudyData& data, std::size_t variant, const std::string& what,
                            const std::string& weights, const std::string& others) {
  const auto metres = what == "unknown" ? &StudyRun::unknown_m : &StudyRun::occupied_m;
  const auto here = crossingShares(data, variant, weights, metres);
  const auto there = crossingShares(data, variant, others, metres);
  std::vector<double> differences;
  double sum_here = 0.0, sum_there = 0.0;
  for (const auto& share : here) {
    const auto other = there.find(share.first);
    if (other == there.end()) continue;
    differences.push_back(share.second - other->second);
    sum_here += share.second;
    sum_there += other->second;
  }
  if (differences.empty()) return "";
  const auto n = static_cast<double>(differences.size());
  const Interval more = meanDifference(differences);
  std::string text = "Published: weights " + weights + " send paths through " + what +
                     " cells. Here " + percentText(sum_here / n) + " of those paths of " +
                     data.study().variants[variant].label + " cross them, " +
                     percentText(sum_there / n) + " with weights " + others;
  text += " (by query " + percentText(more.low) + " to " + percentText(more.high) + " more)";
  if (more.low > 0.0) return text + ": it holds.";
  if (sum_here == 0.0) return text + ": it does not hold on this map.";
  return text +
         "; the difference is inside the noise, so no such effect of the weights can be "
         "claimed.";
}

// The one whose paths cost the least, and the published programs, by their first heuristic: those
// whose steps cost the larger of two cells, and those whose steps cost the cell entered.
std::vector<std::size_t> variantsShown(const StudyData& data) {
  std::vector<std::size_t> shown = {data.baseline()};
  for (const std::string& planner :
       {data.study().published.planner, std::string("a_star_published_values")})
    if (const auto variant = variantOf(data, planner))
      if (std::find(shown.begin(), shown.end(), *variant) == shown.end()) shown.push_back(*variant);
  return shown;
}

TableCell meanCell(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return TableCell(sum / static_cast<double>(values.size()), 3);
}

std::vector<TableCell> rowOf(const StudyData& data, std::size_t variant, const Crossing& each) {
  return {data.study().maps[each.size.map].name,
          TableCell(each.size.kernel, 3),
          choiceName(each.size.border),
          data.study().variants[variant].label,
          each.weights,
          TableCell(static_cast<double>(each.paths), 3),
          shareCell(each.unknown, each.paths, each.paths),
          meanCell(each.unknown_m),
          shareCell(each.occupied, each.paths, each.paths),
          meanCell(each.occupied_m),
          meanCell(each.length_m)};
}

}  // namespace

Finding weightsFinding(const StudyData& data) {
  Finding finding;
  finding.question = "Where do the weights send the paths?";
  finding.table = {"weights",
                   "Paths that cross unknown or occupied cells of the full map, with 95 % "
                   "intervals, and metres in them (mean). A step costs the larger of its two "
                   "cells; of a_star_published_values the cell that it enters.",
                   {"map", "kernel", "border", "variant", "weights", "paths", "cross unknown",
                    "metres unknown", "cross occupied", "metres occupied", "length [m]"},
                   {}};
  for (const std::size_t variant : variantsShown(data)) {
    for (const Crossing& each : crossingsOf(data, variant))
      finding.table.rows.push_back(rowOf(data, variant, each));
    for (const auto& published : data.study().published.crossing) {
      const std::string answer = publishedAnswer(data, variant, published.second, published.first,
                                                 data.study().settings.front().weights);
      if (!answer.empty()) finding.answers.push_back(answer);
    }
  }
  return finding;
}

}  // namespace grid_path_planner::study
