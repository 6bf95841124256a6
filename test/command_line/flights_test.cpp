#include <gtest/gtest.h>

#include "run_command.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::command_line {
namespace {

using test::contains;

TEST(FlightsCommand, BadInputIsNamed) {
  const test::TemporaryFolder folder;
  const std::string out = folder.path("out");
  const auto errorOf = [](const std::vector<std::string>& arguments) {
    return runCommand(runFlights, arguments).error;
  };
  EXPECT_EQ(errorOf({"flights"}), "flights needs --flights, or --log");
  EXPECT_EQ(errorOf({"flights", "config/flights_smoke.yaml"}), "flights needs --out, or --log");
  EXPECT_TRUE(contains(errorOf({"flights", "gone.yaml", "--out", out}), "gone.yaml"));
  EXPECT_TRUE(contains(
      errorOf({"flights", "config/flights_smoke.yaml", "--out", out, "--flight", "LHLM/7"}),
      "has no flight 'LHLM/7'"));
  const std::string not_a_log = folder.write("not.log", "no log");
  EXPECT_TRUE(contains(errorOf({"flights", "--log", not_a_log}), "not.log"));
}

}  // namespace
}  // namespace grid_path_planner::command_line
