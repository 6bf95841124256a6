#include <algorithm>
#include <cmath>
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

const RowResult& rowOf(const RunRecord& run, const char* name) {
  return run.rows[rowNumber(name)];
}

// Of one error set.
class PredictionList {
 public:
  PredictionList(const TrialData& data, std::size_t set) : data_(data), set_(set) {}

  // Of a limit, by the share of the seeds in which it holds.
  void add(const std::string& claim, bool (*holds)(const RunRecord&), const std::string& figures) {
    const auto [some, all] = countOf(holds);
    const double share =
        static_cast<double>(some) / static_cast<double>(std::max<std::size_t>(all, 1));
    decide(claim, verdictOf(share), countText(some, all) + figures);
  }

  // Of which is the larger one, by whether more seeds say so than by chance.
  void addTendency(const std::string& claim, bool (*holds)(const RunRecord&),
                   const std::string& figures) {
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
  std::pair<std::size_t, std::size_t> countOf(bool (*holds)(const RunRecord&)) const {
    std::size_t all = 0, some = 0;
    for (const RunRecord& run : data_.runs) {
      if (run.set != set_ || run.seed == kShownSeed) continue;
      ++all;
      some += holds(run);
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

bool hasPublishedOrder(const RunRecord& run, const char* gated) {
  const double l3 = rowOf(run, "L3").smoothness, l4 = rowOf(run, "L4").smoothness;
  return l3 < l4 && l4 < rowOf(run, gated).smoothness && l3 < rowOf(run, "L2").smoothness;
}

void addSmoothness(PredictionList& list) {
  const std::string figures = list.mean("L2", smoothness) + ", " + list.mean("L3", smoothness) +
                              ", " + list.mean("L4", smoothness) + ", " +
                              list.mean("L5", smoothness);
  list.addTendency(
      "m_A grows from L3 to L4",
      [](const RunRecord& run) {
        return rowOf(run, "L3").smoothness < rowOf(run, "L4").smoothness;
      },
      figures);
  list.addTendency(
      "m_A grows from L4 to L5 (gate either)",
      [](const RunRecord& run) {
        return rowOf(run, "L4").smoothness < rowOf(run, "L5").smoothness;
      },
      figures);
  list.addTendency(
      "with the gate both it grows from L4 to L5",
      [](const RunRecord& run) {
        return rowOf(run, "L4").smoothness < rowOf(run, "L5 both").smoothness;
      },
      list.mean("L4", smoothness) + ", " + list.mean("L5 both", smoothness));
  list.addTendency(
      "m_A of L2 is above that of L3",
      [](const RunRecord& run) {
        return rowOf(run, "L3").smoothness < rowOf(run, "L2").smoothness;
      },
      figures);
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
        for (const char* name : {"L2", "L3", "L4", "L5"})
          if (rowOf(run, name).position_smoothness < 0.99) return false;
        return true;
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
        const RowResult& row = rowOf(run, "L5");
        return row.in_view.metres < 0.5 * row.markers.metres &&
               row.in_view.degrees < 0.5 * row.markers.degrees;
      },
      "against markers " + list.mean("L5", metresToMarkers) + " m, " +
          list.mean("L5", degreesToMarkers) + "°; truth " + list.mean("L5", metresToTruth) +
          " m, " + list.mean("L5", degreesToTruth) + "°");
  list.add(
      "the heading of the INS alone makes L5 off by more than 5° from the markers",
      [](const RunRecord& run) { return rowOf(run, "L5 heading").markers.degrees > 5.0; },
      list.mean("L5 heading", degreesToMarkers) + "°; without it " +
          list.mean("L5", degreesToMarkers) + "°");
}

void addRows(PredictionList& list) {
  list.add(
      "L2 is farther off from the markers than L3, L4 and L5",
      [](const RunRecord& run) {
        const double without = rowOf(run, "L2").markers.metres;
        return without > rowOf(run, "L3").markers.metres &&
               without > rowOf(run, "L4").markers.metres &&
               without > rowOf(run, "L5").markers.metres;
      },
      list.mean("L2", metresToMarkers) + " m, " + list.mean("L3", metresToMarkers) + " m, " +
          list.mean("L4", metresToMarkers) + " m, " + list.mean("L5", metresToMarkers) + " m");
  list.add(
      "L1 is off by less than 0.3 m and 3° while markers are in view",
      [](const RunRecord& run) {
        return rowOf(run, "L1").in_view.metres < 0.3 && rowOf(run, "L1").in_view.degrees < 3.0;
      },
      list.mean("L1", metresToTruth) + " m, " + list.mean("L1", degreesToTruth) + "°");
  list.add(
      "it matters whether either limit of the gate rejects or both: by more than 1 cm to the truth",
      [](const RunRecord& run) {
        return std::abs(rowOf(run, "L5").in_view.metres - rowOf(run, "L5 both").in_view.metres) >
               0.01;
      },
      list.mean("L5", metresToTruth) + " m, " + list.mean("L5 both", metresToTruth) + " m");
}

PredictionVerdict verdictOf(bool holds) {
  return holds ? PredictionVerdict::CONFIRMED : PredictionVerdict::REFUTED;
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
  list.decide("the joint pose is at least four times as good as the mean over markers",
              verdictOf(joint.metres <= 0.25 * mean.metres && joint.degrees <= 0.25 * mean.degrees),
              textOf(joint) + "; " + textOf(mean));
  list.decide("slerp one after another is no better than the eigenvector mean",
              verdictOf(sequential.degrees >= mean.degrees),
              textOf(sequential) + "; " + textOf(mean));
}

}  // namespace

PredictionVerdict verdictOfTendency(std::size_t some, std::size_t all) {
  const auto count = static_cast<double>(all);
  const double excess = static_cast<double>(some) - 0.5 * count;
  if (std::abs(excess) <= std::sqrt(count)) return PredictionVerdict::UNDECIDED;
  return verdictOf(excess > 0.0);
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
  return verdictOf(all.mean < 0.0);
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
