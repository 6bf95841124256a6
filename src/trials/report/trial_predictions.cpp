#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <utility>

#include "trials/report/trial_findings.h"

namespace grid_path_planner::trials {

using study::shownNumber;

namespace {

constexpr std::size_t kAlike = 50;  // images, 10 s, in which a view changes
constexpr double kMost = 0.95;      // share of the seeds that confirms; one less refutes

PredictionVerdict verdictOf(double share) {
  return share >= kMost         ? PredictionVerdict::CONFIRMED
         : share <= 1.0 - kMost ? PredictionVerdict::REFUTED
                                : PredictionVerdict::UNDECIDED;
}

// Whether something holds of a run; none where a figure that it rests on is not there.
using Holds = std::optional<bool>;
using HoldsIn = Holds (*)(const RunRecord&);

// `holds`, unless one of the figures is NaN.
Holds known(std::initializer_list<double> figures, bool holds) {
  for (const double figure : figures)
    if (std::isnan(figure)) return {};
  return holds;
}

const RowResult& rowOf(const RunRecord& run, const char* name) {
  return run.rows[rowNumber(name)];
}

// Of one error set.
class PredictionList {
 public:
  PredictionList(const TrialData& data, std::size_t set) : data_(data), set_(set) {}

  // Of a limit, by the share of the seeds in which it holds.
  void add(const std::string& claim, HoldsIn holds, const std::string& figures) {
    const auto [some, all] = countOf(holds);
    const auto verdict = all == 0 ? PredictionVerdict::UNDECIDED
                                  : verdictOf(static_cast<double>(some) / static_cast<double>(all));
    decide(claim, verdict, countText(some, all) + figures);
  }

  // Of which is the larger one, by whether more seeds say so than by chance.
  void addTendency(const std::string& claim, HoldsIn holds, const std::string& figures) {
    const auto [some, all] = countOf(holds);
    decide(claim, verdictOfTendency(some, all), countText(some, all) + figures);
  }

  // By one comparison over all images.
  void decide(const std::string& claim, PredictionVerdict verdict, const std::string& figures) {
    predictions_.push_back({claim + " (" + data_.study.sets[set_].name + ")", verdict, figures});
  }

  std::string mean(const char* row, double (*figure)(const RowResult&), int digits = 3) const {
    return std::string(row) + " " +
           shownNumber(data_.mean(set_, rowNumber(row), figure).mean, digits);
  }

  ErrorSpread panel(Water water, PanelMethod method) const {
    return panelError(data_, set_, water, method);
  }
  // Of each image with a pose in both waters, by the mean over markers.
  std::vector<double> clearMinusTurbid() const;
  std::vector<Prediction> predictions() const { return predictions_; }

 private:
  // In how many runs it holds, and of how many that is known.
  std::pair<std::size_t, std::size_t> countOf(HoldsIn holds) const {
    std::size_t all = 0, some = 0;
    for (const RunRecord& run : data_.runs) {
      if (run.set != set_ || run.seed == kShownSeed) continue;
      const Holds here = holds(run);
      if (!here) continue;
      ++all;
      some += *here;
    }
    return {some, all};
  }
  static std::string countText(std::size_t some, std::size_t all) {
    return "in " + std::to_string(some) + " of " + std::to_string(all) + " runs; ";
  }

  const TrialData& data_;
  std::size_t set_;
  std::vector<Prediction> predictions_;
};

std::vector<double> PredictionList::clearMinusTurbid() const {
  std::map<int, double> clear, turbid;
  for (const SeenFrame& frame : data_.frames) {
    const ViewSolution& solution = frame.solutions[set_];
    if (solution.mean)
      (frame.water == Water::CLEAR ? clear : turbid)[frame.frame] = solution.panel.mean.metres;
  }
  std::vector<double> differences;
  for (const auto& [frame, metres] : clear)
    if (const auto other = turbid.find(frame); other != turbid.end())
      differences.push_back(metres - other->second);
  return differences;
}

double smoothness(const RowResult& row) {
  return row.smoothness;
}
double positionSmoothness(const RowResult& row) {
  return row.position_smoothness;
}
double metresToMarkers(const RowResult& row) {
  return row.markers.metres;
}
double metresToTruth(const RowResult& row) {
  return row.in_view.metres;
}
double degreesToMarkers(const RowResult& row) {
  return row.markers.degrees;
}
double degreesToTruth(const RowResult& row) {
  return row.in_view.degrees;
}

Holds hasPublishedOrder(const RunRecord& run, const char* gated) {
  const double l2 = rowOf(run, "L2").smoothness, l3 = rowOf(run, "L3").smoothness,
               l4 = rowOf(run, "L4").smoothness, l5 = rowOf(run, gated).smoothness;
  return known({l2, l3, l4, l5}, l3 < l4 && l4 < l5 && l3 < l2);
}

// Whether the row `less` has the smaller m_A.
Holds isLessSmooth(const RunRecord& run, const char* less, const char* more) {
  const double a = rowOf(run, less).smoothness, b = rowOf(run, more).smoothness;
  return known({a, b}, a < b);
}

void addSmoothness(PredictionList& list) {
  const std::string figures = list.mean("L2", smoothness) + ", " + list.mean("L3", smoothness) +
                              ", " + list.mean("L4", smoothness) + ", " +
                              list.mean("L5", smoothness);
  list.addTendency(
      "m_A grows from L3 to L4", [](const RunRecord& run) { return isLessSmooth(run, "L3", "L4"); },
      figures);
  list.addTendency(
      "m_A grows from L4 to L5 (gate either)",
      [](const RunRecord& run) { return isLessSmooth(run, "L4", "L5"); }, figures);
  list.addTendency(
      "with the gate both it grows from L4 to L5",
      [](const RunRecord& run) { return isLessSmooth(run, "L4", "L5 both"); },
      list.mean("L4", smoothness) + ", " + list.mean("L5 both", smoothness));
  list.addTendency(
      "m_A of L2 is above that of L3",
      [](const RunRecord& run) { return isLessSmooth(run, "L3", "L2"); }, figures);
  list.addTendency(
      "m_A has the published order at once: L3 < L4 < L5 and L3 < L2 (gate either)",
      [](const RunRecord& run) { return hasPublishedOrder(run, "L5"); }, figures);
  list.addTendency(
      "the same with the gate both",
      [](const RunRecord& run) { return hasPublishedOrder(run, "L5 both"); },
      figures + "; both: " + list.mean("L5 both", smoothness));
  list.add(
      "of positions instead of increments it is above 0.99 for any filter",
      [](const RunRecord& run) {
        const std::array<double, 4> smooth = {
            rowOf(run, "L2").position_smoothness, rowOf(run, "L3").position_smoothness,
            rowOf(run, "L4").position_smoothness, rowOf(run, "L5").position_smoothness};
        return known({smooth[0], smooth[1], smooth[2], smooth[3]},
                     *std::min_element(smooth.begin(), smooth.end()) >= 0.99);
      },
      list.mean("L2", positionSmoothness, 5) + ", " + list.mean("L3", positionSmoothness, 5) +
          ", " + list.mean("L4", positionSmoothness, 5) + ", " +
          list.mean("L5", positionSmoothness, 5));
}

void addReference(PredictionList& list) {
  list.addTendency(
      "what L5 is off from the markers is mostly the markers' own noise: the truth is less than "
      "half as far",
      [](const RunRecord& run) {
        const ErrorSpread &truth = rowOf(run, "L5").in_view, &markers = rowOf(run, "L5").markers;
        return known({truth.metres, markers.metres},
                     truth.metres < 0.5 * markers.metres && truth.degrees < 0.5 * markers.degrees);
      },
      "against markers " + list.mean("L5", metresToMarkers) + " m, " +
          list.mean("L5", degreesToMarkers) + "°; truth " + list.mean("L5", metresToTruth) +
          " m, " + list.mean("L5", degreesToTruth) + "°");
  list.add(
      "the heading of the INS alone makes L5 off by more than 5° from the markers",
      [](const RunRecord& run) {
        const double degrees = rowOf(run, "L5 heading").markers.degrees;
        return known({degrees}, degrees > 5.0);
      },
      list.mean("L5 heading", degreesToMarkers) + "°; without it " +
          list.mean("L5", degreesToMarkers) + "°");
}

void addRows(PredictionList& list) {
  list.add(
      "L2 is farther off from the markers than L3, L4 and L5",
      [](const RunRecord& run) {
        const double l2 = rowOf(run, "L2").markers.metres, l3 = rowOf(run, "L3").markers.metres,
                     l4 = rowOf(run, "L4").markers.metres, l5 = rowOf(run, "L5").markers.metres;
        return known({l2, l3, l4, l5}, l2 > l3 && l2 > l4 && l2 > l5);
      },
      list.mean("L2", metresToMarkers) + " m, " + list.mean("L3", metresToMarkers) + " m, " +
          list.mean("L4", metresToMarkers) + " m, " + list.mean("L5", metresToMarkers) + " m");
  list.add(
      "L1 is off by less than 0.3 m and 3° while markers are in view",
      [](const RunRecord& run) {
        const ErrorSpread& truth = rowOf(run, "L1").in_view;
        return known({truth.metres}, truth.metres < 0.3 && truth.degrees < 3.0);
      },
      list.mean("L1", metresToTruth) + " m, " + list.mean("L1", degreesToTruth) + "°");
  list.add(
      "it matters whether either limit of the gate rejects or both: by more than 1 cm to the truth",
      [](const RunRecord& run) {
        const double apart = rowOf(run, "L5").in_view.metres - rowOf(run, "L5 both").in_view.metres;
        return known({apart}, std::abs(apart) > 0.01);
      },
      list.mean("L5", metresToTruth) + " m, " + list.mean("L5 both", metresToTruth) + " m");
}

PredictionVerdict verdictOn(const Holds& holds) {
  return !holds   ? PredictionVerdict::UNDECIDED
         : *holds ? PredictionVerdict::CONFIRMED
                  : PredictionVerdict::REFUTED;
}

std::string textOf(const ErrorSpread& error) {
  return shownNumber(error.metres, 3) + " m, " + shownNumber(error.degrees, 3) + "°";
}

void addPanel(PredictionList& list) {
  const ErrorSpread mean = list.panel(Water::TURBID, PanelMethod::MEAN);
  const ErrorSpread clear = list.panel(Water::CLEAR, PanelMethod::MEAN);
  const ErrorSpread joint = list.panel(Water::TURBID, PanelMethod::JOINT);
  const ErrorSpread sequential = list.panel(Water::TURBID, PanelMethod::SEQUENTIAL);
  list.decide("T_P is better in clear water (E0) than in turbid (E*), in metres, image by image",
              verdictOfMean(list.clearMinusTurbid(), kAlike), textOf(clear) + "; " + textOf(mean));
  list.decide(
      "the joint pose is at least four times as good as the mean over markers",
      verdictOn(known({joint.metres, mean.metres},
                      joint.metres <= 0.25 * mean.metres && joint.degrees <= 0.25 * mean.degrees)),
      textOf(joint) + "; " + textOf(mean));
  list.decide(
      "slerp one after another is no better than the eigenvector mean",
      verdictOn(known({sequential.degrees, mean.degrees}, sequential.degrees >= mean.degrees)),
      textOf(sequential) + "; " + textOf(mean));
}

}  // namespace

PredictionVerdict verdictOfTendency(std::size_t some, std::size_t all) {
  const auto count = static_cast<double>(all);
  const double excess = static_cast<double>(some) - 0.5 * count;
  if (std::abs(excess) <= std::sqrt(count)) return PredictionVerdict::UNDECIDED;
  return verdictOn(excess > 0.0);
}

PredictionVerdict verdictOfMean(const std::vector<double>& values, std::size_t block) {
  std::vector<double> means;
  for (std::size_t first = 0; first + block <= values.size(); first += block) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
    means.push_back(meanOf({begin, begin + static_cast<std::ptrdiff_t>(block)}).mean);
  }
  const MeanAndSpread all = meanOf(means);
  if (means.size() < 2 || std::abs(all.mean) <= 2.0 * all.standard_error)
    return PredictionVerdict::UNDECIDED;
  return verdictOn(all.mean < 0.0);
}

const char* textOf(PredictionVerdict verdict) {
  return verdict == PredictionVerdict::CONFIRMED ? "confirmed"
         : verdict == PredictionVerdict::REFUTED ? "refuted"
                                                 : "undecided";
}

std::vector<Prediction> predictionsOf(const TrialData& data) {
  std::vector<Prediction> all;
  for (std::size_t set = 0; set < data.study.sets.size(); ++set) {
    PredictionList list(data, set);
    addSmoothness(list);
    addReference(list);
    addRows(list);
    addPanel(list);
    for (const Prediction& prediction : list.predictions()) all.push_back(prediction);
  }
  return all;
}

}  // namespace grid_path_planner::trials
