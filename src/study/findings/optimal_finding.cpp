#include <algorithm>
#include <cmath>

#include "grid_path_planner/base/options.h"
#include "study/findings/finding_text.h"
#include "study/findings/findings.h"
#include "study/study_planners.h"

namespace grid_path_planner::study {

using base::sameOptions, base::Status;
using costmap::DiagonalCost;

namespace {

constexpr double kExact = 1e-12;  // relative: exact costs, each rounded once to a double

struct Gaps {
  std::size_t runs = 0;
  std::size_t found = 0;
  std::size_t optimal = 0;
  std::vector<double> values;  // cost / least cost by grid steps - 1
};

Gaps gapsOf(const StudyData& data, std::size_t variant) {
  Gaps gaps;
  for (const UnitRow& unit : data.units()) {
    const StudyRun* run = unit[variant];
    if (run == nullptr) continue;
    ++gaps.runs;
    if (run->status != Status::FOUND) continue;
    ++gaps.found;
    const double gap = run->optimum > 0.0 ? run->cost / run->optimum - 1.0 : 0.0;
    gaps.values.push_back(gap);
    gaps.optimal += gap <= kExact ? 1 : 0;
  }
  return gaps;
}

// How paths of the same least cost differ in length; "" where they do not.
std::string lengthsAnswer(const StudyData& data, std::size_t dijkstra) {
  std::string text;
  double largest = 1.0;
  for (std::size_t variant = 0; variant < data.study().variants.size(); ++variant) {
    const Gaps gaps = gapsOf(data, variant);
    const bool same_costs = std::all_of(gaps.values.begin(), gaps.values.end(),
                                        [](double gap) { return std::abs(gap) <= kExact; });
    if (gaps.found == 0 || !same_costs) continue;
    const std::vector<double> ratios =
        data.ratios(dijkstra, variant, nullptr, [](const StudyRun& run) { return run.length_m; });
    if (ratios.empty() || meanRatio(ratios).low <= largest) continue;
    largest = meanRatio(ratios).value;
    text = "Dijkstra's paths are " + intervalText(meanRatio(ratios)) +
           " times as long as those of " + data.study().variants[variant].label +
           ", which cost the same";
  }
  if (text.empty()) return text;
  if (data.study().base.costmap.motion.diagonal_cost == DiagonalCost::UNIT)
    text +=
        ": where a diagonal step costs no more than a straight one, a zigzag costs no more than "
        "a straight line, and of equally cheap paths Dijkstra takes any";
  return text + '.';
}

std::string dijkstraAnswer(const StudyData& data, const Gaps& gaps) {
  std::string text = "Dijkstra finds the least cost of grid steps in " +
                     std::to_string(gaps.optimal) + " of " + std::to_string(gaps.found) +
                     " queries.";
  if (!data.study().published.conclusions || gaps.optimal != gaps.found) return text;
  return text +
         " The published conclusion that Dijkstra does not find the optimal path does not hold: "
         "every cost here is compared exactly, as a + b√2 with integers, so none of this is "
         "rounding. A program in which it fails has a fault, or the least cost was taken for the "
         "least length.";
}

// The correct A* with the same heuristic shows whether the heuristic or the program misses the cost.
std::string correctAnswer(const StudyData& data, const StudyVariant& published, const Gaps& gaps) {
  for (std::size_t variant = 0; variant < data.study().variants.size(); ++variant) {
    const StudyVariant& each = data.study().variants[variant];
    if (each.planner != "a_star" || !sameOptions(each.search, published.search) ||
        each.published_cross != published.published_cross)
      continue;
    const Gaps correct = gapsOf(data, variant);
    const std::size_t by_heuristic = correct.found - correct.optimal;
    const std::size_t missed = gaps.found - gaps.optimal;
    std::string text = " The correct " + each.label + " misses it in " +
                       std::to_string(by_heuristic) + " of " + std::to_string(correct.found);
    if (by_heuristic == 0) return text + ": the program is to blame.";
    if (by_heuristic >= missed)
      return text + ": the heuristic, which overestimates here, is to blame, not the program.";
    return text +
           ": most of that is the heuristic, which overestimates here, the rest the program.";
  }
  return "";
}

std::string publishedProgramAnswer(const StudyData& data, const StudyVariant& variant,
                                   const Gaps& gaps) {
  if (gaps.optimal == gaps.found)
    return variant.label + ", the published program, also found the least cost every time here.";
  return variant.label + ", the published program, misses the least cost in " +
         std::to_string(gaps.found - gaps.optimal) + " of " + std::to_string(gaps.found) +
         " queries, by up to " +
         percentText(*std::max_element(gaps.values.begin(), gaps.values.end())) + "." +
         correctAnswer(data, variant, gaps);
}

TableCell percentCell(double share) {
  TableCell cell(percentText(share));
  cell.number = share;
  return cell;
}

std::vector<TableCell> rowOf(const StudyData& data, const StudyVariant& variant, const Gaps& gaps) {
  double sum = 0.0, largest = gaps.values.empty() ? 0.0 : gaps.values.front();
  for (const double gap : gaps.values) {
    sum += gap;
    largest = std::max(largest, gap);
  }
  const auto cell = [&gaps](double gap) {
    return gaps.values.empty() ? TableCell("–") : percentCell(gap);
  };
  const auto found = static_cast<double>(gaps.found);
  return {variant.label,
          TableCell(static_cast<double>(gaps.runs), 4),
          TableCell(found, 4),
          shareCell(gaps.optimal, gaps.found, data.queries()),
          cell(gaps.values.empty() ? 0.0 : quantileOf(gaps.values, 0.5)),
          cell(gaps.values.empty() ? 0.0 : sum / found),
          cell(largest)};
}

void addAnswers(const StudyData& data, std::size_t variant, const Gaps& gaps,
                std::vector<std::string>& answers) {
  const StudyVariant& each = data.study().variants[variant];
  if (each.planner == "dijkstra") {
    answers.push_back(dijkstraAnswer(data, gaps));
    const std::string lengths = lengthsAnswer(data, variant);
    if (!lengths.empty()) answers.push_back(lengths);
  }
  // Where occupied cells are passable the one that skips them solves another problem.
  const bool other_problem =
      each.planner == "a_star_published" && data.study().base.costmap.occupied_is_passable;
  if (isPublishedAStar(each.planner) && !other_problem)
    answers.push_back(publishedProgramAnswer(data, each, gaps));
}

}  // namespace

Finding optimalFinding(const StudyData& data) {
  Finding finding;
  finding.question = "Are the paths optimal?";
  finding.table = {
      "optimal",
      "Cost against the least cost by grid steps on the same setting, which Dijkstra "
      "finds exactly. Below 0: an any-angle path. The intervals count the queries, not the runs.",
      {"variant", "runs", "found", "least cost", "median gap", "mean gap", "largest gap"},
      {}};
  for (std::size_t variant = 0; variant < data.study().variants.size(); ++variant) {
    const Gaps gaps = gapsOf(data, variant);
    finding.table.rows.push_back(rowOf(data, data.study().variants[variant], gaps));
    if (gaps.found > 0) addAnswers(data, variant, gaps, finding.answers);
  }
  return finding;
}

}  // namespace grid_path_planner::study
