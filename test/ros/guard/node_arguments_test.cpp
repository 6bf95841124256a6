#include "ros/guard/node_arguments.h"

#include <gtest/gtest.h>

#include <vector>

namespace grid_path_planner::nodes {
namespace {

struct Told {
  NodeArguments given;
  std::string printed;
  std::string error;
};

Told toldOf(std::vector<const char*> arguments,
            const std::optional<std::vector<FileArgument>>& files = {}) {
  arguments.insert(arguments.begin(), "/somewhere/a_node");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Told told;
  told.given = nodeArguments(static_cast<int>(arguments.size()), arguments.data(), "a_node", files);
  told.printed = testing::internal::GetCapturedStdout();
  told.error = testing::internal::GetCapturedStderr();
  return told;
}

TEST(NodeArguments, WhatRosUnderstandsIsLeftToIt) {
  const Told told = toldOf({"_radius:=0.4", "map:=/map", "__name:=a"});
  EXPECT_FALSE(told.given.exit_code);
  EXPECT_TRUE(told.given.files.empty());
  EXPECT_EQ(told.printed + told.error, "");
}

const std::vector<FileArgument> kMap = {{"filename", "MAP", true}, {"map_file", "FILE"}};

TEST(NodeArguments, AFileIsTakenByNodesThatHaveOne) {
  const Told told = toldOf({"__name:=a", "site.yaml", "_frame_id:=map"}, kMap);
  EXPECT_FALSE(told.given.exit_code);
  EXPECT_EQ(told.given.files.at("filename"), "site.yaml");
  EXPECT_EQ(toldOf({"a.yaml", "b.yaml"}, kMap).given.exit_code, 2);
  EXPECT_EQ(toldOf({"-v"}, kMap).given.exit_code, 2);
  EXPECT_EQ(toldOf({"--save-folder", "/a"}).given.exit_code, 2);
}

TEST(NodeArguments, FilesAndFoldersAreTakenByName) {
  const Told told = toldOf(
      {"--map-file", "out.yaml", "--filename=a b.yaml", "--save-folder", "/s", "--load-folder=/l"},
      kMap);
  EXPECT_FALSE(told.given.exit_code) << told.error;
  EXPECT_EQ(told.given.files, (std::map<std::string, std::string>{{"filename", "a b.yaml"},
                                                                  {"map_file", "out.yaml"}}));
  EXPECT_EQ(told.given.save_folder, "/s");
  EXPECT_EQ(told.given.load_folder, "/l");
}

TEST(NodeArguments, ANodeMayHaveFoldersAlone) {
  const Told told = toldOf({"--save-folder", "/s"}, std::vector<FileArgument>());
  EXPECT_FALSE(told.given.exit_code) << told.error;
  EXPECT_EQ(told.given.save_folder, "/s");
  EXPECT_EQ(toldOf({"site.yaml"}, std::vector<FileArgument>()).given.exit_code, 2);
}

TEST(NodeArguments, AnEmptyValueIsNone) {
  const Told told = toldOf({"--filename", "", "--save-folder", ""}, kMap);
  EXPECT_FALSE(told.given.exit_code) << told.error;
  EXPECT_TRUE(told.given.files.empty());
}

TEST(NodeArguments, AnOptionTwiceOrWithoutAValueIsRefused) {
  EXPECT_EQ(toldOf({"--filename", "a", "b"}, kMap).given.exit_code, 2);
  EXPECT_EQ(toldOf({"--save-folder", "/a", "--save-folder", "/b"}, kMap).given.exit_code, 2);
  const Told told = toldOf({"--map-file"}, kMap);
  EXPECT_EQ(told.given.exit_code, 2);
  EXPECT_EQ(told.error.find("a_node: '--map-file' needs a value"), 0u) << told.error;
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
    const Told told = toldOf({help}, kMap);
    EXPECT_EQ(told.given.exit_code, 0);
    EXPECT_EQ(told.printed.find(
                  "usage: a_node [[--filename] MAP] [--map-file FILE] [--save-folder FOLDER] "
                  "[--load-folder FOLDER] [_parameter:=value]..."),
              0u)
        << told.printed;
  }
}

}  // namespace
}  // namespace grid_path_planner::nodes
