#include "ros/common/node_files.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "ros/common/file_kinds.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using base::writeFileAtomically;
using test::contentOf;
using test::errorText;

// An environment variable for as long as this lives; null: none.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    const char* before = std::getenv(name);
    was_set_ = before != nullptr;
    if (before) before_ = before;
    put(value);
  }
  ~Variable() { put(was_set_ ? before_.c_str() : nullptr); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void put(const char* value) { value ? ::setenv(name_, value, 1) : ::unsetenv(name_); }
  const char* name_;
  bool was_set_;
  std::string before_;
};

TEST(NodeFiles, FoldersAreArgumentsElseOfTheEnvironmentElseInRosHome) {
  const Variable home("HOME", "/home/me"), no_ros_home("ROS_HOME", nullptr);
  const Variable no_save("GRID_PATH_PLANNER_SAVE_FOLDER", nullptr);
  const Variable no_load("GRID_PATH_PLANNER_LOAD_FOLDER", nullptr);
  EXPECT_EQ(NodeFiles().saveFolder().path(), "/home/me/.ros/grid_path_planner");
  EXPECT_EQ(NodeFiles().loadFolder().path(), "/home/me/.ros/grid_path_planner");
  const Variable ros_home("ROS_HOME", "/ros");
  EXPECT_EQ(NodeFiles().saveFolder().path(), "/ros/grid_path_planner");
  const Variable save("GRID_PATH_PLANNER_SAVE_FOLDER", "/save/");
  const Variable load("GRID_PATH_PLANNER_LOAD_FOLDER", "/load");
  EXPECT_EQ(NodeFiles().saveFolder().path(), "/save");
  EXPECT_EQ(NodeFiles().loadFolder().path(), "/load");
  EXPECT_EQ(NodeFiles({}, "/s", "").saveFolder().path(), "/s");
  EXPECT_EQ(NodeFiles({}, "/s", "").loadFolder().path(), "/load");
}

TEST(NodeFiles, ANameByArgumentMayLieAnywhereForItsOptionOnly) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("elsewhere.yaml");
  const NodeFiles files({{"waypoints_file", file}}, folder.path("save"), folder.path("load"));
  EXPECT_EQ(files.named("waypoints_file", "of the parameter"), file);
  EXPECT_EQ(files.named("other", "of the parameter"), "of the parameter");
  writeFileAtomically(files.toWrite("waypoints_file", file, waypointFiles()), "waypoints:\n");
  EXPECT_EQ(contentOf(file), "waypoints:\n");
  EXPECT_EQ(files.toRead("waypoints_file", file, waypointFiles()), file);
  EXPECT_NE(errorText([&] { files.toWrite("other", file, waypointFiles()); }), "");
  EXPECT_NE(errorText([&] { files.toRead("other", file, waypointFiles()); }), "");
  EXPECT_NE(errorText([&] { files.toRead("waypoints_file", file + "x", waypointFiles()); }), "");
}

}  // namespace
}  // namespace grid_path_planner::nodes
