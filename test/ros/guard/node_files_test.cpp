#include "ros/guard/node_files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>

#include "grid_path_planner/mapping/octree_map.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/ros/bag.h"
#include "grid_path_planner/simulation/world.h"
#include "layers/zones.h"
#include "ros/messages/file_kinds.h"
#include "simulation/sensors/sensor_faults.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"
#include "vision/marker_layout.h"

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

// Files of others, under a name with an ending that is read: each has the word in a place that some reader's error told.
const std::vector<std::string> kSecrets = {
    "hunter2\n",
    "root:hunter2:19000:0:99999:7:::\n",
    "-----BEGIN OPENSSH PRIVATE KEY-----\nhunter2hunter2\n-----END OPENSSH PRIVATE KEY-----\n",
    "export secret=hunter2\n",
    "hunter2: 1\n",
    "- hunter2\n",
    "frame_id: hunter2\nzones: hunter2\n",
    "image: hunter2\nresolution: hunter2\norigin: hunter2\nhunter2: 1\n",
    "header: {frame_id: hunter2}\nposes: hunter2\n",
    "waypoints: hunter2\n",
    "family: hunter2\nmarkers: [hunter2]\n",
    "imu: hunter2\nfaults: [hunter2]\n",
    "type hunter2\nheight hunter2\nwidth 3\nmap\nhunter2\n",
    "type octile\nheight 2\nwidth 7\nmap\nhunter2\n",
    "P5 hunter2 3 255\nhunter2",
    "#ROSBAG V2.0\nhunter2",
    "# Octomap OcTree file\nid hunter2\nsize 1\nres 0.1\ndata\nhunter2",
    "<sdf version='1.6'><world name='w'><model name='hunter2'><link name='l'><collision "
    "name='hunter2'>"
    "<geometry><hunter2/></geometry></collision></link></model></world></sdf>",
    "<hunter2>"};

// A name by parameter, service or action may be that of any file in the folder: what a reader says of it goes to whoever
// asked.
TEST(NodeFilesLaw, NoErrorOfAFileThatNoArgumentNamesQuotesIt) {
  const test::TemporaryFolder folder;
  const NodeFiles files({}, folder.path(""), folder.path(""));
  struct Reading {
    const FileKind& kind;
    std::function<void(const std::string& file)> read;
  };
  const std::vector<Reading> readings = {
      {mapFiles(), [](const std::string& file) { readAnyMapFile(file, {}); }},
      {waypointFiles(), [](const std::string& file) { path::readWaypointFile(file); }},
      {octreeFiles(),
       [](const std::string& file) { mapping::OctreeMap(mapping::OctreeOptions()).load(file); }},
      {worldFiles(), [](const std::string& file) { simulation::readWorld(file); }},
      {sensorFaultFiles(), [](const std::string& file) { simulation::readSensorFaults(file, {}); }},
      {zoneFiles(), [](const std::string& file) { layers::readZones(file, {}); }},
      {markerLayoutFiles(), [](const std::string& file) { vision::readMarkerLayout(file, {}); }}};
  std::size_t quoted_by_readers = 0;
  for (const Reading& reading : readings)
    for (const std::string& ending : reading.kind.endings) {
      if (&reading.kind != &mapFiles() && ending != reading.kind.endings.front())
        break;  // those of maps have readers of their own
      for (const std::string& secret : kSecrets) {
        const std::string name = "file." + ending;
        folder.write(name, secret);
        const std::string error = errorText([&] {
          files.read("option", name, reading.kind, [&](const std::string& file) {
            try {
              reading.read(file);
            } catch (const base::InputError& told) {
              quoted_by_readers += test::contains(told.what(), "hunter2") ? 1 : 0;
              throw;
            }
          });
        });
        EXPECT_NE(error, "") << reading.kind.name << ' ' << secret;
        EXPECT_EQ(error.find("hunter2"), std::string::npos) << error;
      }
    }
  EXPECT_GT(quoted_by_readers, 20u) << "readers tell the owner of a file what is wrong in it";
}

}  // namespace
}  // namespace grid_path_planner::nodes
