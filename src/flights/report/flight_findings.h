// What the flights show: figures beside the published ones, tests, verdicts, failures. Means are over the
// flights that came home, with their number beside them.
#pragma once

#include <string>
#include <vector>

#include "flights/report/flight_data.h"
#include "study/report/finding.h"

namespace grid_path_planner::flights {

study::Finding figuresFinding(
    const FlightData& data);                           // success, time and length, and as published
study::Finding safetyFinding(const FlightData& data);  // how flights ended; clearance, unseen space
study::Finding pathsFinding(const FlightData& data);   // against the shortest path; speed; CPU
study::Finding testsFinding(const FlightData& data);   // the published pairs
study::Finding claimsFinding(const FlightData& data);  // the published conclusions
// Each flight that did not come home. `command`: what repeats one, up to its name.
study::Finding failuresFinding(const FlightData& data, const std::string& command);

// Those that have rows.
std::vector<study::Finding> flightFindings(const FlightData& data, const std::string& command);

// One row a flight, without what differs from run to run.
study::Table flightsTable(const FlightData& data);

// A comparison of two variants: p-values of Welch's test for time and length and of Fisher's for success,
// where each can be done, and corrected by Holm's procedure over all comparisons under the same rules.
struct FlightTest {
  ComparedPair pair;
  std::string rules;
  std::string measure;      // "time", "length", "success"
  double difference = 0.0;  // above 0: the second is better; s, m, share
  double p = 1.0;
  double corrected = 1.0;
  double published = -1.0;  // p-value; below 0: none
  bool testable = false;    // at least two flights of both came home
};
std::vector<FlightTest> flightTests(const FlightData& data, const std::string& rules);

enum class ClaimVerdict { CONFIRMED, REFUTED, UNDECIDED };
const char* textOf(ClaimVerdict verdict);
// Confirmed where every pair of the claim was compared and every comparison is significant (corrected p < 0.05) in
// its direction, refuted where one is against it.
ClaimVerdict verdictOn(const PublishedConclusion& claim, const std::vector<FlightTest>& tests);

}  // namespace grid_path_planner::flights
