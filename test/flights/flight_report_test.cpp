#include <gtest/gtest.h>

#include <cmath>

#include "flights/report/flight_findings.h"
#include "flights/report/flight_pictures.h"
#include "flights/small_flights.h"
#include "grid_path_planner/simulation/triangle_mesh.h"
#include "support/error_text.h"

namespace grid_path_planner::flights {
namespace {

using test::contains, test::SmallFlights;

const char* const kPublished =
    "published:\n  source: a paper\n  figures: {slow: [100, 50, 80], fast: [60, 40, 95]}\n"
    "  pairs: [{pair: [slow, fast], p: [0.001, 0.2]}]\n"
    "  conclusions: [{claim: fast is better, pairs: [[slow, fast]]}]\n";

// `slow` takes 100 s and 50 m, `fast` `fast_time` and 40 m, with a little spread; of 20 flights so many
// of each come home.
class FlightReport : public testing::Test {
 protected:
  FlightData dataOf(int slow_home, int fast_home, double fast_time) const {
    std::vector<FlightRecord> records;
    for (std::size_t variant = 0; variant < 2; ++variant)
      for (int seed = 1; seed <= 20; ++seed) {
        FlightRecord record;
        record.variant = variant;
        record.seed = seed;
        record.end =
            seed <= (variant == 0 ? slow_home : fast_home) ? FlightEnd::HOME : FlightEnd::CONTACT;
        record.sentence = record.success() ? "arrived" : "post::l::c";
        record.time_s = (variant == 0 ? 100.0 : fast_time) + 0.1 * (seed % 5);
        record.length_m = (variant == 0 ? 50.0 : 40.0) + 0.1 * (seed % 7);
        record.clearance_m = 0.4 + 0.01 * seed;
        record.at = {3.0, 2.0, 1.5};
        record.path = {{0.0f, 0.0f, 1.5f}, {3.0f, 2.0f, 1.5f}};
        records.push_back(record);
      }
    return {plan_, records};
  }
  ClaimVerdict verdict(const FlightData& data) const {
    return verdictOn(plan_.study().conclusions.front(), flightTests(data, "safe"));
  }

  const SmallFlights small_ = {};
  const FlightPlan plan_{readFlightFile(small_.write("  - {name: slow}\n  - {name: fast}\n",
                                                     std::string("flights: 20\n") + kPublished))};
};

TEST_F(FlightReport, FiguresStandBesideThePublishedOnes) {
  const study::Finding figures = figuresFinding(dataOf(4, 18, 60.0));
  ASSERT_EQ(figures.table.rows.size(), 2u);
  EXPECT_TRUE(contains(figures.table.rows[0][2].text, "4 of 20, 20 %"))
      << figures.table.rows[0][2].text;
  EXPECT_EQ(figures.table.rows[0][3].text, "80 %");
  EXPECT_TRUE(contains(figures.table.rows[0][4].text, ", n 4"));
  EXPECT_NEAR(*figures.table.rows[1][4].number, 60.2, 0.1);
  EXPECT_EQ(*figures.table.rows[1][5].number, 60.0);
}

TEST_F(FlightReport, AClaimIsConfirmedOnlyWhereAllThreeFiguresBearIt) {
  EXPECT_EQ(verdict(dataOf(4, 18, 60.0)), ClaimVerdict::CONFIRMED);
  EXPECT_EQ(verdict(dataOf(17, 19, 60.0)), ClaimVerdict::UNDECIDED)
      << "17 and 19 of 20 say nothing";
  EXPECT_EQ(verdict(dataOf(4, 18, 130.0)), ClaimVerdict::REFUTED) << "it is slower";
  EXPECT_EQ(verdict(dataOf(1, 18, 60.0)), ClaimVerdict::UNDECIDED) << "one flight has no mean time";
}

// `old` was flown under other rules, so that nothing tells whether `fast` is better under these.
TEST_F(FlightReport, AClaimOfAPairThatWasNeverComparedIsUndecided) {
  PublishedConclusion claim = plan_.study().conclusions.front();
  const std::vector<FlightTest> tests = flightTests(dataOf(4, 18, 60.0), "safe");
  EXPECT_EQ(verdictOn(claim, tests), ClaimVerdict::CONFIRMED);
  claim.pairs.push_back({"old", "fast"});
  EXPECT_EQ(verdictOn(claim, tests), ClaimVerdict::UNDECIDED);
  EXPECT_EQ(verdictOn({"nothing", {}}, tests), ClaimVerdict::UNDECIDED);
  EXPECT_EQ(verdictOn(claim, flightTests(dataOf(4, 18, 130.0), "safe")), ClaimVerdict::REFUTED);
}

TEST_F(FlightReport, TestsAreCorrectedAndStandBesideThePublishedOnes) {
  const std::vector<FlightTest> tests = flightTests(dataOf(4, 18, 60.0), "safe");
  ASSERT_EQ(tests.size(), 3u);
  EXPECT_EQ(tests[0].measure, "time");
  EXPECT_NEAR(tests[0].difference, 40.0, 0.2);
  EXPECT_EQ(tests[1].published, 0.2);
  EXPECT_NEAR(tests[2].p, 0.00002, 5e-6);
  for (const FlightTest& test : tests) EXPECT_GE(test.corrected, test.p);
}

// 0.001 stood there as 0.00100000.
TEST_F(FlightReport, PublishedPValuesStandAsTheyWerePrinted) {
  const study::Finding tests = testsFinding(dataOf(4, 18, 60.0));
  ASSERT_EQ(tests.table.rows.size(), 3u);
  EXPECT_EQ(tests.table.rows[0].back().text, "0.001");
  EXPECT_EQ(tests.table.rows[1].back().text, "0.2");
  EXPECT_EQ(tests.table.rows[2].back().text, "–");
}

TEST_F(FlightReport, EveryFailureHasItsCauseAndTheCommandThatRepeatsIt) {
  const study::Finding failures = failuresFinding(dataOf(19, 20, 60.0), "grid_path flights f.yaml");
  ASSERT_EQ(failures.table.rows.size(), 1u);
  EXPECT_EQ(failures.table.rows[0][0].text, "slow/20/safe");
  EXPECT_EQ(failures.table.rows[0][1].text, "CONTACT");
  EXPECT_EQ(failures.table.rows[0][2].text, "post::l::c");
  EXPECT_EQ(failures.table.rows[0].back().text, "grid_path flights f.yaml --flight slow/20/safe");
}

TEST_F(FlightReport, PicturesShowTheWorldThePathsAndTheEnd) {
  const FlightData data = dataOf(19, 20, 60.0);
  const simulation::World world(
      {simulation::boxMesh("ground", {40, 40, 0.1}),
       simulation::boxMesh("post", {0.4, 0.4, 3.0})
           .moved(Eigen::Isometry3d(Eigen::Translation3d(3.0, 2.0, 1.5)))});
  const std::vector<Outline> outlines = outlinesOf(world, 0.6, 4.0);
  ASSERT_EQ(outlines.size(), 1u) << "the ground is no obstacle";
  EXPECT_EQ(outlines.front().size(), 4u);
  const std::string svg = flightsPicture(data.study(), outlines, data.of(0), "slow");
  std::size_t paths = 0;
  for (std::size_t at = 0; (at = svg.find("<polyline", at)) != std::string::npos; ++at) ++paths;
  EXPECT_EQ(paths, 20u);
  EXPECT_TRUE(contains(svg, "CONTACT: post::l::c"));
  EXPECT_TRUE(contains(endPicture(data.study(), outlines, data.records()[19], "end"),
                       "viewBox=\"-5.0 -10.0 16.0 16.0\""));
}

}  // namespace
}  // namespace grid_path_planner::flights
