#include "ros/common/node_arguments.h"

#include <gtest/gtest.h>

#include <vector>

namespace grid_path_planner::nodes {
namespace {

struct Told {
  NodeArguments given;
  std::string printed;
  std::string error;
};

Told toldOf(std::vector<const char*> arguments, const std::string& file_kind = "") {
  arguments.insert(arguments.begin(), "/somewhere/a_node");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Told told;
  told.given =
      nodeArguments(static_cast<int>(arguments.size()), arguments.data(), "a_node", file_kind);
  told.printed = testing::internal::GetCapturedStdout();
  told.error = testing::internal::GetCapturedStderr();
  return told;
}

TEST(NodeArguments, WhatRosUnderstandsIsLeftToIt) {
  const Told told = toldOf({"_radius:=0.4", "map:=/map", "__name:=a"});
  EXPECT_FALSE(told.given.exit_code);
  EXPECT_EQ(told.given.file, "");
  EXPECT_EQ(told.printed + told.error, "");
}

TEST(NodeArguments, AFileIsTakenByNodesThatHaveOne) {
  const Told told = toldOf({"__name:=a", "site.yaml", "_frame_id:=map"}, "MAP");
  EXPECT_FALSE(told.given.exit_code);
  EXPECT_EQ(told.given.file, "site.yaml");
  EXPECT_EQ(toldOf({"a.yaml", "b.yaml"}, "MAP").given.exit_code, 2);
  EXPECT_EQ(toldOf({"-v"}, "MAP").given.exit_code, 2);
}

// `rosrun grid_path_planner navigate_path site.yaml` waited for a path for ever.
TEST(NodeArguments, OthersAreRefusedByNameWithTheUsage) {
  const Told told = toldOf({"site.yaml"});
  EXPECT_EQ(told.given.exit_code, 2);
  EXPECT_EQ(told.error.find("a_node: what is 'site.yaml'? Parameters are given as "
                            "_parameter:=value\nusage: a_node [_parameter:=value]..."),
            0u)
      << told.error;
}

TEST(NodeArguments, HelpIsPrinted) {
  for (const char* help : {"--help", "-h"}) {
    const Told told = toldOf({help}, "MAP");
    EXPECT_EQ(told.given.exit_code, 0);
    EXPECT_EQ(told.printed.find("usage: a_node [MAP] [_parameter:=value]..."), 0u) << told.printed;
  }
}

}  // namespace
}  // namespace grid_path_planner::nodes
