#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "study/findings/finding_text.h"
#include "study/findings/findings.h"

namespace grid_path_planner::study {

using base::choiceName, base::Status;

namespace {

struct Times {
  double preparation_ms = 0.0;  // mean over the settings
  double plan_ms = 0.0;         // mean over all plans
  std::size_t plans = 0;
};

double meanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Times timesFor(const StudyData& data, const ProblemSize& size, std::size_t variant) {
  std::map<std::size_t, double> preparations;  // by setting
  std::vector<double> plans;
  for (const UnitRow& unit : data.units()) {
    const StudyRun* run = unit[variant];
    if (run == nullptr || run->status != Status::FOUND) continue;
    const ProblemSize of = data.sizeOf(run->setting);
    if (of != size) continue;
    preparations[run->setting] = run->preparation_ms;
    plans.insert(plans.end(), run->times_ms.begin(), run->times_ms.end());
  }
  if (plans.empty()) return {};
  std::vector<double> each;
  for (const auto& preparation : preparations) each.push_back(preparation.second);
  return {meanOf(each), meanOf(plans), plans.size()};
}

// Of the programs whose times can be compared with those of `variant`, the one that is the fastest for
// one single query. Precondition: `variant` has times.
std::size_t fastestOnce(const StudyData& data, const std::vector<Times>& times,
                        std::size_t variant) {
  std::size_t best = variant;
  const auto once = [](const Times& each) { return each.preparation_ms + each.plan_ms; };
  for (std::size_t i = 0; i < times.size(); ++i)
    if (times[i].plans > 0 && data.baselineOf(i) == data.baselineOf(variant) &&
        once(times[i]) < once(times[best]))
      best = i;
  return best;
}

// From how many queries `variant` takes less than `best`; none where the interval of the ratio of their
// times does not say which plans faster, or the means of the times say the other.
std::optional<double> queriesToWin(const StudyData& data, const ProblemSize& size,
                                   const std::vector<Times>& times, std::size_t variant,
                                   std::size_t best) {
  const std::vector<double> ratios = data.ratios(best, variant, &size, medianTime);
  if (ratios.empty()) return {};
  const Interval ratio = meanRatio(ratios);
  const bool faster_on_average = times[variant].plan_ms < times[best].plan_ms;
  if (!differs(ratio) || (ratio.value > 1.0) != faster_on_average) return {};
  return queriesUntilCheaper(times[variant].preparation_ms, times[variant].plan_ms,
                             times[best].preparation_ms, times[best].plan_ms);
}

TableCell winsCell(const std::optional<double>& queries) {
  if (!queries) return "not certain";
  return std::isinf(*queries) ? TableCell("never") : TableCell(*queries, 6);
}

}  // namespace

double queriesUntilCheaper(double preparation, double plan, double other_preparation,
                           double other_plan) {
  if (preparation + plan < other_preparation + other_plan) return 1.0;
  if (plan >= other_plan) return std::numeric_limits<double>::infinity();
  return std::floor((preparation - other_preparation) / (other_plan - plan)) + 1.0;
}

Finding preparationFinding(const StudyData& data) {
  Finding finding;
  finding.question = "What does preparation cost, and when does it pay?";
  finding.table = {
      "preparation",
      "Preparation: what the planner does for a new map, after the costmap, which all share; mean "
      "of the settings. Plan: mean of all plans. First plan: both. Wins from: so many queries on "
      "one map from which preparation and plans together take less than those of the variant that "
      "is the fastest of its kind for one query; not certain: the interval of the ratio of "
      "their times does not say which plans faster, or the means say the other.",
      {"map", "kernel", "rule", "border", "variant", "preparation [ms]", "first plan [ms]",
       "plan [ms]", "plans", "wins from"},
      {}};
  for (const ProblemSize& size : data.sizes()) {
    std::vector<Times> all;
    for (std::size_t variant = 0; variant < data.study().variants.size(); ++variant)
      all.push_back(timesFor(data, size, variant));
    for (std::size_t variant = 0; variant < all.size(); ++variant) {
      const Times& times = all[variant];
      if (times.plans == 0) continue;
      const std::size_t best = fastestOnce(data, all, variant);
      const auto wins = queriesToWin(data, size, all, variant, best);
      if (variant != best && wins && !std::isinf(*wins))
        finding.answers.push_back("At " + sizeText(data, size) + ' ' +
                                  data.study().variants[variant].label + " takes less than " +
                                  data.study().variants[best].label + " from " +
                                  shownNumber(*wins, 6) + " queries on.");
      finding.table.rows.push_back(
          {data.study().maps[size.map].name, TableCell(size.kernel, 3), choiceName(size.rule),
           choiceName(size.border), data.study().variants[variant].label,
           TableCell(times.preparation_ms, 3), TableCell(times.preparation_ms + times.plan_ms, 3),
           TableCell(times.plan_ms, 3), TableCell(static_cast<double>(times.plans), 6),
           variant == best ? TableCell("the first") : winsCell(wins)});
    }
  }
  return finding;
}

}  // namespace grid_path_planner::study
