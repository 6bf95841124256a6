#include "study/findings/verdicts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "grid_path_planner/grid/map_file.h"
#include "small_study.h"
#include "study/findings/published_cases.h"
#include "study/study_plan.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::study {

namespace {

using test::contains;
using test::TemporaryFolder;

constexpr const char* kPublishedStudy = R"(
maps: [site.yaml]
planners: [dijkstra_published, a_star_published_crossing]
heuristics: [euclidean, manhattan]
kernels: [1, 2]
weights: [[1, 50, 100], [1, 2, 100], [40, 50, 60]]
options: {occupied_is_passable: true, diagonal_cost: unit, cut_corners: true, radius: 0}
queries: {pairs: {as_run: [[[0, 0], [5, 3]], [[1, 0], [5, 3]], [[2, 0], [5, 3]], [[3, 0], [5, 3]],
                           [[0, 1], [5, 3]], [[1, 1], [5, 3]]]}}
repeats: 1
published:
  source: a test
  group: as_run
  planner: a_star_published_crossing
  crossing: {1/2/100: unknown, 40/50/60: occupied}
  conclusions: true
)";

StudyPlan planIn(const TemporaryFolder& folder) {
  grid::writeMapServerFile(folder.path("site.yaml"), test::AsciiMap({"......",  //
                                                                     "..??..",  //
                                                                     "..##..",  //
                                                                     "......"})
                                                         .map);
  return StudyPlan(readStudyFile(folder.write("study.yaml", kPublishedStudy)),
                   [](const std::string& file) { return grid::readMapFile(file); });
}

// Runs that are invented, so that the verdicts are known: variant 0 is Dijkstra, 1 A* with the Euclidean
// heuristic, 2 with Manhattan's.
class VerdictsTest : public testing::Test {
 protected:
  VerdictsTest() {
    for (const StudyUnit& unit : plan_.units())
      for (std::size_t variant = 0; variant < 3; ++variant) {
        StudyRun run = test::inventedRun(unit, variant);
        run.cells = 100;
        run.bytes = 1000;
        run.times_ms = {1.0};
        runs_.push_back(run);
      }
  }

  template <class Change>
  void change(std::size_t variant, Change&& change) {
    for (StudyRun& run : runs_)
      if (run.variant == variant) change(run);
  }
  int kernelOf(const StudyRun& run) const {
    return plan_.study().settings[run.setting].costmap.kernel;
  }
  const std::string& weightsOf(const StudyRun& run) const {
    return plan_.study().settings[run.setting].weights;
  }

  std::vector<Conclusion> all() const {
    std::vector<Conclusion> conclusions = conclusionsOf(StudyData(plan_, runs_));
    correctForAll(conclusions);
    return conclusions;
  }
  // C1 is the first.
  Conclusion verdict(std::size_t number) const { return all().at(number - 1); }

  const TemporaryFolder folder_;
  const StudyPlan plan_ = planIn(folder_);
  std::vector<StudyRun> runs_;
};

TEST_F(VerdictsTest, AreNineEachWithReasonAndCommand) {
  const std::vector<Conclusion> conclusions = all();
  ASSERT_EQ(conclusions.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(conclusions[i].name, "C" + std::to_string(i + 1));
    EXPECT_FALSE(conclusions[i].reason.empty()) << i;
    EXPECT_TRUE(contains(conclusions[i].command, "grid_path ")) << i;
  }
  const Finding finding = verdictsFinding(StudyData(plan_, runs_));
  EXPECT_EQ(finding.table.rows.size(), 9u);
  EXPECT_EQ(finding.answers.size(), 9u);
}

TEST_F(VerdictsTest, DijkstraMissesWhereOneSearchDoes) {
  EXPECT_EQ(verdict(1).verdict, Verdict::REFUTED);
  for (StudyRun& run : runs_)
    if (run.variant == 0 && run.query == 3) run.cost = 10.1;
  EXPECT_EQ(verdict(1).verdict, Verdict::CONFIRMED);
}

TEST_F(VerdictsTest, TimesOfProgramsOfDifferentKindsAreNotCompared) {
  change(0, [](StudyRun& run) { run.times_ms = {1000.0 + run.query}; });
  EXPECT_EQ(verdict(2).verdict, Verdict::CANNOT_BE_TESTED);
  const StudyData data(plan_, runs_);
  EXPECT_EQ(data.baselineOf(0), 0u);
  EXPECT_EQ(data.baselineOf(2), 1u) << "A* with A*, not with Dijkstra";
  for (const std::string& answer : timeFinding(data).answers)
    EXPECT_FALSE(contains(answer, "dijkstra")) << answer;
}

TEST_F(VerdictsTest, EuclideanIsOptimalWhereEveryCaseOfTheSmallestKernelIs) {
  change(1, [&](StudyRun& run) { run.cost = kernelOf(run) == 2 ? 11.0 : 10.0; });
  EXPECT_EQ(verdict(3).verdict, Verdict::CONFIRMED) << "kernel 2 is not asked about";
  change(1, [](StudyRun& run) { run.cost = run.query == 0 ? 11.0 : 10.0; });
  EXPECT_EQ(verdict(3).verdict, Verdict::REFUTED);
  EXPECT_TRUE(contains(verdict(3).reason, "5 of 6 cases"));
}

TEST_F(VerdictsTest, TwiceAsMuchIsRefutedWhereTheIntervalExcludesTwo) {
  change(0, [](StudyRun& run) { run.cells = 100 + run.query; });
  EXPECT_EQ(verdict(4).verdict, Verdict::REFUTED);
  change(0, [](StudyRun& run) { run.cells = run.query % 2 == 0 ? 190 : 210; });
  EXPECT_EQ(verdict(4).verdict, Verdict::CANNOT_BE_TESTED);
  EXPECT_TRUE(contains(verdict(4).reason, "do not separate it from chance"));
}

TEST_F(VerdictsTest, ShortestIsCountedByCellsOverThePairs) {
  change(2, [](StudyRun& run) { run.cells = 101; });
  EXPECT_EQ(verdict(5).verdict, Verdict::CONFIRMED);
  change(2, [](StudyRun& run) { run.cells = 99; });
  EXPECT_EQ(verdict(5).verdict, Verdict::REFUTED);
  change(2, [](StudyRun& run) { run.cells = run.query < 3 ? 99 : 101; });
  EXPECT_EQ(verdict(5).verdict, Verdict::CANNOT_BE_TESTED);
}

TEST_F(VerdictsTest, KernelsAreComparedWithinOneProgram) {
  change(1, [&](StudyRun& run) {
    run.times_ms = {kernelOf(run) == 1 ? 4.0 + 0.1 * static_cast<double>(run.query) : 1.0};
  });
  EXPECT_EQ(verdict(6).verdict, Verdict::CONFIRMED);
  change(1,
         [&](StudyRun& run) { run.times_ms = {run.query < 3 && kernelOf(run) == 1 ? 2.0 : 1.4}; });
  EXPECT_EQ(verdict(6).verdict, Verdict::CANNOT_BE_TESTED);
}

TEST_F(VerdictsTest, ValuesDecideWhereBothWeightsSendPathsElsewhere) {
  change(1, [&](StudyRun& run) {
    const double more = 0.01 * static_cast<double>(run.query);
    run.unknown_m = weightsOf(run) == "1/2/100" ? 3.0 + more : 1.0;
    run.occupied_m = weightsOf(run) == "40/50/60" ? 2.0 + more : 0.0;
  });
  EXPECT_EQ(verdict(7).verdict, Verdict::CONFIRMED);
  change(1, [](StudyRun& run) { run.occupied_m = run.query % 2 == 0 ? 1.0 : 0.0; });
  EXPECT_EQ(verdict(7).verdict, Verdict::CANNOT_BE_TESTED) << "one of the two alone is not it";
}

TEST_F(VerdictsTest, RectanglesHaveAStudyOfTheirOwn) {
  EXPECT_EQ(verdict(9).verdict, Verdict::CANNOT_BE_TESTED);
  EXPECT_TRUE(contains(verdict(9).command, "config/study_rectangles.yaml"));
}

// The whole process is what counts: here a search on cells takes 8 or 12 ms, one on rectangles 1 ms, and
// cutting them as long as a test says.
class RectangleVerdictTest : public testing::Test {
 protected:
  Conclusion verdictWith(double preparation_ms) {
    std::vector<StudyRun> runs;
    for (const StudyUnit& unit : plan_.units())
      for (std::size_t variant = 0; variant < 2; ++variant) {
        StudyRun run = test::inventedRun(unit, variant);
        run.times_ms = {variant == 1 ? 1.0 : unit.query % 2 == 0 ? 8.0 : 12.0};
        run.preparation_ms = variant == 0 ? 0.0 : preparation_ms;
        runs.push_back(run);
      }
    std::vector<Conclusion> all = conclusionsOf(StudyData(plan_, runs));
    EXPECT_EQ(all.size(), 1u) << "C9 alone";
    correctForAll(all);
    return all.at(0);
  }

  const TemporaryFolder folder_;
  const StudyPlan plan_ = [this] {
    grid::writeMapServerFile(folder_.path("rooms.yaml"),
                             test::AsciiMap({"...#....",  //
                                             "...#....",  //
                                             "........",  //
                                             "...#...."})
                                 .map);
    return StudyPlan(readStudyFile(folder_.write("study.yaml", R"(
maps: [rooms.yaml]
planners: [dijkstra, rectangle_map]
kernels: [1]
weights: [[1, 1, 100]]
queries: {random: {count: 6, seed: 1}}
published: {source: a test, conclusions: true}
)")),
                     [](const std::string& file) { return grid::readMapFile(file); });
  }();
};

TEST_F(RectangleVerdictTest, CountsTheCutAndOnePlan) {
  EXPECT_EQ(verdictWith(50.0).verdict, Verdict::REFUTED);
  EXPECT_EQ(verdictWith(5.0).verdict, Verdict::CONFIRMED);
  EXPECT_EQ(verdictWith(9.0).verdict, Verdict::CANNOT_BE_TESTED) << "10 against 8 and 12";
}

TEST_F(RectangleVerdictTest, SaysTheBytesOfTheRectangles) {
  EXPECT_TRUE(contains(verdictWith(50.0).reason, "rooms 24 of 4.")) << verdictWith(50.0).reason;
}

// Two tests at 0.04 each: together one of them is likely to be chance.
TEST(Verdicts, ThatTheCorrectionDoesNotBearAreWithdrawn) {
  Conclusion tested;
  tested.verdict = Verdict::CONFIRMED;
  tested.p = 0.04;
  tested.needs_test = true;
  std::vector<Conclusion> one = {tested}, two = {tested, tested};
  two[1].verdict = Verdict::REFUTED;
  correctForAll(one);
  correctForAll(two);
  EXPECT_EQ(one[0].verdict, Verdict::CONFIRMED);
  EXPECT_EQ(two[0].verdict, Verdict::CANNOT_BE_TESTED);
  EXPECT_EQ(two[1].verdict, Verdict::CANNOT_BE_TESTED);
  EXPECT_DOUBLE_EQ(two[0].corrected_p, 0.08);
}

// --- preparation ---------------------------------------------------------------------------------

TEST(Preparation, PaysFromTheFirstQueryThatMakesTheSumLess) {
  EXPECT_EQ(queriesUntilCheaper(10.0, 1.0, 0.0, 2.0), 11.0) << "at 10 both take 20";
  EXPECT_EQ(queriesUntilCheaper(0.0, 1.0, 0.0, 2.0), 1.0);
  EXPECT_TRUE(std::isinf(queriesUntilCheaper(10.0, 2.0, 0.0, 2.0)));
  EXPECT_TRUE(std::isinf(queriesUntilCheaper(10.0, 3.0, 0.0, 2.0)));
}

TEST_F(VerdictsTest, PreparationIsComparedWithinOneProgram) {
  change(0, [](StudyRun& run) { run.times_ms = {0.001}; });
  change(1, [](StudyRun& run) { run.preparation_ms = 10.0; });
  change(2, [](StudyRun& run) { run.times_ms = {3.0}; });
  const Table table = preparationFinding(StudyData(plan_, runs_)).table;
  ASSERT_EQ(table.rows.size(), 6u) << "three variants at two kernels";
  EXPECT_EQ(table.rows[0][9].text, "the first") << "Dijkstra alone of its kind";
  EXPECT_EQ(table.rows[1][9].text, "6") << "10 + 6 is less than 18, 10 + 5 is 15";
  EXPECT_EQ(table.rows[2][9].text, "the first") << "of the A*, though Dijkstra takes less";
  EXPECT_EQ(table.rows[1][6].number, 11.0) << "the first plan, preparation and all";
}

// Long repeats turned the mean: "euclidean takes less than manhattan from 2 queries on" stood above an
// interval of medians by which manhattan plans faster.
TEST_F(VerdictsTest, PreparationPaysOnlyWhereMeansAndIntervalAgree) {
  change(1, [](StudyRun& run) {
    run.preparation_ms = 8.0;
    run.times_ms = {1.2 + 0.01 * static_cast<double>(run.query)};
  });
  change(2, [](StudyRun& run) { run.times_ms = {1.0, 1.0, 19.0}; });
  const Table table = preparationFinding(StudyData(plan_, runs_)).table;
  EXPECT_EQ(table.rows[2][9].text, "the first") << "7 ms on average, less than 8 + 1.2";
  EXPECT_EQ(table.rows[1][9].text, "not certain") << "its mean is less, its medians are not";
}

TEST(PreparationLaw, IsTheFirstQueryOfACount) {
  std::mt19937 random(15);
  for (int trial = 0; trial < 300; ++trial) {
    const double prepared = random() % 200, plan = 1 + random() % 20;
    const double other_prepared = random() % 50, other_plan = 1 + random() % 20;
    if (prepared < other_prepared) continue;
    double first = std::numeric_limits<double>::infinity();
    for (int queries = 1; queries <= 1000 && std::isinf(first); ++queries)
      if (prepared + queries * plan < other_prepared + queries * other_plan) first = queries;
    EXPECT_EQ(queriesUntilCheaper(prepared, plan, other_prepared, other_plan), first)
        << "trial " << trial;
  }
}

// --- counts --------------------------------------------------------------------------------------

TEST_F(VerdictsTest, CountsAreOfCellsAndOfMetres) {
  change(2, [](StudyRun& run) {
    run.cells = run.query == 0 ? 90 : 101;
    run.length_m = 9.0;
  });
  const Table table = countsFinding(StudyData(plan_, runs_)).table;
  ASSERT_EQ(table.rows.size(), 2u) << "euclidean and manhattan";
  EXPECT_EQ(table.rows[0][5].number, 12.0) << "six pairs at two kernels, the first weights";
  EXPECT_EQ(table.rows[0][6].number, 10.0);
  EXPECT_EQ(table.rows[1][6].number, 2.0);
  EXPECT_EQ(table.rows[0][9].number, 0.0);
  EXPECT_EQ(table.rows[1][9].number, 1.0);
}

TEST_F(VerdictsTest, SharesOfTheMapAreCounted) {
  const Table table = mapsFinding(StudyData(plan_, runs_)).table;
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_NEAR(*table.rows[0][4].number, 100.0 * 20 / 24, 1e-9);
  EXPECT_NEAR(*table.rows[0][5].number, 100.0 * 2 / 24, 1e-9);
  EXPECT_NEAR(*table.rows[0][6].number, 100.0 * 2 / 24, 1e-9);
}

}  // namespace
}  // namespace grid_path_planner::study
