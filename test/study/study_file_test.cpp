#include <gtest/gtest.h>

#include "grid_path_planner/grid/map_file.h"
#include "study/report/report.h"
#include "study/study.h"
#include "study/study_plan.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::study {

using costmap::CostmapOptions;
using grid::Cell;
using grid::OccupancyGrid;
using grid::readMapFile;
using grid::writeMapServerFile;
using planners::Heuristic;

namespace {

using test::AsciiMap;
using test::contains;
using test::errorText;
using test::TemporaryFolder;

OccupancyGrid readMap(const std::string& file) {
  return readMapFile(file);
}

const char* const kSmallStudy = R"(
title: small
maps: [site.yaml]
planners: [dijkstra, a_star]
heuristics: [octile, zero]
kernels: [1, 2]
weights: [[1, 50, 100], [2, 3, 4]]
options: {radius: 0}
queries:
  pairs: [[[0, 0], [3, 1]]]
repeats: 2
)";

class StudyFileTest : public testing::Test {
 protected:
  StudyFileTest() {
    writeMapServerFile(folder_.path("site.yaml"), AsciiMap({"....",  //
                                                            "..#."})
                                                      .map);
  }

  std::string written(const std::string& text) const { return folder_.write("study.yaml", text); }
  Study read(const std::string& text) const { return readStudyFile(written(text)); }
  std::string refusal(const std::string& text) const {
    const std::string file = written(text);
    return errorText([&] { StudyPlan(readStudyFile(file), readMap); });
  }
  // kSmallStudy with one line replaced.
  static std::string with(const std::string& line, const std::string& other) {
    std::string text = kSmallStudy;
    const std::size_t at = text.find(line);
    EXPECT_NE(at, std::string::npos) << line;
    return text.replace(at, line.size(), other);
  }

  TemporaryFolder folder_;
};

TEST_F(StudyFileTest, IsTheProductOfItsLists) {
  const Study study = read(kSmallStudy);
  EXPECT_EQ(study.title, "small");
  ASSERT_EQ(study.maps.size(), 1u);
  EXPECT_EQ(study.maps[0].name, "site");
  EXPECT_EQ(study.maps[0].file, folder_.path("site.yaml")) << "relative to the study file";
  EXPECT_EQ(study.settings.size(), 4u) << "two kernels, two sets of weights";
  EXPECT_EQ(study.settings[1].costmap.occupied_weight, 4);
  EXPECT_EQ(study.settings[2].costmap.kernel, 2);
  ASSERT_EQ(study.variants.size(), 3u) << "dijkstra is not guided by a heuristic";
  EXPECT_EQ(study.variants[0].label, "dijkstra");
  EXPECT_EQ(study.variants[1].label, "a_star octile");
  EXPECT_EQ(study.variants[2].search.heuristic, Heuristic::ZERO);
}

TEST_F(StudyFileTest, WhatIsNotThereIsAsThePlannersDefaultsSay) {
  const Study study =
      read("maps: [site.yaml]\nplanners: [a_star]\nqueries: {random: {count: 1}}\n");
  ASSERT_EQ(study.settings.size(), 1u);
  EXPECT_EQ(study.settings[0].costmap.kernel, CostmapOptions().kernel);
  EXPECT_EQ(study.settings[0].weights, "1/50/100");
  EXPECT_EQ(study.variants.size(), 1u);
  EXPECT_EQ(study.repeats, 5);
}

TEST_F(StudyFileTest, TheTwoThatComeWithThePackageAreRead) {
  for (const char* file :
       {"config/study_thesis.yaml", "config/study_today.yaml", "config/study_rectangles.yaml"}) {
    const StudyPlan plan(readStudyFile(file), readMap);
    EXPECT_GT(plan.units().size(), 0u) << file;
  }
  const Study thesis = readStudyFile("config/study_thesis.yaml");
  EXPECT_EQ(thesis.settings.size(), 36u) << "two maps, three kernels, two borders, three weights";
  EXPECT_EQ(thesis.variants.size(), 14u) << "Dijkstra and three A*, twice; six variations";
  EXPECT_EQ(thesis.maps[0].queries.pairs.size(), 23u) << "ten as run, ten as printed, Dijkstra's";
  EXPECT_TRUE(thesis.settings[0].costmap.occupied_is_passable);
}

TEST_F(StudyFileTest, KnowsTheProgramsThatAreInStudiesOnly) {
  const Study study = read(with("planners: [dijkstra, a_star]",
                                "planners: [theta_star, a_star, a_star_published]\n"
                                "tie_breaks: [larger_g, cross_product_published]"));
  ASSERT_EQ(study.variants.size(), 6u) << "theta_star is not guided by a heuristic";
  EXPECT_EQ(study.variants[1].label, "a_star octile");
  EXPECT_EQ(study.variants[3].label, "a_star_published octile");
  EXPECT_FALSE(study.variants[3].published_cross);
  EXPECT_EQ(study.variants[5].label, "a_star_published cross_product_published")
      << "once, since it takes the place of the heuristic";
  EXPECT_TRUE(study.variants[5].published_cross);
  EXPECT_TRUE(contains(refusal(with("radius: 0", "tie_break: cross_product_published")),
                       "is for a_star_published"));
}

TEST_F(StudyFileTest, BordersAndGroupsOfPairs) {
  const Study study = read(
      with("pairs: [[[0, 0], [3, 1]]]",
           "pairs: {as_run: [[[0, 0], [3, 1]], [[1, 0], [3, 1]]], other: [[[2, 0], [0, 1]]]}") +
      "borders: [filled, unfilled]\n");
  EXPECT_EQ(study.settings.size(), 8u) << "two kernels, two borders, two sets of weights";
  EXPECT_EQ(study.settings[0].border, Border::FILLED);
  EXPECT_EQ(study.settings[2].border, Border::UNFILLED);
  EXPECT_TRUE(contains(study.settings[2].label, "border unfilled"));
  const StudyPlan plan(study, readMap);
  ASSERT_EQ(plan.queries(0).size(), 3u);
  EXPECT_EQ(plan.queries(0)[1].group, "as_run");
  EXPECT_EQ(plan.queries(0)[1].number, 2);
  EXPECT_EQ(plan.queries(0)[2].group, "other");
  EXPECT_EQ(plan.queries(0)[2].number, 1);

  const std::vector<StudyRun> no_runs;
  const StudyData data(plan, no_runs);
  StudyRun run;
  EXPECT_NE(planCommand(data, run), "");
  run.setting = 2;
  EXPECT_EQ(planCommand(data, run), "") << "grid_path plan has no unfilled border";
}

TEST_F(StudyFileTest, PublishedCellsAreFiguresWhereTheyCanBe) {
  EXPECT_EQ(publishedCells("164/165/196").figures, (std::vector<int>{164, 165, 196}));
  EXPECT_EQ(publishedCells("104/?/?").figures, (std::vector<int>{104, 0, 0}));
  EXPECT_EQ(publishedCells("?").figures, std::vector<int>{0});
  EXPECT_EQ(publishedCells("97, one of the three").text, "97, one of the three");
  const Study thesis = readStudyFile("config/study_thesis.yaml");
  EXPECT_EQ(thesis.published.cells.at(5).at(5).text, "104/?/?");
  EXPECT_EQ(thesis.published.border_cells.at(1).at(7), "43 of 92");
}

struct BadLine {
  const char* line;
  const char* instead;
  const char* says;  // with its line
};

TEST_F(StudyFileTest, ABadLineIsNamed) {
  const BadLine bad[] = {
      {"title: small", "titel: small", ":2: the study has no 'titel'"},
      {"maps: [site.yaml]", "maps: []", ":3: maps is an empty list"},
      {"maps: [site.yaml]", "maps: [gone.yaml]", "gone.yaml"},
      {"maps: [site.yaml]", "maps: [site.yaml, site.yaml]", ":3: maps names 'site.yaml' twice"},
      {"planners: [dijkstra, a_star]", "planners: [dijkstra, b_star]",
       ":4: planner must be one of"},
      {"planners: [dijkstra, a_star]", "planners: [coarse_to_fine]",
       ":4: planner 'coarse_to_fine' is retired: take a_star or weighted_jump_point"},
      {"planners: [dijkstra, a_star]", "planners: []", ":4: planners is an empty list"},
      {"heuristics: [octile, zero]", "heuristics: [octal]", ":5: heuristics must be one of"},
      {"kernels: [1, 2]", "kernels: [0]", ":6: a kernel must be a whole number"},
      {"kernels: [1, 2]", "kernels: 3", ":6: kernels must be a list"},
      {"[2, 3, 4]", "[2, 3]", ":7: weights must be [free, unknown, occupied]"},
      {"radius: 0", "radios: 0", ":8: there is no option 'radios'"},
      {"radius: 0", "radius: -1", ":8: radius must be a number from 0"},
      {"radius: 0", "planner: dijkstra", ":8: planner stands in 'planners' already"},
      {"[3, 1]", "[4, 1]", "the goal (4, 1) of a query is outside its 4x2 cells"},
      {"[3, 1]", "[3]", ":10: a cell must be [column, row]"},
      {"repeats: 2", "repeats: 0", ":11: repeats must be a whole number from 1"},
  };
  for (const BadLine& each : bad) {
    const std::string text = refusal(with(each.line, each.instead));
    EXPECT_TRUE(contains(text, each.says)) << each.instead << ": " << text;
  }
}

TEST_F(StudyFileTest, ABlockedEndIsReplacedByTheNearestFreeCellAndNamed) {
  const StudyPlan plan(read(with("[3, 1]", "[2, 1]")), readMap);
  ASSERT_EQ(plan.queries(0).size(), 1u);
  const StudyQuery& query = plan.queries(0)[0];
  EXPECT_EQ(query.goal, (Cell{2, 0})) << "of the equally near ones that with the lowest index";
  EXPECT_EQ(query.note, "goal (2, 1) is blocked, (2, 0) taken");
}

TEST_F(StudyFileTest, RandomQueriesAreThoseOfTheirSeedAndCanBeAnswered) {
  writeMapServerFile(folder_.path("site.yaml"), AsciiMap({"...#...",  //
                                                          "...#...",  //
                                                          "...#..."})
                                                    .map);
  const std::string text = with("pairs: [[[0, 0], [3, 1]]]", "random: {count: 30, seed: 7}");
  const auto queriesOf = [&](const std::string& study) {
    return StudyPlan(read(study), readMap).queries(0);
  };
  const auto first = queriesOf(text), again = queriesOf(text);
  ASSERT_EQ(first.size(), 30u);
  bool other = false;
  const auto third = queriesOf(with("pairs: [[[0, 0], [3, 1]]]", "random: {count: 30, seed: 8}"));
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].start, again[i].start);
    EXPECT_EQ(first[i].goal, again[i].goal);
    EXPECT_EQ(first[i].start.column < 3, first[i].goal.column < 3)
        << "on the same side of the wall";
    EXPECT_NE(first[i].start, first[i].goal);
    other = other || first[i].start != third[i].start;
  }
  EXPECT_TRUE(other) << "another seed asks other questions";
}

}  // namespace
}  // namespace grid_path_planner::study
