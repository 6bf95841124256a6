#include <algorithm>
#include <cstdio>

#include "flights/report/flight_findings.h"
#include "study/confidence.h"

namespace grid_path_planner::flights {

using study::Finding, study::shownNumber, study::TableCell;

namespace {

constexpr double kSignificant = 0.05;

std::vector<ComparedPair> comparedPairs(const FlightStudy& study) {
  std::vector<ComparedPair> pairs;
  const auto add = [&pairs](const ComparedPair& pair) {
    if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
  };
  for (const PublishedPair& each : study.pairs) add(each.pair);
  for (const PublishedConclusion& claim : study.conclusions)
    for (const ComparedPair& pair : claim.pairs) add(pair);
  return pairs;
}

double meanOf(const std::vector<double>& values) {
  return study::meanDifference(values).value;
}

FlightTest welchTest(const FlightData& data, std::size_t worse, std::size_t better, bool of_time) {
  const auto value = of_time ? timeOf : lengthOf;
  const std::vector<double> a = data.values(worse, value), b = data.values(better, value);
  FlightTest test;
  test.measure = of_time ? "time" : "length";
  test.testable = a.size() >= 2 && b.size() >= 2;
  if (!test.testable) return test;
  test.difference = meanOf(a) - meanOf(b);
  test.p = study::welchP(a, b);
  return test;
}

FlightTest fisherTest(const FlightData& data, std::size_t worse, std::size_t better) {
  const std::size_t all_a = data.of(worse).size(), all_b = data.of(better).size();
  FlightTest test;
  test.measure = "success";
  test.testable = all_a > 0 && all_b > 0;
  if (!test.testable) return test;
  const std::size_t a = data.successes(worse), b = data.successes(better);
  test.difference = static_cast<double>(b) / static_cast<double>(all_b) -
                    static_cast<double>(a) / static_cast<double>(all_a);
  test.p = study::fisherP(a, all_a, b, all_b);
  return test;
}

void correctByHolm(std::vector<FlightTest>& tests) {
  std::vector<double> p;
  for (const FlightTest& test : tests)
    if (test.testable) p.push_back(test.p);
  const std::vector<double> corrected = study::holmCorrected(p);
  std::size_t next = 0;
  for (FlightTest& test : tests)
    if (test.testable) test.corrected = corrected[next++];
}

double publishedP(const FlightStudy& study, const FlightTest& test) {
  for (const PublishedPair& each : study.pairs)
    if (each.pair == test.pair) {
      if (test.measure == "time") return each.time_p;
      if (test.measure == "length") return each.length_p;
    }
  return -1.0;
}

std::string nameOf(const ComparedPair& pair) {
  return pair.worse + "–" + pair.better;
}

bool isCompared(const ComparedPair& pair, const std::vector<FlightTest>& tests) {
  return std::any_of(tests.begin(), tests.end(),
                     [&pair](const FlightTest& test) { return test.pair == pair; });
}

std::string claimText(const FlightTest& test) {
  return nameOf(test.pair) + ' ' + test.measure + " " +
         (test.testable ? "(p " + shownNumber(test.corrected, 2) + ")" : "(cannot be tested)");
}

}  // namespace

std::vector<FlightTest> flightTests(const FlightData& data, const std::string& rules) {
  std::vector<FlightTest> tests;
  for (const ComparedPair& pair : comparedPairs(data.study())) {
    const auto worse = data.variantOf(pair.worse, rules),
               better = data.variantOf(pair.better, rules);
    if (!worse || !better) continue;
    for (FlightTest test :
         {welchTest(data, *worse, *better, true), welchTest(data, *worse, *better, false),
          fisherTest(data, *worse, *better)}) {
      test.pair = pair;
      test.rules = rules;
      test.published = publishedP(data.study(), test);
      tests.push_back(test);
    }
  }
  correctByHolm(tests);
  return tests;
}

const char* textOf(ClaimVerdict verdict) {
  if (verdict == ClaimVerdict::CONFIRMED) return "confirmed";
  return verdict == ClaimVerdict::REFUTED ? "refuted" : "undecided";
}

ClaimVerdict verdictOn(const PublishedConclusion& claim, const std::vector<FlightTest>& tests) {
  bool all = !claim.pairs.empty();
  for (const ComparedPair& pair : claim.pairs) {
    all = all && isCompared(pair, tests);
    for (const FlightTest& test : tests) {
      if (!(test.pair == pair)) continue;
      const bool significant = test.testable && test.corrected < kSignificant;
      if (significant && test.difference < 0.0) return ClaimVerdict::REFUTED;
      all = all && significant;
    }
  }
  return all ? ClaimVerdict::CONFIRMED : ClaimVerdict::UNDECIDED;
}

namespace {

// "" where none of its pairs was compared.
std::string restsOn(const PublishedConclusion& claim, const std::vector<FlightTest>& tests) {
  std::string rests, missing;
  for (const FlightTest& test : tests)
    if (std::find(claim.pairs.begin(), claim.pairs.end(), test.pair) != claim.pairs.end())
      rests += (rests.empty() ? "" : ", ") + claimText(test);
  for (const ComparedPair& pair : claim.pairs)
    if (!isCompared(pair, tests)) missing += ", " + nameOf(pair) + " (not compared)";
  return rests.empty() ? "" : rests + missing;
}

// As it was printed: six decimals at most, without trailing zeros.
TableCell publishedCell(double p) {
  constexpr int kDecimals = 6;
  TableCell cell(p, kDecimals);
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", kDecimals, p);
  cell.text = text;
  cell.text.erase(cell.text.find_last_not_of('0') + 1);
  if (cell.text.back() == '.') cell.text.pop_back();
  return cell;
}

std::vector<TableCell> rowOfTest(const std::string& rules, const FlightTest& test) {
  const TableCell none("–");
  return {rules,
          nameOf(test.pair),
          test.measure,
          test.testable ? TableCell(test.difference, 3) : none,
          test.testable ? TableCell(test.p, 2) : none,
          test.testable ? TableCell(test.corrected, 2) : none,
          test.published < 0.0 ? none : publishedCell(test.published)};
}

}  // namespace

Finding testsFinding(const FlightData& data) {
  Finding finding;
  finding.question = "Are the published pairs apart?";
  finding.table = {"tests",
                   "Welch's test of times and lengths of the flights that came home, Fisher's of "
                   "how many did, two-sided; corrected by Holm's procedure under the same rules. "
                   "A difference above 0: the second is better.",
                   {"rules", "pair", "of", "difference", "p", "corrected p", "published p"},
                   {}};
  for (const std::string& rules : data.rules())
    for (const FlightTest& test : flightTests(data, rules))
      finding.table.rows.push_back(rowOfTest(rules, test));
  return finding;
}

Finding claimsFinding(const FlightData& data) {
  Finding finding;
  finding.question = "What of the published conclusions holds here?";
  finding.table = {"claims",
                   "Confirmed: every pair was compared, and every comparison is significant in its "
                   "direction; refuted: one is against it; else undecided.",
                   {"rules", "conclusion", "verdict", "rests on"},
                   {}};
  for (const std::string& rules : data.rules()) {
    const std::vector<FlightTest> tests = flightTests(data, rules);
    for (const PublishedConclusion& claim : data.study().conclusions) {
      const std::string rests = restsOn(claim, tests);
      if (rests.empty()) continue;
      const char* verdict = textOf(verdictOn(claim, tests));
      finding.table.rows.push_back({rules, claim.claim, verdict, rests});
      finding.answers.push_back("Under the rules " + rules + ": " + claim.claim + ": " + verdict +
                                '.');
    }
  }
  return finding;
}

}  // namespace grid_path_planner::flights
