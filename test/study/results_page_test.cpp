// doc/study_results.md: what `grid_path study --results` wrote, and whether it is still so.
#include "study/report/results_page.h"

#include <gtest/gtest.h>

#include <sstream>

#include "grid_path_planner/grid/map_file.h"
#include "small_study.h"
#include "study/study_worker.h"
#include "support/error_text.h"

namespace grid_path_planner::study {
namespace {

using test::contains;
using test::TemporaryFolder;

constexpr int kRepeatedKernel = 7;  // the quickest

std::vector<std::string> linesIn(const std::string& text, const std::string& part) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (contains(line, part)) lines.push_back(line);
  return lines;
}

// The published pairs at the repeated kernel, with the first weights.
std::vector<StudyRun> repeatedRuns(const StudyPlan& plan) {
  std::vector<StudyRun> runs;
  StudyWorker worker(plan);
  for (const StudyUnit& unit : plan.units()) {
    const StudySetting& setting = plan.study().settings[unit.setting];
    const StudyQuery& query = plan.queries(setting.map)[unit.query];
    if (setting.costmap.kernel != kRepeatedKernel || query.group != "as_run" ||
        setting.weights != plan.study().settings.front().weights)
      continue;
    for (const StudyRun& run : worker.run(unit)) runs.push_back(run);
  }
  return runs;
}

TEST(StudyResults, OfTheRepositoryAreFoundAgain) {
  Study study = readStudyFile("config/study_thesis.yaml");
  study.repeats = 1;
  const StudyPlan plan(study, [](const std::string& file) { return grid::readMapFile(file); });
  const std::vector<StudyRun> runs = repeatedRuns(plan);
  const StudyData data(plan, runs);
  const std::string kept = test::contentOf("doc/study_results.md");
  std::size_t compared = 0;
  for (const StudyMap& map : study.maps)
    for (int pair = 1; pair <= 10; ++pair) {
      const std::string head = "| " + map.name + " | " + std::to_string(pair) + " | " +
                               std::to_string(kRepeatedKernel) + " | ";
      const std::string page = resultsPage(data, {cellsFinding(data)}, {}, "", "");
      for (const std::string& line : linesIn(page, head)) {
        EXPECT_TRUE(contains(kept, line + '\n')) << line;
        ++compared;
      }
    }
  EXPECT_EQ(compared, 20u) << "ten pairs on two maps";
}

TEST(ResultsPage, SaysWhereItIsFromAndHoldsTheTables) {
  const TemporaryFolder files;
  const StudyPlan plan = test::smallStudy(files);
  StudyFolder folder(files.path("out"), plan.fingerprint());
  const StudyResult result = test::runWith(plan, folder, 1);
  const StudyData data(plan, result.runs);
  Finding finding = mapsFinding(data);
  finding.answers = {"A* and a|b"};
  const std::string page = resultsPage(
      data, {finding}, {"grid_path study x.yaml", "25a6d1f", "2026-11-22"}, "t.svg", "");
  EXPECT_TRUE(contains(
      page, "Written on 2026-11-22, with the runs of commit 25a6d1f by\n\n    grid_path study"));
  EXPECT_TRUE(contains(page, "- A\\* and a\\|b\n"));
  EXPECT_TRUE(contains(page, "| site | 7 | 6 | 1 |"));
  EXPECT_TRUE(contains(page, "](t.svg)"));
  EXPECT_EQ(linesIn(page, "![").size(), 1u) << "no link to a picture that is not there";
}

TEST(ResultsPage, PicturesStandAlone) {
  const TemporaryFolder files;
  const StudyPlan plan = test::smallStudy(files);
  StudyFolder folder(files.path("out"), plan.fingerprint());
  const StudyResult result = test::runWith(plan, folder, 1);
  const StudyData data(plan, result.runs);
  const std::string times = timesPicture(data);
  EXPECT_EQ(times.find("<svg xmlns=\"http://www.w3.org/2000/svg\""), 0u);
  EXPECT_TRUE(contains(times, "a_star octile"));
  EXPECT_EQ(pathsPicture(data), "") << "nothing was published that it could show";
}

}  // namespace
}  // namespace grid_path_planner::study
