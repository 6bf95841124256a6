// Verdicts on the conclusions of the original study (published.conclusions of a study file), C1 to C9.
//
// Each is tested on the pairs as they were run, with the first weights unless it is about weights,
// paired: a pair's values are averaged over kernels and maps first, so that the samples are the
// pairs. The p-values are Student's, two-sided, and corrected by Holm's step-down procedure over
// the conclusions that have one (confidence.h); a verdict that rests on a test is given where the
// corrected value is below 0.05. Times are compared within one program only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/findings/findings.h"

namespace grid_path_planner::study {

enum class Verdict { CONFIRMED, REFUTED, CANNOT_BE_TESTED, CONTRADICTS_ITSELF };
const char* textOf(Verdict verdict);

struct Conclusion {
  std::string name;   // "C1"
  std::string claim;  // as published
  Verdict verdict = Verdict::CANNOT_BE_TESTED;
  std::string measure;       // what the interval is of
  std::string interval;      // "–" where there is none
  std::optional<double> p;   // of the test, before the correction
  std::string reason;        // two sentences
  std::string command;       // what shows it
  bool needs_test = false;   // the verdict does not hold unless the corrected p is below 0.05
  double corrected_p = 1.0;  // with p
};

// Corrects the p-values and withdraws verdicts that they do not bear.
void correctForAll(std::vector<Conclusion>& conclusions);

// C9, of the study of rectangle maps: CANNOT_BE_TESTED unless `dijkstra` and `rectangle_map` have runs.
Conclusion rectangleConclusion(const StudyData& data);

// C1 to C9 of the original study. Each is CANNOT_BE_TESTED where the study lacks its planners; C9 alone
// in a study of rectangle maps without the original's programs.
std::vector<Conclusion> conclusionsOf(const StudyData& data);

// Those as a finding; no rows unless the study file asks for them.
Finding verdictsFinding(const StudyData& data);

}  // namespace grid_path_planner::study
