#include <algorithm>

#include "study/findings/finding_text.h"
#include "study/findings/findings.h"

namespace grid_path_planner::study {

using base::choiceName, base::Status;

namespace {

constexpr double kSameLength = 1e-9;  // relative: lengths of the same steps in another order

struct Score {
  std::size_t variant = 0;
  std::size_t units = 0;
  std::size_t shortest = 0;    // no other is shorter
  std::size_t alone = 0;       // all others are longer
  std::size_t least_cost = 0;  // cost as small as the smallest of all
};

// Counts a unit in which every variant of `scores` found a path.
void addTo(std::vector<Score>& scores, const UnitRow& unit) {
  double least_length = 1e300, least_cost = 1e300;
  for (const Score& score : scores) {
    least_length = std::min(least_length, unit[score.variant]->length_m);
    least_cost = std::min(least_cost, unit[score.variant]->cost);
  }
  const auto isShortest = [&](const Score& score) {
    return unit[score.variant]->length_m <= least_length * (1.0 + kSameLength);
  };
  const auto winners = std::count_if(scores.begin(), scores.end(), isShortest);
  for (Score& score : scores) {
    ++score.units;
    score.shortest += isShortest(score) ? 1 : 0;
    score.alone += isShortest(score) && winners == 1 ? 1 : 0;
    score.least_cost += unit[score.variant]->cost <= least_cost * (1.0 + kSameLength) ? 1 : 0;
  }
}

// Variants of one program that differ in the heuristic, in units where all of them found a path.
std::vector<Score> scoresOf(const StudyData& data, const std::vector<std::size_t>& variants) {
  std::vector<Score> scores;
  for (const std::size_t variant : variants) scores.push_back({variant, 0, 0, 0, 0});
  for (const UnitRow& unit : data.units()) {
    const bool all = std::all_of(variants.begin(), variants.end(), [&unit](std::size_t variant) {
      return unit[variant] != nullptr && unit[variant]->status == Status::FOUND;
    });
    if (all) addTo(scores, unit);
  }
  return scores;
}

TableCell publishedCell(const std::map<std::string, double>& published,
                        const std::string& heuristic) {
  const auto figure = published.find(heuristic);
  return figure == published.end() ? TableCell("–") : TableCell(figure->second, 3);
}

// The order of the shares found against the order of the shares published.
std::string answerFor(const StudyData& data, const std::string& planner,
                      const std::vector<Score>& scores) {
  std::string text = "With " + planner + ' ';
  bool same_order = true, apart = true, known = !data.study().published.shortest_percent.empty();
  double before_published = 1e9;
  Interval before{1.0, 1.0, 1.0};
  std::vector<Score> ranked = scores;
  const auto& published = data.study().published.shortest_percent;
  const auto figureOf = [&](const Score& score) {
    const char* heuristic = choiceName(data.study().variants[score.variant].search.heuristic);
    const auto figure = published.find(heuristic);
    return figure == published.end() ? 0.0 : figure->second;
  };
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Score& a, const Score& b) { return a.shortest > b.shortest; });
  for (const Score& score : ranked) {
    const Interval found = share(score.shortest, score.units, data.queries());
    const std::string& label = data.study().variants[score.variant].label;
    text += std::string(&score == &ranked.front() ? "" : "; ") + label.substr(planner.size() + 1) +
            " gives the shortest path for " + percentText(found.value);
    if (&score != &ranked.front() && found.high > before.low) apart = false;
    same_order = same_order && figureOf(score) <= before_published;
    before_published = figureOf(score);
    before = found;
  }
  text += ".";
  if (!apart) text += " The intervals of these shares overlap: their order is not certain.";
  if (!known) return text;
  if (same_order) return text + " It is the published order" + (apart ? ": it holds." : ".");
  return text + " It is not the published order" +
         (apart ? ": that does not hold." : ", which is thereby not confirmed.");
}

}  // namespace

Finding shortestFinding(const StudyData& data) {
  Finding finding;
  finding.question = "Which heuristic gives the shortest path?";
  finding.table = {
      "shortest",
      "Of the queries that all heuristics of a planner answered: for how many no other heuristic's "
      "path is shorter, all others' are longer, and none's is cheaper; 95 % intervals. The search "
      "minimises the cost, not the length: of paths that cost the same, one may be longer.",
      {"planner", "heuristic", "queries", "shortest", "published [%]", "shortest alone",
       "published alone [%]", "least cost"},
      {}};
  std::map<std::string, std::vector<std::size_t>> programs;
  for (std::size_t variant = 0; variant < data.study().variants.size(); ++variant) {
    const StudyVariant& each = data.study().variants[variant];
    if (each.label != each.planner) programs[each.planner].push_back(variant);
  }
  const PublishedFigures& published = data.study().published;
  for (const auto& program : programs) {
    if (program.second.size() < 2) continue;
    const std::vector<Score> scores = scoresOf(data, program.second);
    for (const Score& score : scores) {
      const char* heuristic = choiceName(data.study().variants[score.variant].search.heuristic);
      finding.table.rows.push_back({program.first, heuristic,
                                    TableCell(static_cast<double>(score.units), 4),
                                    shareCell(score.shortest, score.units, data.queries()),
                                    publishedCell(published.shortest_percent, heuristic),
                                    shareCell(score.alone, score.units, data.queries()),
                                    publishedCell(published.alone_percent, heuristic),
                                    shareCell(score.least_cost, score.units, data.queries())});
    }
    if (scores.front().units > 0) finding.answers.push_back(answerFor(data, program.first, scores));
  }
  return finding;
}

}  // namespace grid_path_planner::study
