#include "study/findings/verdicts.h"

#include "study/findings/finding_text.h"

namespace grid_path_planner::study {
namespace {

constexpr double kSignificant = 0.05;

std::string numberOrDash(const std::optional<double>& number) {
  if (!number) return "–";
  return *number < 1e-4 ? "< 0.0001" : shownNumber(*number, 2);
}

std::string sentenceOf(const Conclusion& conclusion) {
  return conclusion.name + ", \"" + conclusion.claim + "\": " + textOf(conclusion.verdict) + ". " +
         conclusion.reason + " Shown by: " + conclusion.command;
}

}  // namespace

const char* textOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::CONFIRMED:
      return "confirmed";
    case Verdict::REFUTED:
      return "refuted";
    case Verdict::CANNOT_BE_TESTED:
      return "cannot be tested here";
    case Verdict::CONTRADICTS_ITSELF:
      break;
  }
  return "contradicts its own figures";
}

void correctForAll(std::vector<Conclusion>& conclusions) {
  std::vector<double> values;
  for (const Conclusion& each : conclusions)
    if (each.p) values.push_back(*each.p);
  const std::vector<double> corrected = holmCorrected(values);
  std::size_t next = 0;
  for (Conclusion& each : conclusions) {
    if (each.p) each.corrected_p = corrected[next++];
    if (!each.needs_test || each.corrected_p < kSignificant) continue;
    each.verdict = Verdict::CANNOT_BE_TESTED;
    each.reason += " These pairs do not separate it from chance.";
  }
}

Finding verdictsFinding(const StudyData& data) {
  Finding finding;
  finding.question = "Do the published conclusions hold?";
  finding.table = {
      "verdicts",
      "p: Student's t over the pairs, two-sided; corrected by Holm's procedure over "
      "the conclusions that have a test. Without p: shown by exact comparison or from "
      "the published figures themselves.",
      {"conclusion", "published", "verdict", "measured", "95 % interval", "p", "p, corrected"},
      {}};
  if (!data.study().published.conclusions) return finding;
  std::vector<Conclusion> conclusions = conclusionsOf(data);
  correctForAll(conclusions);
  for (const Conclusion& each : conclusions) {
    finding.table.rows.push_back({each.name, each.claim, textOf(each.verdict), each.measure,
                                  each.interval, numberOrDash(each.p),
                                  each.p ? numberOrDash(each.corrected_p) : "–"});
    finding.answers.push_back(sentenceOf(each));
  }
  return finding;
}

}  // namespace grid_path_planner::study
