#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "study/report/finding_text.h"
#include "study/report/findings.h"

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

// The variant that is the fastest for one single query, among those with times.
std::size_t fastestOnce(const std::vector<Times>& times) {
  std::size_t best = times.size();
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i].plans == 0) continue;
    const auto once = [](const Times& each) { return each.preparation_ms + each.plan_ms; };
    if (best == times.size() || once(times[i]) < once(times[best])) best = i;
  }
  return best;
}

// "" where it never is.
std::string winsFrom(const Times& times, const Times& once) {
  const double queries =
      queriesUntilCheaper(times.preparation_ms, times.plan_ms, once.preparation_ms, once.plan_ms);
  return std::isinf(queries) ? "never" : shownNumber(queries, 6);
}

// Who is the fastest for one query, and who is after more.
std::string answerFor(const StudyData& data, const ProblemSize& size, const std::vector<Times>& all,
                      std::size_t best) {
  const std::vector<StudyVariant>& variants = data.study().variants;
  std::string later;
  for (std::size_t variant = 0; variant < all.size(); ++variant) {
    if (variant == best || all[variant].plans == 0) continue;
    const std::string from = winsFrom(all[variant], all[best]);
    if (from != "never")
      later += (later.empty() ? "" : ", ") + variants[variant].label + " from " + from + " on";
  }
  return "At " + sizeText(data, size) + ' ' + variants[best].label +
         " takes the least time for one query; over more of them " +
         (later.empty() ? "no other takes less" : "less is taken by " + later) + '.';
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
      "is the fastest for one query; times of means, without an interval.",
      {"map", "kernel", "rule", "border", "variant", "preparation [ms]", "first plan [ms]",
       "plan [ms]", "plans", "wins from"},
      {}};
  for (const ProblemSize& size : data.sizes()) {
    std::vector<Times> all;
    for (std::size_t variant = 0; variant < data.study().variants.size(); ++variant)
      all.push_back(timesFor(data, size, variant));
    const std::size_t best = fastestOnce(all);
    if (best == all.size()) continue;
    finding.answers.push_back(answerFor(data, size, all, best));
    for (std::size_t variant = 0; variant < all.size(); ++variant) {
      const Times& times = all[variant];
      if (times.plans == 0) continue;
      finding.table.rows.push_back(
          {data.study().maps[size.map].name, TableCell(size.kernel, 3), choiceName(size.rule),
           choiceName(size.border), data.study().variants[variant].label,
           TableCell(times.preparation_ms, 3), TableCell(times.preparation_ms + times.plan_ms, 3),
           TableCell(times.plan_ms, 3), TableCell(static_cast<double>(times.plans), 6),
           variant == best ? "the first" : winsFrom(times, all[best])});
    }
  }
  return finding;
}

}  // namespace grid_path_planner::study
