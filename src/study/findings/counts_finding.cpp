#include <algorithm>

#include "study/findings/finding_text.h"
#include "study/findings/findings.h"
#include "study/findings/published_cases.h"

namespace grid_path_planner::study {

using base::choiceName;

namespace {

constexpr double kSameMetres = 1e-9;  // relative

// For how many cases a heuristic's path is the shortest, ties counted for all.
struct Count {
  std::size_t by_cells = 0;
  std::size_t by_metres = 0;
};

struct Counts {
  std::size_t cases = 0;  // in which every heuristic found a path
  std::vector<Count> of_heuristics;
};

void addCase(const PublishedCase& each, const std::vector<std::size_t>& variants, Counts& counts) {
  std::uint64_t least_cells = UINT64_MAX;
  double least_metres = 1e300;
  for (const std::size_t variant : variants) {
    const StudyRun* run = each.found(variant);
    if (run == nullptr) return;
    least_cells = std::min(least_cells, run->cells);
    least_metres = std::min(least_metres, run->length_m);
  }
  ++counts.cases;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const StudyRun& run = *each.found(variants[i]);
    counts.of_heuristics[i].by_cells += run.cells == least_cells ? 1 : 0;
    counts.of_heuristics[i].by_metres += run.length_m <= least_metres * (1.0 + kSameMetres) ? 1 : 0;
  }
}

Counts countsFor(const StudyData& data, std::size_t map, const std::string& group, Border border,
                 const std::vector<std::size_t>& variants) {
  Counts counts{0, std::vector<Count>(variants.size())};
  for (const PublishedCase& each : publishedCases(data, group, border))
    if (each.setting->map == map) addCase(each, variants, counts);
  return counts;
}

std::vector<std::string> groupsOf(const StudyData& data) {
  std::vector<std::string> groups;
  for (const StudyQuery& query : data.plan().queries(0))
    if (!query.group.empty() && (groups.empty() || groups.back() != query.group))
      groups.push_back(query.group);
  return groups;
}

std::size_t pairsIn(const StudyData& data, const std::string& group) {
  const std::vector<StudyQuery>& queries = data.plan().queries(0);
  return static_cast<std::size_t>(
      std::count_if(queries.begin(), queries.end(),
                    [&group](const StudyQuery& query) { return query.group == group; }));
}

void addRows(const StudyData& data, std::size_t map, const std::string& group, Border border,
             const std::string& planner, Table& table) {
  const std::vector<std::size_t> variants = heuristicsOf(data, planner);
  const Counts counts = countsFor(data, map, group, border, variants);
  if (counts.cases == 0) return;
  const auto& published = data.study().published.shortest_percent;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const char* heuristic = choiceName(data.study().variants[variants[i]].search.heuristic);
    const auto figure = published.find(heuristic);
    const std::size_t samples = std::min(counts.cases, pairsIn(data, group));
    table.rows.push_back({data.study().maps[map].name, choiceName(border), group, planner,
                          heuristic, TableCell(static_cast<double>(counts.cases), 4),
                          TableCell(static_cast<double>(counts.of_heuristics[i].by_cells), 4),
                          shareCell(counts.of_heuristics[i].by_cells, counts.cases, samples),
                          figure == published.end() ? TableCell("–") : TableCell(figure->second, 3),
                          shareCell(counts.of_heuristics[i].by_metres, counts.cases, samples)});
  }
}

std::string aloneAnswer(const PublishedFigures& published) {
  std::string figures;
  for (const auto& figure : published.alone_percent)
    figures +=
        (figures.empty() ? "" : ", ") + figure.first + ' ' + shownNumber(figure.second) + " %";
  return "Published too: \"alone\" " + figures +
         ". These have no definition that can be used: the shares would mean that no two "
         "heuristics "
         "ever tie, and the published lists show ties.";
}

// How often the published list itself has a tie for the fewest cells.
std::string listAnswer(const PublishedFigures& published) {
  std::size_t complete = 0, ties = 0, first_least = 0;
  for (const auto& query : published.cells)
    for (const auto& of_kernel : query.second) {
      const std::vector<int>& cells = of_kernel.second.figures;
      if (cells.size() < 2 || std::count(cells.begin(), cells.end(), 0) > 0) continue;
      const int least = *std::min_element(cells.begin(), cells.end());
      ++complete;
      ties += std::count(cells.begin(), cells.end(), least) > 1 ? 1 : 0;
      first_least += cells.front() == least ? 1 : 0;
    }
  return "Of the published list " + std::to_string(complete) +
         " cases are complete; the first heuristic has the fewest cells in " +
         std::to_string(first_least) + " of them, and " + std::to_string(ties) +
         " are ties of two or three.";
}

}  // namespace

Finding countsFinding(const StudyData& data) {
  Finding finding;
  finding.question = "Which heuristic is shortest, counted as published?";
  finding.table = {
      "counts",
      "A case is a pair at a kernel, with the first weights, in which all heuristics found a path. "
      "Shortest: no other heuristic's path has fewer cells (as published), or fewer metres. The "
      "intervals count the pairs, not the cases.",
      {"map", "border", "pairs", "planner", "heuristic", "cases", "fewest cells in", "fewest cells",
       "published [%]", "fewest metres"},
      {}};
  const PublishedFigures& published = data.study().published;
  if (published.group.empty()) return finding;
  for (std::size_t map = 0; map < data.study().maps.size(); ++map)
    for (const Border border : {Border::FILLED, Border::UNFILLED})
      for (const std::string& group : groupsOf(data))
        for (const std::string& planner : {published.planner, std::string("a_star")})
          addRows(data, map, group, border, planner, finding.table);
  finding.answers.push_back(listAnswer(published));
  if (!published.alone_percent.empty()) finding.answers.push_back(aloneAnswer(published));
  return finding;
}

}  // namespace grid_path_planner::study
