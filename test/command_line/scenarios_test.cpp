#include <gtest/gtest.h>

#include <algorithm>

#include "run_command.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::command_line {
namespace {

using test::contains;

class Scenarios : public testing::Test {
 protected:
  static Outcome scenarios(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "scenarios");
    return runCommand(runScenarios, arguments);
  }

  static std::string lastLine(const Outcome& outcome) {
    std::string printed = outcome.printed;
    if (!printed.empty() && printed.back() == '\n') printed.pop_back();
    return printed.substr(printed.rfind('\n') + 1);
  }

  // Three queries on a map of 4x3 cells, the third with `optimum`.
  std::string scenario(const std::string& optimum) const {
    folder_.write("small.map", "type octile\nheight 3\nwidth 4\nmap\n....\n.@@.\n....\n");
    return folder_.write("small.map.scen",
                         "version 1\n"
                         "0\tsmall.map\t4\t3\t0\t0\t0\t0\t0\n"
                         "0\tsmall.map\t4\t3\t0\t0\t3\t0\t3\n"
                         "1\tsmall.map\t4\t3\t0\t0\t3\t2\t" +
                             optimum + "\n");
  }

  const test::TemporaryFolder folder_;
};

TEST_F(Scenarios, TheLastLineIsTheContracts) {
  const Outcome outcome = scenarios({"--scen", scenario("5.0")});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_TRUE(contains(lastLine(outcome), "queries=3 solved=3 wrong=0 total_s="))
      << lastLine(outcome);
  EXPECT_TRUE(contains(lastLine(outcome), " mean_ms=")) << lastLine(outcome);
  EXPECT_TRUE(contains(lastLine(outcome), " expanded=")) << lastLine(outcome);
}

TEST_F(Scenarios, AWrongCostFailsWhereOptimalityIsClaimed) {
  const std::string file = scenario("5.0001");
  const Outcome optimal = scenarios({"--scen", file});
  EXPECT_EQ(optimal.code, 1);
  EXPECT_TRUE(contains(lastLine(optimal), "wrong=1")) << lastLine(optimal);
  EXPECT_EQ(scenarios({"--scen", file, "--planner", "lazy_theta_star"}).code, 0);
  EXPECT_EQ(scenarios({"--scen", file, "--epsilon", "2"}).code, 0);
  EXPECT_EQ(scenarios({"--scen", scenario("5.00004")}).code, 0);  // within 1e-5 of it
}

// Files with two decimals called 113 of 240 right answers of the family bg512 wrong.
TEST_F(Scenarios, CostsAreComparedWithAsManyDecimalsAsTheFilePrints) {
  folder_.write("open.map", "type octile\nheight 2\nwidth 4\nmap\n....\n....\n");
  const auto wrong = [&](const std::string& diagonal, const std::string& straight) {
    const std::string file =
        folder_.write("open.map.scen",
                      "version 1\n"
                      "0\topen.map\t4\t2\t0\t0\t1\t1\t" +
                          diagonal + "\n" + "0\topen.map\t4\t2\t0\t0\t3\t0\t" + straight + "\n");
    const std::string line = lastLine(scenarios({"--scen", file}));
    return line.substr(line.find("wrong="), 7);
  };
  EXPECT_EQ(wrong("1.41", "3"), "wrong=0");
  EXPECT_EQ(wrong("1.42", "3"), "wrong=1");
  EXPECT_EQ(wrong("1.4", "3.00"), "wrong=1") << "1.40, of a file that leaves out zeros";
  EXPECT_EQ(wrong("1.4142", "3.0001"), "wrong=1");
}

TEST_F(Scenarios, OptionsOfPosesAreSaidToChangeNothing) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(scenarios({"--scen", scenario("5"), "--tolerance", "3", "--timeout", "1"}).code, 0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "warning: --tolerance changes nothing with scenarios\n"
            "warning: --timeout changes nothing with scenarios\n");
}

TEST_F(Scenarios, LimitSpreadsAndCsvHasALineAQuery) {
  const std::string csv = folder_.path("out.csv");
  const Outcome outcome = scenarios({"--scen", scenario("5"), "--limit", "2", "--csv", csv});
  EXPECT_TRUE(contains(lastLine(outcome), "queries=2 ")) << lastLine(outcome);
  const std::string text = test::contentOf(csv);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  EXPECT_TRUE(contains(text, "0,0,0,0,FOUND,0,0,0,1,")) << text;
}

// The line before the last.
TEST_F(Scenarios, TheHashOfPathsChangesWithAPathOnly) {
  const std::string file = scenario("5");
  const auto hashOf = [&file](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"--scen", file, "--hash-paths"});
    const std::string printed = scenarios(arguments).printed;
    const std::size_t at = printed.rfind("\npath_hash=");
    EXPECT_NE(at, std::string::npos) << printed;
    EXPECT_EQ(printed.find("\nqueries=", at + 1), at + std::string("\npath_hash=").size() + 16)
        << printed;
    return printed.substr(at, std::string("\npath_hash=").size() + 16);
  };
  const std::string hash = hashOf({});
  EXPECT_EQ(hashOf({}), hash);
  EXPECT_EQ(hashOf({"--reference", "dijkstra"}), hash) << "only what costs are compared with";
  EXPECT_NE(hashOf({"--planner", "dijkstra"}), hash) << "equal costs, other paths";
  EXPECT_NE(hashOf({"--limit", "2"}), hash) << "fewer queries";
  EXPECT_NE(hashOf({"--decay", "0.5"}), hash) << "the same cells, other costs";
  EXPECT_NE(hashOf({"--radius", "0.6"}), hash) << "other statuses";
  EXPECT_NE(hashOf({"--planner", "anya"}), hash) << "points";
  EXPECT_NE(hashOf({"--planner", "anya"}), hashOf({"--planner", "anya", "--kernel", "2"}));
  EXPECT_FALSE(contains(scenarios({"--scen", file}).printed, "path_hash")) << "not asked for";
}

TEST_F(Scenarios, WhatInflationChangesIsComparedWithDijkstra) {
  const std::string file = scenario("5");
  const Outcome inflated = scenarios({"--scen", file, "--radius", "0.6"});  // closes both passages
  EXPECT_EQ(inflated.code, 0) << inflated.error;
  EXPECT_TRUE(contains(inflated.printed, " reference=dijkstra unsolvable=2 ")) << inflated.printed;
  EXPECT_TRUE(contains(lastLine(inflated), "queries=1 solved=1 wrong=0 ")) << lastLine(inflated);

  const Outcome weighted = scenarios({"--scen", file, "--decay", "0.5"});
  EXPECT_EQ(weighted.code, 0) << weighted.error;
  EXPECT_TRUE(contains(weighted.printed, " reference=dijkstra unsolvable=0 ")) << weighted.printed;
  EXPECT_TRUE(contains(lastLine(weighted), "queries=3 solved=3 wrong=0 ")) << lastLine(weighted);
  EXPECT_EQ(scenarios({"--scen", file, "--decay", "0.5", "--reference", "file"}).code, 1);
  EXPECT_EQ(scenarios({"--scen", file, "--connectivity", "4"}).code, 0);
  EXPECT_EQ(scenarios({"--scen", file, "--kernel", "2"}).code, 0);
}

TEST_F(Scenarios, AReferenceMayBeNamed) {
  const std::string wrong = scenario("99");
  EXPECT_EQ(scenarios({"--scen", wrong, "--reference", "dijkstra"}).code, 0);
  EXPECT_EQ(scenarios({"--scen", wrong, "--reference", "file"}).code, 1);
  const Outcome unknown = scenarios({"--scen", wrong, "--reference", "nobody"});
  EXPECT_EQ(unknown.code, kBadInput);
  EXPECT_TRUE(contains(unknown.error, "--reference must be file or a planner")) << unknown.error;
  EXPECT_TRUE(contains(unknown.error, "nobody")) << unknown.error;
}

// Each kind of path is judged by what it can be as good as.
TEST_F(Scenarios, AReferenceOfAnyAngleJudgesPathsOfAnyAngle) {
  const std::string file = scenario("5");
  const auto errorOf = [&](const std::string& planner, const std::string& reference) {
    return scenarios({"--scen", file, "--planner", planner, "--reference", reference}).error;
  };
  EXPECT_TRUE(contains(errorOf("a_star", "anya"), "no path over the grid can be as short"));
  EXPECT_TRUE(contains(errorOf("anya", "lazy_theta_star"), "does not promise the least cost"));
  EXPECT_TRUE(contains(errorOf("anya", "theta_star"), "take lazy_theta_star"));
  const Outcome same = scenarios({"--scen", file, "--planner", "anya", "--reference", "anya"});
  EXPECT_TRUE(contains(lastLine(same), "queries=3 solved=3 wrong=0 ")) << same.error;
  const Outcome longer =
      scenarios({"--scen", file, "--planner", "lazy_theta_star", "--reference", "anya"});
  EXPECT_TRUE(contains(lastLine(longer), "queries=3 solved=3 wrong=0 ")) << longer.error;
}

// From a newcomer: refusals were counted as wrong answers, without their sentence.
TEST_F(Scenarios, APlannerThatRefusesTheMapSaysWhy) {
  const Outcome outcome =
      scenarios({"--scen", scenario("5"), "--planner", "jump_point", "--decay", "0.5"});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_TRUE(contains(outcome.error, "jump_point plans only where")) << outcome.error;
  EXPECT_TRUE(contains(outcome.error, "set decay 0, or take a_star")) << outcome.error;
}

TEST_F(Scenarios, APathOfAnyAngleMayBeShorterThanTheGrids) {
  const auto wrongOf = [&](const std::string& optimum) {
    return lastLine(scenarios({"--scen", scenario(optimum), "--planner", "lazy_theta_star"}));
  };
  EXPECT_TRUE(contains(wrongOf("5"), " wrong=0 ")) << wrongOf("5");
  EXPECT_TRUE(contains(wrongOf("3.5"), " wrong=1 ")) << wrongOf("3.5");
  const std::vector<std::string> expensive = {"--scen", scenario("3.5"), "--planner"};
  const auto codeOf = [&expensive](const char* planner) {
    std::vector<std::string> arguments = expensive;
    arguments.emplace_back(planner);
    return scenarios(arguments).code;
  };
  EXPECT_EQ(codeOf("anya"), 1) << "it promises the shortest";
  EXPECT_EQ(codeOf("polyanya"), 1);
  EXPECT_EQ(codeOf("lazy_theta_star"), 0) << "it promises nothing";
}

TEST_F(Scenarios, BadFilesAreNamedWithTheirLine) {
  EXPECT_TRUE(contains(scenarios({"--scen", folder_.path("none.scen")}).error, "none.scen"));
  const std::string map = scenario("5");
  const auto errorOf = [&](const std::string& text) {
    const Outcome outcome = scenarios({"--scen", folder_.write("bad.scen", text)});
    EXPECT_EQ(outcome.code, kBadInput);
    return outcome.error;
  };
  EXPECT_TRUE(contains(errorOf("0 small.map 4 3 0 0 0 0 0\n"), "bad.scen:1"));
  EXPECT_TRUE(contains(errorOf("version 1\n0 small.map 4 3 0 0\n"), "bad.scen:2"));
  EXPECT_TRUE(contains(errorOf("version 1\n0 small.map 4 3 0 0 0 0 x\n"), "bad.scen:2"));
  EXPECT_TRUE(contains(errorOf("version 1\n0 small.map 5 3 0 0 0 0 0\n"), "bad.scen:2"));
  EXPECT_TRUE(contains(errorOf("version 1\n"), "no queries"));
  EXPECT_TRUE(contains(errorOf("version 1\n0 gone.map 4 3 0 0 0 0 0\n"), "gone.map"));
  for (const char* limit : {"0", "-2"})
    EXPECT_EQ(scenarios({"--scen", map, "--limit", limit}).code, kBadInput) << limit;
}

}  // namespace
}  // namespace grid_path_planner::command_line
