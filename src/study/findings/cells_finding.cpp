#include <algorithm>

#include "study/findings/finding_text.h"
#include "study/findings/findings.h"
#include "study/findings/published_cases.h"

namespace grid_path_planner::study {

namespace {

// "164/165/196": the same query by several variants, "–" for one without a path.
std::string joined(const PublishedCase& each, const std::vector<std::size_t>& variants,
                   std::uint64_t StudyRun::*count) {
  std::string text;
  for (const std::size_t variant : variants) {
    const StudyRun* run = each.found(variant);
    text += (text.empty() ? "" : "/") + (run == nullptr ? "–" : std::to_string(run->*count));
  }
  return text;
}

template <class Figures>
std::string figureOf(const Figures& figures, int number, int kernel) {
  const auto query = figures.find(number);
  if (query == figures.end()) return "?";
  const auto figure = query->second.find(kernel);
  if (figure == query->second.end()) return "?";
  if constexpr (std::is_same_v<std::decay_t<decltype(figure->second)>, PublishedCells>)
    return figure->second.text;
  else
    return figure->second;
}

// Of cases whose published path runs through unfilled blocks: whether ours does with them unfilled.
struct BorderUse {
  std::size_t cases = 0;
  std::size_t here = 0;
  std::size_t filled = 0;  // with the blocks filled
};

// With more than its ends.
bool runsThrough(const StudyRun& run) {
  return run.border_cells > 2;
}

void addUse(const PublishedCase& off, const PublishedCase* on, std::size_t variant,
            BorderUse& use) {
  if (on == nullptr || on->found(variant) == nullptr || off.found(variant) == nullptr) return;
  ++use.cases;
  use.here += runsThrough(*on->found(variant)) ? 1 : 0;
  use.filled += runsThrough(*off.found(variant)) ? 1 : 0;
}

std::string borderAnswer(const BorderUse& use, const std::string& label) {
  return "Of the published paths that run through blocks that its filter2d left unfilled (free), " +
         std::to_string(use.cases) + " cases were repeated here: " + std::to_string(use.here) +
         " of ours (" + label + ") run there too with these blocks unfilled, " +
         std::to_string(use.filled) +
         " with them filled. The fault shows only where the border is unknown or occupied: where "
         "it "
         "is free it costs the same without it.";
}

}  // namespace

Finding cellsFinding(const StudyData& data) {
  const PublishedFigures& published = data.study().published;
  Finding finding;
  finding.question = "How many cells have the published paths, and ours?";
  finding.table = {"cells",
                   "Cells of the path by heuristic, in the order of the study, of " +
                       published.planner +
                       " on the pairs as run. Unfilled: with the blocks left free that the "
                       "original's filter2d never wrote; how many cells lie in those. ?: the page "
                       "is missing.",
                   {"map", "pair", "kernel", "published", "filled", "unfilled",
                    "published in those blocks", "filled: in them", "unfilled: in them"},
                   {}};
  const std::vector<std::size_t> variants = heuristicsOf(data, published.planner);
  if (published.cells.empty() || variants.empty()) return finding;
  const auto unfilled = publishedCases(data, published.group, Border::UNFILLED);
  BorderUse use;
  for (const PublishedCase& off : publishedCases(data, published.group, Border::FILLED)) {
    const PublishedCase* on = sameCase(unfilled, off);
    const int kernel = off.setting->costmap.kernel;
    const std::string border = figureOf(published.border_cells, off.number, kernel);
    if (border != "?") addUse(off, on, variants.front(), use);
    const auto cell = [&](std::uint64_t StudyRun::*count) {
      return on == nullptr ? std::string("–") : joined(*on, variants, count);
    };
    finding.table.rows.push_back(
        {data.study().maps[off.setting->map].name, TableCell(off.number, 3), TableCell(kernel, 3),
         figureOf(published.cells, off.number, kernel), joined(off, variants, &StudyRun::cells),
         cell(&StudyRun::cells), border == "?" ? "–" : border,
         joined(off, variants, &StudyRun::border_cells), cell(&StudyRun::border_cells)});
  }
  if (use.cases > 0)
    finding.answers.push_back(borderAnswer(use, data.study().variants[variants.front()].label));
  return finding;
}

Finding otherCellsFinding(const StudyData& data) {
  const PublishedFigures& published = data.study().published;
  Finding finding;
  finding.question = "How many cells has Dijkstra's path, on its own queries?";
  finding.table = {"dijkstra_cells",
                   "The published counts of Dijkstra are of other starts and goals than those of "
                   "A*. Here both answer Dijkstra's.",
                   {"map", "pair", "kernel", "published: Dijkstra", "dijkstra_published",
                    published.planner, "cost, Dijkstra", "cost, A*"},
                   {}};
  const auto dijkstra = variantOf(data, "dijkstra_published");
  const std::vector<std::size_t> variants = heuristicsOf(data, published.planner);
  if (published.other_cells.empty() || !dijkstra || variants.empty()) return finding;
  for (const PublishedCase& each : publishedCases(data, published.other_group, Border::FILLED)) {
    const int kernel = each.setting->costmap.kernel;
    const std::string figure = figureOf(published.other_cells, each.number, kernel);
    if (figure == "?") continue;
    const auto cost = [&each](std::size_t variant) {
      const StudyRun* run = each.found(variant);
      return run == nullptr ? TableCell("–") : TableCell(run->cost, 5);
    };
    finding.table.rows.push_back(
        {data.study().maps[each.setting->map].name, TableCell(each.number, 3), TableCell(kernel, 3),
         figure, joined(each, {*dijkstra}, &StudyRun::cells),
         joined(each, variants, &StudyRun::cells), cost(*dijkstra), cost(variants.front())});
  }
  return finding;
}

}  // namespace grid_path_planner::study
