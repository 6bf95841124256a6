#include <gtest/gtest.h>

#include <sstream>

#include "run_command.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::command_line {
namespace {

using test::contains;

class StudyCommand : public testing::Test {
 protected:
  Outcome study(const std::string& text, std::vector<std::string> more = {}) {
    const std::string file = folder_.write("study.yaml", text);
    std::vector<std::string> arguments = {"study", file, "--out", folder_.path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runCommand(runStudyCommand, arguments);
  }

  static std::string text(const std::string& planners, const std::string& map = "small.map") {
    return "maps: [" + map + "]\nplanners: [" + planners +
           "]\nqueries: {pairs: [[[0, 0], [3, 2]]]}\nkernels: [1, 2]\nrepeats: 1\n";
  }

  const test::TemporaryFolder folder_;
  const std::string map_ = folder_.write("small.map",
                                         "type octile\nheight 3\nwidth 4\nmap\n"
                                         "....\n"
                                         ".@@.\n"
                                         "....\n");
};

TEST_F(StudyCommand, LeavesReportAndTables) {
  const Outcome outcome = study(text("dijkstra, a_star"), {"--jobs", "2"});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_TRUE(contains(outcome.printed, "questions=2 resumed=0 runs=4 failed=0"));
  for (const char* name : {"report.html", "runs.csv", "time.csv", "study.json"})
    EXPECT_FALSE(test::contentOf(folder_.path(std::string("out/") + name)).empty()) << name;
}

TEST_F(StudyCommand, AskedAgainItResumes) {
  study(text("a_star"));
  EXPECT_TRUE(contains(study(text("a_star")).printed, "resumed=2"));
}

// One folder must not hold half of one study and half of another.
TEST_F(StudyCommand, AChangedStudyDoesNotGoOnInTheFolderOfAnother) {
  study(text("a_star"));
  const std::string before = test::contentOf(folder_.path("out/report.html"));
  const Outcome outcome = study(text("dijkstra"));
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_TRUE(contains(outcome.error, "holds the runs of another study")) << outcome.error;
  EXPECT_EQ(test::contentOf(folder_.path("out/report.html")), before);
}

TEST_F(StudyCommand, BadInputNamesFileAndLine) {
  EXPECT_TRUE(contains(study(text("a_star", "gone.map")).error, "gone.map"));
  EXPECT_TRUE(contains(study(text("b_star")).error, "study.yaml:2: planner must be one of"));
  EXPECT_TRUE(contains(study(text("a_star"), {"--jobs", "0"}).error, "--jobs must be from 1"));
  EXPECT_TRUE(contains(study("maps: [").error, "study.yaml"));
}

}  // namespace
}  // namespace grid_path_planner::command_line
