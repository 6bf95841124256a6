#include "study/findings/finding_text.h"
#include "study/findings/findings.h"

namespace grid_path_planner::study {

using base::Status;

namespace {

double expandedOf(const StudyRun& run) {
  return static_cast<double>(run.expanded);
}

double cellsOf(const StudyRun& run) {
  return static_cast<double>(run.cells);
}

template <class Value>
std::vector<double> valuesOf(const StudyData& data, const ProblemSize& size, std::size_t variant,
                             Value&& value) {
  std::vector<double> values;
  for (const UnitRow& unit : data.units()) {
    const StudyRun* run = unit[variant];
    if (run == nullptr || run->status != Status::FOUND) continue;
    const ProblemSize of = data.sizeOf(run->setting);
    if (of == size) values.push_back(value(*run));
  }
  return values;
}

bool correctAStar(const StudyVariant& variant) {
  return variant.planner == "a_star";
}

// Dijkstra's cells over A*'s, all heuristics and kernels together.
std::string answerFor(const StudyData& data) {
  const std::size_t base = data.baseline();
  if (data.study().variants[base].planner != "dijkstra") return "";
  RatiosByQuery by_expanded, by_cells;
  for (const UnitRow& unit : data.units())
    for (const StudyRun* run : unit) {
      if (run == nullptr || run->status != Status::FOUND || unit[base] == nullptr ||
          !correctAStar(data.study().variants[run->variant]))
        continue;
      by_expanded.add(data.queryOf(*run), expandedOf(*unit[base]), expandedOf(*run));
      by_cells.add(data.queryOf(*run), cellsOf(*unit[base]), cellsOf(*run));
    }
  const std::vector<double> expanded = by_expanded.values();
  if (expanded.empty()) return "";
  return "Dijkstra expands " + intervalText(meanRatio(expanded)) +
         " times as many cells as A*, and its paths have " +
         intervalText(meanRatio(by_cells.values())) + " times as many cells.";
}

}  // namespace

Finding effortFinding(const StudyData& data) {
  Finding finding;
  finding.question = "How much is searched?";
  const std::size_t base = data.baseline();
  finding.table = {
      "effort",
      "Cells expanded are those whose neighbours were looked at. Cells of the path "
      "are what the original study calls \"explored\". Medians; ratios as of the times.",
      {"map", "kernel", "variant", "cells expanded", "cells of the path", "bytes",
       "expanded: " + data.study().variants[base].label + " / this"},
      {}};
  for (const ProblemSize& size : data.sizes())
    for (std::size_t variant = 0; variant < data.study().variants.size(); ++variant) {
      const auto bytes = [](const StudyRun& run) { return static_cast<double>(run.bytes); };
      const std::vector<double> ratios = data.ratios(base, variant, &size, expandedOf);
      finding.table.rows.push_back(
          {data.study().maps[size.map].name, TableCell(size.kernel, 3),
           data.study().variants[variant].label,
           medianCell(valuesOf(data, size, variant, expandedOf)),
           medianCell(valuesOf(data, size, variant, cellsOf)),
           medianCell(valuesOf(data, size, variant, bytes)),
           variant == base || ratios.empty() ? TableCell("–") : intervalCell(meanRatio(ratios))});
    }
  const std::string answer = answerFor(data);
  if (!answer.empty()) finding.answers.push_back(answer);
  return finding;
}

}  // namespace grid_path_planner::study
