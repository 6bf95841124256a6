#include <map>

#include "study/findings/finding_text.h"
#include "study/findings/findings.h"

namespace grid_path_planner::study {

using base::Status;
using costmap::KernelRule;

namespace {

// Runs of one variant at two kernels on the same map, rule, weights and query.
struct KernelPair {
  const StudyRun* fine;
  const StudyRun* coarse;
};

std::vector<KernelPair> pairsOf(const StudyData& data, std::size_t variant, int fine, int coarse) {
  using Key = std::tuple<std::size_t, KernelRule, Border, std::string, std::size_t>;
  std::map<Key, KernelPair> pairs;
  for (const UnitRow& unit : data.units()) {
    const StudyRun* run = unit[variant];
    if (run == nullptr || run->status != Status::FOUND) continue;
    const StudySetting& setting = data.settingOf(*run);
    KernelPair& pair = pairs[{setting.map, setting.costmap.kernel_rule, setting.border,
                              setting.weights, run->query}];
    if (setting.costmap.kernel == fine) pair.fine = run;
    if (setting.costmap.kernel == coarse) pair.coarse = run;
  }
  std::vector<KernelPair> complete;
  for (const auto& pair : pairs)
    if (pair.second.fine != nullptr && pair.second.coarse != nullptr)
      complete.push_back(pair.second);
  return complete;
}

template <class Value>
std::vector<double> ratiosOf(const StudyData& data, const std::vector<KernelPair>& pairs,
                             Value&& value) {
  RatiosByQuery ratios;
  for (const KernelPair& pair : pairs)
    ratios.add(data.queryOf(*pair.fine), value(*pair.fine), value(*pair.coarse));
  return ratios.values();
}

std::vector<int> kernelsOf(const StudyData& data) {
  std::map<int, bool> kernels;
  for (const StudySetting& setting : data.study().settings) kernels[setting.costmap.kernel] = true;
  std::vector<int> sorted;
  sorted.reserve(kernels.size());
  for (const auto& kernel : kernels) sorted.push_back(kernel.first);
  return sorted;
}

// Published time at `fine` over that at `coarse`; 0 where one is missing.
double publishedRatio(const StudyData& data, const std::string& variant, int fine, int coarse) {
  const auto& published = data.study().published.time_s;
  const auto times = published.find(variant);
  if (times == published.end() || times->second.count(fine) == 0 ||
      times->second.count(coarse) == 0)
    return 0.0;
  return times->second.at(fine) / times->second.at(coarse);
}

std::string answerFor(const std::string& variant, int fine, int coarse, const Interval& time,
                      double published) {
  const std::string which =
      variant + " from kernel " + std::to_string(fine) + " to " + std::to_string(coarse);
  if (!differs(time))
    return "No difference in time can be claimed for " + which + " (ratio " + intervalText(time) +
           ").";
  std::string text = "The time of " + which + " falls by a factor of " + intervalText(time);
  if (time.value < 1.0)
    text = "The time of " + which + " rises: its ratio is " + intervalText(time);
  if (published > 0.0) {
    const bool agrees = (published > 1.0) == (time.value > 1.0);
    text += "; published: " + shownNumber(published) +
            (agrees ? ". That a larger kernel is faster holds" : ", the opposite");
  }
  return text + '.';
}

}  // namespace

Finding kernelFinding(const StudyData& data) {
  Finding finding;
  finding.question = "What do larger kernels save, and what do they cost?";
  finding.table = {"kernels",
                   "The same variant, weights and query at two kernels: geometric means of the "
                   "ratios, smaller kernel over larger, with their 95 % interval.",
                   {"variant", "from kernel", "to kernel", "pairs", "time", "published time",
                    "cells expanded", "length", "cost"},
                   {}};
  const std::vector<int> kernels = kernelsOf(data);
  const std::string& base_name = data.study().variants[data.baseline()].label;
  for (std::size_t variant = 0; variant < data.study().variants.size(); ++variant)
    for (std::size_t i = 0; i + 1 < kernels.size(); ++i) {
      const int fine = kernels[i], coarse = kernels[i + 1];
      const std::vector<KernelPair> pairs = pairsOf(data, variant, fine, coarse);
      const auto cell = [&](auto&& value) {
        const std::vector<double> ratios = ratiosOf(data, pairs, value);
        return ratios.empty() ? TableCell("–") : intervalCell(meanRatio(ratios));
      };
      const std::string& label = data.study().variants[variant].label;
      const double published = publishedRatio(data, label, fine, coarse);
      const std::vector<double> times = ratiosOf(data, pairs, medianTime);
      finding.table.rows.push_back(
          {label, TableCell(fine, 3), TableCell(coarse, 3),
           TableCell(static_cast<double>(pairs.size()), 3), cell(medianTime),
           published > 0.0 ? TableCell(published, 3) : TableCell("–"),
           cell([](const StudyRun& run) { return static_cast<double>(run.expanded); }),
           cell([](const StudyRun& run) { return run.length_m; }),
           cell([](const StudyRun& run) { return run.cost; })});
      if (!times.empty() && (label == base_name || published > 0.0))
        finding.answers.push_back(answerFor(label, fine, coarse, meanRatio(times), published));
    }
  return finding;
}

}  // namespace grid_path_planner::study
