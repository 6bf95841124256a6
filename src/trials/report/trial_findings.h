// What a study of localization shows: figures beside the published ones, consistency, goals, predictions.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "study/report/finding.h"
#include "trials/report/trial_data.h"

namespace grid_path_planner::trials {

study::Finding figuresFinding(const TrialData& data);      // L1 to L5 beside the published ones
study::Finding panelFinding(const TrialData& data);        // T_P by image
study::Finding consistencyFinding(const TrialData& data);  // NEES, NIS
study::Finding tracksFinding(const TrialData& data);       // ATE, RPE
study::Finding goalsFinding(const TrialData& data);
study::Finding predictionsFinding(const TrialData& data);
std::vector<study::Finding> trialFindings(const TrialData& data);

// How far panels seen in one water are off by one method, over all images with such a pose; NaN without any.
enum class PanelMethod { MEAN, SEQUENTIAL, JOINT };
ErrorSpread panelError(const TrialData& data, std::size_t set, Water water, PanelMethod method);

struct Goal {
  std::string name;
  std::string wanted;
  std::string unit;
  double found = NAN;                    // NaN: there was nothing to judge by, and it is not met
  std::optional<double> standard_error;  // of `found`, where that is a mean of NEES over the seeds
  bool met = false;
};
std::vector<Goal> goalsOf(const TrialData& data);

enum class PredictionVerdict { CONFIRMED, REFUTED, UNDECIDED };
const char* textOf(PredictionVerdict verdict);
struct Prediction {
  std::string claim;
  PredictionVerdict verdict = PredictionVerdict::UNDECIDED;
  std::string figures;
};
std::vector<Prediction> predictionsOf(const TrialData& data);

// Of a claim about which of two is larger that holds in `some` of `all` runs: more than half, or less, by two standard
// errors of a fair coin.
PredictionVerdict verdictOfTendency(std::size_t some, std::size_t all);
// Whether values have a mean below 0, by two standard errors. Neighbours are alike: the standard error is that of the
// means of blocks of `block` in a row.
PredictionVerdict verdictOfMean(const std::vector<double>& values, std::size_t block);

}  // namespace grid_path_planner::trials
