#include "study/findings/findings.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "small_study.h"
#include "study/report/report.h"
#include "support/error_text.h"

namespace grid_path_planner::study {

using base::Status;

namespace {

using test::contains;
using test::TemporaryFolder;

// A study whose runs are invented, so that what must be found is known.
class FindingsTest : public testing::Test {
 protected:
  FindingsTest() {
    for (const StudyUnit& unit : plan_.units())
      for (std::size_t variant = 0; variant < 3; ++variant) {
        StudyRun run = test::inventedRun(unit, variant);
        run.cells = 8;
        run.expanded = 100;
        run.times_ms = {1.0, 1.0};
        runs_.push_back(run);
      }
  }

  // Sets every run of a variant by its query.
  template <class Change>
  void change(std::size_t variant, Change&& change) {
    for (StudyRun& run : runs_)
      if (run.variant == variant) change(run);
  }

  static std::string wordsOf(const Finding& finding) {
    std::string all;
    for (const std::string& answer : finding.answers) all += answer + '\n';
    return all;
  }

  const TemporaryFolder folder_;
  const StudyPlan plan_ = test::smallStudy(folder_);
  std::vector<StudyRun> runs_;
};

TEST_F(FindingsTest, ADifferenceInTimeIsClaimedWithItsInterval) {
  change(0, [](StudyRun& run) { run.times_ms = {2.0 + 0.01 * run.query, 2.0}; });
  const Finding finding = timeFinding(StudyData(plan_, runs_));
  EXPECT_TRUE(contains(wordsOf(finding), "At kernel 1 dijkstra takes 2.0")) << wordsOf(finding);
}

TEST_F(FindingsTest, NothingIsClaimedFromADifferenceInsideTheNoise) {
  // Faster for one query, slower for another: on average 1.3 times as fast.
  change(0, [](StudyRun& run) { run.times_ms = {run.query == 1 ? 4.0 : 0.75}; });
  const std::string words = wordsOf(timeFinding(StudyData(plan_, runs_)));
  EXPECT_TRUE(contains(words, "no difference in time between a_star octile and dijkstra"));
  EXPECT_FALSE(contains(words, "times as long as"));
}

TEST_F(FindingsTest, APathThatCostsMoreIsNotOptimal) {
  change(2, [](StudyRun& run) { run.cost = run.query == 0 ? 11.0 : 10.0; });
  const Table table = optimalFinding(StudyData(plan_, runs_)).table;
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[0][3].number, 1.0);
  EXPECT_NEAR(*table.rows[2][3].number, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(*table.rows[2][6].number, 0.1, 1e-12);
}

// Found by a newcomer: an any-angle path that cost less was said to cost the same.
TEST_F(FindingsTest, OnlyPathsThatCostTheSameAreComparedInLengthAtTheSameCost) {
  change(0, [](StudyRun& run) { run.length_m = 12.0 + 0.01 * run.query; });
  change(1, [](StudyRun& run) { run.cost = 12.0; });
  EXPECT_TRUE(contains(wordsOf(optimalFinding(StudyData(plan_, runs_))), "which cost the same"));
  change(2, [](StudyRun& run) { run.cost = 9.0; });
  EXPECT_FALSE(contains(wordsOf(optimalFinding(StudyData(plan_, runs_))), "which cost the same"));
}

TEST_F(FindingsTest, AnIncompleteStudySaysSo) {
  const auto report = [&] {
    const StudyData data(plan_, runs_);
    return reportHtml(data, findingsOf(data), {}, "grid_path study x.yaml");
  };
  EXPECT_FALSE(contains(report(), "Not complete"));
  runs_.resize(6);
  EXPECT_TRUE(contains(report(), "Not complete:</b> 6 of 36 runs are done"));
}

TEST_F(FindingsTest, ShortestCountsTiesForAllAndAloneForOne) {
  change(2, [](StudyRun& run) {
    run.length_m = run.query == 0 ? 9.0 : run.query == 1 ? 12.0 : 10.0;
  });
  const Table table = shortestFinding(StudyData(plan_, runs_)).table;
  ASSERT_EQ(table.rows.size(), 2u) << "the two heuristics of a_star";
  EXPECT_NEAR(*table.rows[0][3].number, 2.0 / 3.0, 1e-12) << "octile: queries 1 and 2";
  EXPECT_NEAR(*table.rows[0][5].number, 1.0 / 3.0, 1e-12) << "alone: query 1";
  EXPECT_NEAR(*table.rows[1][3].number, 2.0 / 3.0, 1e-12) << "euclidean: queries 0 and 2";
}

TEST_F(FindingsTest, KernelsAreComparedOnTheSameQueryAndWeights) {
  for (StudyRun& run : runs_)
    if (plan_.study().settings[run.setting].costmap.kernel == 2) run.expanded = 25;
  const Table table = kernelFinding(StudyData(plan_, runs_)).table;
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[0][3].number, 6.0) << "three queries, two sets of weights";
  EXPECT_NEAR(*table.rows[0][6].number, 4.0, 1e-9);
}

TEST_F(FindingsTest, RunsThatFoundNothingAreLeftOutOfComparisons) {
  change(1, [](StudyRun& run) {
    if (run.query == 0) run.status = Status::TIMEOUT;
    if (run.query == 0) run.times_ms = {5000.0};
  });
  const Table table = timeFinding(StudyData(plan_, runs_)).table;
  EXPECT_EQ(table.rows[1][4].number, 4.0) << "of six runs at kernel 1 four found a path";
  EXPECT_EQ(table.rows[1][7].number, 1.0);
}

TEST_F(FindingsTest, TheReportNeedsNothingFromOutside) {
  const StudyData data(plan_, runs_);
  std::string html = reportHtml(data, findingsOf(data), {}, "grid_path study x.yaml");
  const std::string name_of_svg = "http://www.w3.org/2000/svg";  // a name, which nothing fetches
  html.erase(html.find(name_of_svg), name_of_svg.size());
  for (const char* outside : {"src=", "http:", "https:", "@import", "url("})
    EXPECT_FALSE(contains(html, outside)) << outside;
  EXPECT_TRUE(contains(html, "A small study"));
  EXPECT_TRUE(contains(html, "data:image/png;base64,"));
}

TEST_F(FindingsTest, TextsCannotBreakTheReport) {
  runs_[0].note = "</script><script>alert(1)</script>";
  runs_[0].message = "<b>";
  const StudyData data(plan_, runs_);
  const StudyFailure failure{"a <i>unit</i>", "\"reason\""};
  const std::string html = reportHtml(data, findingsOf(data), {failure}, "a & b");
  EXPECT_FALSE(contains(html, "<script>alert"));
  EXPECT_FALSE(contains(html, "<i>unit"));
  EXPECT_TRUE(contains(html, "a &amp; b"));
}

TEST_F(FindingsTest, CsvAndJsonHoldEveryRun) {
  runs_[0].note = "a \"note\", with a comma";
  const StudyData data(plan_, runs_);
  const std::string csv = csvOf(runsTable(data));
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), runs_.size() + 1);
  EXPECT_TRUE(contains(csv, "\"a \"\"note\"\", with a comma\""));
  const auto json = nlohmann::json::parse(jsonReport(data, findingsOf(data), {}));
  EXPECT_EQ(json["runs"].size(), runs_.size());
  EXPECT_EQ(json["variants"].size(), 3u);
}

}  // namespace
}  // namespace grid_path_planner::study
