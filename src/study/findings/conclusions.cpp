#include <algorithm>
#include <cmath>

#include "base/shell_text.h"
#include "study/findings/finding_text.h"
#include "study/findings/published_cases.h"
#include "study/findings/verdicts.h"
#include "study/programs/published_dijkstra.h"
#include "study/study_planners.h"

namespace grid_path_planner::study {

using base::Status;
using planners::Heuristic;

namespace {

constexpr double kExactly = 1e-12;  // relative: exact costs, each rounded once to a double

class Conclusions {
 public:
  explicit Conclusions(const StudyData& data)
      : data_(data),
        cases_(publishedCases(data, data.study().published.group, Border::FILLED)),
        command_("grid_path study " + base::shellWord(data.study().file) +
                 " --out DIR, then DIR/") {
    dijkstra_ = variantOf(data, "dijkstra_published");
    a_star_ = variantOf(data, data.study().published.planner, Heuristic::EUCLIDEAN);
  }

  std::vector<Conclusion> all() const {
    if (!dijkstra_ || !a_star_ || cases_.empty()) return {};
    return {missesOfDijkstra(), timesOfBoth(),   optimumOfEuclidean(),
            cellsOfDijkstra(),  shortestCount(), largerKernels(),
            values(),           memory()};
  }

 private:
  // C1
  Conclusion missesOfDijkstra() const {
    std::size_t found = 0, missed = 0;
    for (const UnitRow& unit : data_.units())
      for (const StudyRun* run : unit) {
        if (run == nullptr || run->status != Status::FOUND || !isDijkstra(run->variant)) continue;
        ++found;
        missed += run->cost > run->optimum * (1.0 + kExactly) ? 1 : 0;
      }
    Conclusion c = named("C1", "Dijkstra may miss the optimal path", "optimal.csv");
    if (found == 0) return c;
    c.verdict = missed == 0 ? Verdict::REFUTED : Verdict::CONFIRMED;
    c.measure = "searches of both Dijkstras above the least cost";
    c.interval = shareCell(missed, found, data_.queries()).text;
    c.reason =
        std::to_string(missed) + " of " + std::to_string(found) +
        " searches missed the least cost, compared exactly, and settling cells in the order of "
        "their distance cannot miss it. The published paths that looked better were of an A* that "
        "minimised another cost: Dijkstra's path of 234 passes 224 steps from its end a cell from "
        "which A* needs 164.";
    return c;
  }

  // C2
  Conclusion timesOfBoth() const {
    Conclusion c = named("C2", "A* is much faster at the same complexity", "time.csv");
    const auto slow = variantOf(data_, "dijkstra");
    const auto fast = variantOf(data_, "a_star", Heuristic::EUCLIDEAN);
    if (slow && fast) {
      const std::vector<double> ratios = data_.ratios(*slow, *fast, nullptr, medianTime);
      if (!ratios.empty()) {
        c.measure = "time of dijkstra / a_star euclidean, both of this package, one open list";
        c.interval = intervalText(meanRatio(ratios));
      }
    }
    c.reason =
        "The published times are those of a scan over a dense matrix, O(V²), against an ordered "
        "set, so their ratio is one of programs and not of algorithms, and the complexity is not "
        "the same. What can be compared is the heuristic within one program, which the interval "
        "does.";
    return c;
  }

  // C3
  Conclusion optimumOfEuclidean() const {
    const int kernel = smallestKernel();
    std::size_t found = 0, least = 0;
    double largest = 0.0;
    for (const PublishedCase& each : cases_) {
      const StudyRun* run = each.found(*a_star_);
      if (each.setting->costmap.kernel != kernel || run == nullptr) continue;
      ++found;
      least += run->cost <= run->optimum * (1.0 + kExactly) ? 1 : 0;
      if (run->optimum > 0.0) largest = std::max(largest, run->cost / run->optimum - 1.0);
    }
    Conclusion c = named("C3", "A* with the Euclidean heuristic at kernel 3 finds the optimal path",
                         "runs.csv");
    if (found == 0) return c;
    c.verdict = least == found ? Verdict::CONFIRMED : Verdict::REFUTED;
    c.measure = "paths of least cost, " + label(*a_star_) + ", kernel " + std::to_string(kernel);
    c.interval = shareCell(least, found, samples()).text;
    c.reason = "It has the least cost in " + std::to_string(least) + " of " +
               std::to_string(found) + " cases" +
               (least < found ? ", and costs up to " + percentText(largest) + " more" : "") +
               ". Nothing promises it: the Euclidean distance overestimates where a diagonal costs "
               "1, the search ends when the goal is generated, and closed cells stay closed.";
    return c;
  }

  // C4
  Conclusion cellsOfDijkstra() const {
    Conclusion c = named("C4", "Dijkstra explores about twice as much", "dijkstra_cells.csv");
    MeansByNumber logarithms;
    for (const PublishedCase& each : cases_)
      if (const auto both = runsOf(each, *dijkstra_, *a_star_))
        logarithms.add(each.number, std::log(static_cast<double>(both->first->cells) /
                                             static_cast<double>(both->second->cells)));
    const std::vector<double> values = logarithms.values();
    if (values.empty()) return c;
    const Interval ratio = ratioOf(values);
    std::vector<double> from_two;
    for (const double value : values) from_two.push_back(value - std::log(2.0));
    c.measure = "cells of the path (\"explored\"), dijkstra_published / " + label(*a_star_);
    c.interval = intervalText(ratio);
    c.p = pairedP(from_two);
    c.needs_test = true;
    if (ratio.high < 2.0 || ratio.low > 2.0) c.verdict = Verdict::REFUTED;
    c.reason =
        "What it calls explored are the cells of the path, and its Dijkstra ran other starts and "
        "goals than its A*, so the published 231 to 108 compares queries. On the same queries the "
        "ratio is that of the interval; tested against 2.";
    return c;
  }

  // C5
  Conclusion shortestCount() const {
    Conclusion c = named("C5", "The Euclidean heuristic is shortest most often", "counts.csv");
    const std::vector<std::size_t> variants = heuristicsOf(data_, data_.study().published.planner);
    std::vector<MeansByNumber> shares(variants.size());
    for (const PublishedCase& each : cases_) addShares(each, variants, shares);
    std::optional<Interval> closest;
    double p = 0.0;
    for (std::size_t i = 0; i < variants.size(); ++i) {
      if (variants[i] == *a_star_) continue;
      const auto own = static_cast<std::size_t>(
          std::find(variants.begin(), variants.end(), *a_star_) - variants.begin());
      const auto differences = MeansByNumber::differences(shares[own], shares[i]);
      if (differences.empty()) return c;
      const Interval more = meanDifference(differences);
      p = std::max(p, pairedP(differences));
      if (!closest || more.value < closest->value) closest = more;
    }
    if (!closest) return c;
    c.measure = "share of cases with the fewest cells, euclidean less the best other";
    c.interval = percentText(closest->value) + " (" + percentText(closest->low) + " to " +
                 percentText(closest->high) + ")";
    c.p = p;
    c.needs_test = true;
    if (closest->low > 0.0) c.verdict = Verdict::CONFIRMED;
    if (closest->high < 0.0) c.verdict = Verdict::REFUTED;
    c.reason =
        "Counted as published: ties for all, over pairs and kernels. No search minimises the "
        "number of cells but where all cells weigh the same, so the count follows from how ties "
        "of the cost are broken.";
    return c;
  }

  // C6
  Conclusion largerKernels() const {
    Conclusion c = named("C6", "A larger kernel is faster and changes the path", "kernels.csv");
    const int fine = smallestKernel(), coarse = largestKernel();
    MeansByNumber times_fine, times_coarse, lengths_fine, lengths_coarse;
    for (const PublishedCase& each : cases_) {
      const StudyRun* run = each.found(*a_star_);
      const int kernel = each.setting->costmap.kernel;
      if (run == nullptr || (kernel != fine && kernel != coarse)) continue;
      (kernel == fine ? times_fine : times_coarse).add(each.number, std::log(medianTime(*run)));
      (kernel == fine ? lengths_fine : lengths_coarse).add(each.number, std::log(run->length_m));
    }
    const auto faster = MeansByNumber::differences(times_fine, times_coarse);
    if (faster.empty()) return c;
    const auto longer = MeansByNumber::differences(lengths_coarse, lengths_fine);
    const Interval ratio = ratioOf(faster);
    c.measure = "time at kernel " + std::to_string(fine) + " / " + std::to_string(coarse) + ", " +
                label(*a_star_);
    c.interval = intervalText(ratio);
    c.p = pairedP(faster);
    c.needs_test = true;
    if (ratio.low > 1.0) c.verdict = Verdict::CONFIRMED;
    if (ratio.high < 1.0) c.verdict = Verdict::REFUTED;
    const auto changed = std::count_if(longer.begin(), longer.end(), [](double logarithm) {
      return std::abs(logarithm) > std::log(1.05);
    });
    c.reason =
        "Within one program the time falls with the number of cells. The path changes: for " +
        std::to_string(changed) + " of " + std::to_string(longer.size()) +
        " pairs its length by more than 5 %, by a factor of " + intervalText(ratioOf(longer)) +
        " on average.";
    return c;
  }

  // C7
  Conclusion values() const;
  // C8
  Conclusion memory() const;
  Conclusion named(const char* name, const char* claim, const std::string& table) const {
    Conclusion c;
    c.name = name;
    c.claim = claim;
    c.interval = c.measure = "–";
    c.reason = "The study has no runs for it.";
    c.command = command_ + table;
    return c;
  }

  const std::string& label(std::size_t variant) const {
    return data_.study().variants[variant].label;
  }
  bool isDijkstra(std::size_t variant) const {
    const std::string& planner = data_.study().variants[variant].planner;
    return planner == "dijkstra" || planner == "dijkstra_published";
  }
  int smallestKernel() const {
    int least = cases_.front().setting->costmap.kernel;
    for (const PublishedCase& each : cases_) least = std::min(least, each.setting->costmap.kernel);
    return least;
  }
  int largestKernel() const {
    int most = 0;
    for (const PublishedCase& each : cases_) most = std::max(most, each.setting->costmap.kernel);
    return most;
  }
  // The pairs.
  std::size_t samples() const {
    MeansByNumber numbers;
    for (const PublishedCase& each : cases_) numbers.add(each.number, 0.0);
    return numbers.values().size();
  }

  static std::optional<std::pair<const StudyRun*, const StudyRun*>> runsOf(
      const PublishedCase& each, std::size_t a, std::size_t b) {
    const StudyRun *first = each.found(a), *second = each.found(b);
    if (first == nullptr || second == nullptr) return {};
    return std::make_pair(first, second);
  }

  static Interval ratioOf(const std::vector<double>& logarithms) {
    const Interval mean = meanDifference(logarithms);
    return {std::exp(mean.value), std::exp(mean.low), std::exp(mean.high)};
  }

  static void addShares(const PublishedCase& each, const std::vector<std::size_t>& variants,
                        std::vector<MeansByNumber>& shares) {
    std::uint64_t least = UINT64_MAX;
    for (const std::size_t variant : variants) {
      if (each.found(variant) == nullptr) return;
      least = std::min(least, each.found(variant)->cells);
    }
    for (std::size_t i = 0; i < variants.size(); ++i)
      shares[i].add(each.number, each.found(variants[i])->cells == least ? 1.0 : 0.0);
  }

  std::size_t mapWithMostUnknown() const;
  std::vector<double> moreMetres(const std::string& weights, double StudyRun::*metres) const;

  const StudyData& data_;
  std::vector<PublishedCase> cases_;
  std::string command_;
  std::optional<std::size_t> dijkstra_;
  std::optional<std::size_t> a_star_;
};

std::size_t Conclusions::mapWithMostUnknown() const {
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t map = 0; map < data_.study().maps.size(); ++map) {
    const double unknown =
        classSharesOf(*data_.plan().map(map), data_.study().base.costmap.thresholds).unknown;
    if (unknown > most) best = map;
    most = std::max(most, unknown);
  }
  return best;
}

// For each pair, the part of its path in such cells with `weights` less that with the first weights.
std::vector<double> Conclusions::moreMetres(const std::string& weights,
                                            double StudyRun::*metres) const {
  const std::size_t map = mapWithMostUnknown();
  MeansByNumber here, first;
  for (const UnitRow& unit : data_.units()) {
    const StudyRun* run = unit[*a_star_];
    if (run == nullptr || run->status != Status::FOUND || run->length_m <= 0.0) continue;
    const StudySetting& setting = data_.settingOf(*run);
    const StudyQuery& query = data_.plan().queries(setting.map)[run->query];
    if (setting.map != map || setting.border != Border::FILLED ||
        query.group != data_.study().published.group)
      continue;
    if (setting.weights == weights) here.add(query.number, run->*metres / run->length_m);
    if (setting.weights == data_.study().settings.front().weights)
      first.add(query.number, run->*metres / run->length_m);
  }
  return MeansByNumber::differences(here, first);
}

Conclusion Conclusions::values() const {
  Conclusion c = named("C7", "The values of cells decide the path", "weights.csv");
  std::optional<double> low, high;
  double p = 0.0;
  std::string intervals;
  for (const auto& [weights, what] : data_.study().published.crossing) {
    const auto more =
        moreMetres(weights, what == "unknown" ? &StudyRun::unknown_m : &StudyRun::occupied_m);
    if (more.empty()) return c;
    const Interval interval = meanDifference(more);
    p = std::max(p, pairedP(more));
    low = low ? std::min(*low, interval.low) : interval.low;
    high = high ? std::min(*high, interval.high) : interval.high;
    intervals += (intervals.empty() ? "" : "; ") + what + " at " + weights + ": " +
                 percentText(interval.value) + " (" + percentText(interval.low) + " to " +
                 percentText(interval.high) + ")";
  }
  if (!low) return c;
  c.measure = "part of the path in such cells, more than with " +
              data_.study().settings.front().weights + ", on " +
              data_.study().maps[mapWithMostUnknown()].name;
  c.interval = intervals;
  c.p = p;
  c.needs_test = true;
  if (*low > 0.0) c.verdict = Verdict::CONFIRMED;
  if (*high < 0.0) c.verdict = Verdict::REFUTED;
  c.reason =
      "Both parts of the claim are tested, and the larger of the two p-values counts. It takes a "
      "map with unknown cells between the ends: on a map that was seen whole no weight of them can "
      "show.";
  return c;
}

Conclusion Conclusions::memory() const {
  Conclusion c = named("C8", "Dijkstra needs less memory than A*", "effort.csv");
  std::vector<double> ratios;
  for (const PublishedCase& each : cases_)
    if (const auto both = runsOf(each, *dijkstra_, *a_star_))
      ratios.push_back(static_cast<double>(both->second->bytes) /
                       static_cast<double>(both->first->bytes));
  const double matrix = PublishedDijkstra::matrixBytes(data_.plan().map(0)->geometry().size());
  const auto a_star = static_cast<double>(
      makeStudyPlanner("a_star_published", {}, false)->bytesFor(data_.plan().map(0)->geometry()));
  c.verdict = Verdict::CONTRADICTS_ITSELF;
  if (!ratios.empty()) {
    c.measure = "bytes of " + label(*a_star_) + " / dijkstra_published, without its matrix";
    c.interval = shownNumber(quantileOf(ratios, 0.0)) + " to " +
                 shownNumber(quantileOf(ratios, 1.0)) + " (all cases)";
  }
  c.reason = "Its Dijkstra asks for a matrix of " + shownNumber(matrix / 1e9) +
             " GB on the full map and was killed at 59 GB; its A*, repeated, has arrays of " +
             shownNumber(a_star / 1e6) +
             " MB there. Without the matrix, which it does not need, it is the smaller program: by "
             "the open list.";
  return c;
}

}  // namespace

std::vector<Conclusion> conclusionsOf(const StudyData& data) {
  std::vector<Conclusion> conclusions = Conclusions(data).all();
  const Conclusion rectangles = rectangleConclusion(data);
  if (!conclusions.empty() || rectangles.p) conclusions.push_back(rectangles);
  return conclusions;
}

}  // namespace grid_path_planner::study
