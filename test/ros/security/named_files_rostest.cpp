// What any ROS client may ask for by name. Seen before: a map whose frame was a shell substitution, a
// plan in it, and ~save_waypoints onto a shell's start-up file, which then ran the command.
#include <actionlib/client/simple_action_client.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <utility>

#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/SaveFile.h"
#include "grid_path_planner/SaveWaypoints.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/support/mapping_fixture.h"
#include "ros/support/planner_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using test::contentOf;
using test::poseAt;
using test::Process;

constexpr char kStartUp[] = "# start-up file of a shell\nexport secret=hunter2\n";
// A second is what is promised: measured (the line that TearDownTestSuite prints), not judged, since machines that run tests
// are loaded. What hung did so for ever.
const std::chrono::duration<double> kLongestAnswer = std::chrono::seconds(5);

using NodeOptions = std::set<std::pair<std::string, std::string>>;  // (node, option)

// What names a file that is read or tried when the node starts, and what a service asks for later.
const NodeOptions kAtTheStart = {
    {"local_planner", "config_filename"}, {"local_planner", "log"},
    {"map_layers", "zones_file"},         {"map_publisher", "filename"},
    {"marker_localizer", "layout"},       {"navigate_path", "config_filename"},
    {"path_planner", "waypoints_file"},   {"projected_map", "filename"},
    {"simulator", "sensor_faults"},       {"simulator", "world"}};
const NodeOptions kBySaving = {{"projected_map", "map_file"}, {"projected_map", "octree_file"}};

// All options of config/ whose description says below which folder the file lies.
NodeOptions optionsThatNameFiles() {
  const std::regex option("([a-z_]+): [^#]*# (.*)"), more(" +# (.*)"),
      folder("below the\\s+folder to");
  NodeOptions found;
  for (const auto& entry : std::filesystem::directory_iterator(GPP_TEST_DATA "/../../config")) {
    std::ifstream file(entry.path());
    std::string line, name, description;
    for (std::smatch match; std::getline(file, line);) {
      if (std::regex_match(line, match, option)) {
        name = match[1];
        description = match[2];
      } else if (std::regex_match(line, match, more)) {
        description += " " + match[1].str();
      }
      if (std::regex_search(description, folder)) found.emplace(entry.path().stem().string(), name);
    }
  }
  return found;
}

// home/ has what nobody may touch; files/ is the folder of the nodes.
class NamedFiles : public test::PlannerTest {
 protected:
  NamedFiles() {
    std::filesystem::create_directories(folder_.path("home"));
    std::filesystem::create_directories(files());
    start_up_ = folder_.write("home/.bashrc", kStartUp);
    other_ = folder_.write("home/notes.yaml", kStartUp);
    std::filesystem::create_symlink("../home/.bashrc", folder_.path("files/link.yaml"));
    std::filesystem::create_symlink("../home", folder_.path("files/home"));
    EXPECT_EQ(::mkfifo((files() + "/pipe.yaml").c_str(), 0600), 0);
  }
  void TearDown() override {
    EXPECT_EQ(contentOf(start_up_), kStartUp);
    EXPECT_EQ(contentOf(other_), kStartUp);
    EXPECT_EQ(std::system(("cd " + folder_.path("home") + " && sh ./.bashrc").c_str()), 0);
    EXPECT_FALSE(std::filesystem::exists(folder_.path("home/taken_over")));
    for (const char* node : {"/path_planner", "/projected_map", "/navigate_path", "/map_publisher"})
      ros::param::del(node);
  }

  static void TearDownTestSuite() {
    std::printf("%zu requests for files, the longest answered after %.3f s\n", answers_,
                longest_.count());
  }
  // Of a request that began then.
  static void judgeAnswer(std::chrono::steady_clock::time_point begin, const std::string& what) {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(took, kLongestAnswer) << what;
    longest_ = std::max(longest_, took);
    ++answers_;
  }

  std::string files() const { return folder_.path("files"); }
  std::vector<std::string> folders() const {
    return {"--save-folder", files(), "--load-folder", files()};
  }
  // Names of the files in home/, by every path that leads there; of devices, and of a pipe.
  std::vector<std::string> namesOutside() const {
    return {start_up_,         other_,
            "../home/.bashrc", "../home/notes.yaml",
            "link.yaml",       "home/notes.yaml",
            "home/new.yaml",   files() + "/../home/new.yaml",
            "/etc/new.yaml",   ".bashrc",
            "new.sh",          std::string("new\0.yaml", 9),
            "/dev/null",       "/dev/shm/new.yaml",
            "pipe.yaml"};
  }

  // Asks a service to save, which is answered soon.
  template <class Service>
  typename Service::Response save(const std::string& service, const std::string& file) {
    Service call;
    call.request.filename = file;
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(ros::service::call(service, call)) << file;
    judgeAnswer(begin, file);
    EXPECT_EQ(call.response.message.find("hunter2"), std::string::npos) << call.response.message;
    return call.response;
  }

  // What a reconfiguration of `option` leaves there.
  static std::string reconfigured(const std::string& node, const std::string& option,
                                  const std::string& value) {
    dynamic_reconfigure::Reconfigure call;
    dynamic_reconfigure::ConfigTools::appendParameter(call.request.config, option, value);
    EXPECT_TRUE(ros::service::call(node + "/set_parameters", call));
    std::string answer;
    dynamic_reconfigure::ConfigTools::getParameter(call.response.config, option, answer);
    return answer;
  }

  // In projected_map: a map of which nothing is known is not saved.
  void mapAWall() {
    ros::Publisher clouds = nh_.advertise<sensor_msgs::PointCloud2>("cloud_in", 10);
    EXPECT_TRUE(test::waitFor([&] {
      clouds.publish(test::cloudOf(test::wallAt(1.0F), "map", ros::Time::now()));
      return save<SaveFile>("/projected_map/save_map", "map.yaml").success;
    }));
  }

  // Those of its action that name files outside, or one that is no waypoint file.
  void refuseGoals(const std::string& node);

  static int exitCodeOf(const std::string& node, const std::vector<std::string>& arguments) {
    Process process(node, arguments);
    EXPECT_TRUE(process.waitForExit()) << node;
    EXPECT_EQ(process.output().find("hunter2"), std::string::npos) << process.output();
    return process.exitCode();
  }

  static inline std::chrono::duration<double> longest_{0.0};
  static inline std::size_t answers_ = 0;
  const test::TemporaryFolder folder_;
  std::string start_up_, other_;
};

TEST_F(NamedFiles, TheAttackOnAShellsStartUpFileIsRefused) {
  startPlanner(folders());
  nav_msgs::OccupancyGrid map = occupancyToMessage(test::AsciiMap({"....", "...."}).map,
                                                   "$(touch taken_over)", ros::Time::now());
  maps_.publish(map);
  makePlan(poseAt(0.5, 0.5, 0.0, map.header.frame_id), poseAt(3.5, 0.5, 0.0, map.header.frame_id));
  const auto save_waypoints = [this](const std::string& file) {
    return save<SaveWaypoints>("/path_planner/save_waypoints", file);
  };
  for (const std::string& name : namesOutside()) EXPECT_FALSE(save_waypoints(name).success) << name;

  publishMap({"....", "...."});
  makePlan(poseAt(0.5, 0.5), poseAt(3.5, 0.5));
  ASSERT_EQ(answer_.status, "FOUND");
  for (const std::string& name : namesOutside()) EXPECT_FALSE(save_waypoints(name).success) << name;
  const auto saved = save_waypoints("site.yaml");
  EXPECT_TRUE(saved.success) << saved.message;
  EXPECT_EQ(path::readWaypointFile(files() + "/site.yaml").path.frame_id, "map");
}

// ~waypoints_file is set by any client, and roslaunch starts the node again with it.
TEST_F(NamedFiles, AParameterThatNamesThemIsRevertedAndAfterARestartEndsTheNode) {
  startPlanner(folders());
  EXPECT_EQ(reconfigured("/path_planner", "waypoints_file", other_), "");
  EXPECT_EQ(reconfigured("/path_planner", "waypoints_file", "site.yaml"), "site.yaml");
  planner_.reset();
  for (const std::string& name : {start_up_, other_}) {
    ros::param::set("/path_planner/waypoints_file", name);
    EXPECT_EQ(exitCodeOf("path_planner", folders()), 1) << name;
  }
}

// The folders themselves are arguments: a parameter of such a name changes nothing.
TEST_F(NamedFiles, ThereIsNoParameterForTheFolders) {
  for (const char* name : {"save_folder", "load_folder"})
    ros::param::set(std::string("/path_planner/") + name, folder_.path("home"));
  planner_ = std::make_unique<Process>("path_planner", folders());
  ASSERT_TRUE(test::waitFor([this] { return maps_.getNumSubscribers() > 0; }));
  publishMap({"....", "...."});
  makePlan(poseAt(0.5, 0.5), poseAt(3.5, 0.5));
  EXPECT_FALSE(
      save<SaveWaypoints>("/path_planner/save_waypoints", folder_.path("home/new.yaml")).success);
  EXPECT_TRUE(planner_->says("/path_planner/save_folder is not used"));
}

TEST_F(NamedFiles, MapsAndOctreesAreSavedBelowTheFolderOnly) {
  const Process mapping("projected_map", folders());
  ASSERT_TRUE(ros::service::waitForService("/projected_map/save_octree", 20000));
  for (const char* service : {"/projected_map/save_map", "/projected_map/save_octree"})
    for (const std::string& name : namesOutside())
      EXPECT_FALSE(save<SaveFile>(service, name).success) << service << ' ' << name;
  mapAWall();
  EXPECT_TRUE(save<SaveFile>("/projected_map/save_octree", "tree.bt").success);
  EXPECT_TRUE(std::filesystem::exists(files() + "/tree.bt"));
}

// ~save_map and ~save_octree write there where their requests name no file.
TEST_F(NamedFiles, WhatServicesWriteToByAParameterLiesBelowTheFolderToo) {
  const Process mapping("projected_map", folders());
  ASSERT_TRUE(ros::service::waitForService("/projected_map/save_octree", 20000));
  mapAWall();
  for (const auto& [node, option] : kBySaving) {
    const bool map = option == "map_file";
    const std::string service = map ? "/projected_map/save_map" : "/projected_map/save_octree";
    for (const std::string& name : namesOutside()) {
      reconfigured("/" + node, option, name);
      EXPECT_FALSE(save<SaveFile>(service, "").success) << option << ' ' << name;
    }
    const std::string name = map ? "by_parameter.yaml" : "by_parameter.bt";
    reconfigured("/" + node, option, name);
    EXPECT_TRUE(save<SaveFile>(service, "").success) << option;
    EXPECT_TRUE(std::filesystem::exists(files() + "/" + name));
  }
}

// Whoever adds an option that names a file adds it to one of the lists above, and is asked.
TEST_F(NamedFiles, NoOptionThatNamesAFileIsMissing) {
  NodeOptions listed = kAtTheStart;
  listed.insert(kBySaving.begin(), kBySaving.end());
  EXPECT_EQ(listed, optionsThatNameFiles());
}

TEST_F(NamedFiles, WaypointsOfAGoalAreReadBelowTheFolderOnlyAndNotQuoted) {
  folder_.write("files/notes.yaml", kStartUp);
  for (const char* node : {"navigate_path", "local_planner"}) refuseGoals(node);
}

void NamedFiles::refuseGoals(const std::string& node) {
  Process navigate(node, {"--load-folder", files()});
  actionlib::SimpleActionClient<NavigatePathAction> client("navigate_path", true);
  ASSERT_TRUE(client.waitForServer(ros::Duration(20.0)));
  std::vector<std::string> names = namesOutside();
  names.insert(names.end(), {"notes.yaml", "missing.yaml"});
  for (const std::string& name : names) {
    NavigatePathGoal goal;
    goal.filename = name;
    const auto begin = std::chrono::steady_clock::now();
    client.sendGoal(goal);
    ASSERT_TRUE(client.waitForResult(ros::Duration(10.0))) << name;
    judgeAnswer(begin, name);
    EXPECT_EQ(client.getResult()->status, "INVALID_REQUEST") << name;
    EXPECT_EQ(client.getResult()->message.find("hunter2"), std::string::npos);
  }
  EXPECT_EQ(navigate.output().find("hunter2"), std::string::npos) << navigate.output();
}

// What stands in a file whose name any client may set: neither an answer nor the node's log repeats it, nor what a library
// prints of it.
TEST_F(NamedFiles, WhatIsReadAtTheStartIsNotQuoted) {
  const std::vector<std::pair<std::string, std::string>> options = {
      {"navigate_path", "_config_filename:=secret.yaml"},
      {"local_planner", "_config_filename:=secret.yaml"},
      {"projected_map", "_filename:=secret.bt"},
      {"map_publisher", "_filename:=secret.yaml"},
      {"map_publisher", "_filename:=secret.map"},
      {"map_publisher", "_filename:=secret.bag"},
      {"map_publisher", "_filename:=secret.png"},
      {"marker_localizer", "_layout:=secret.yaml"},
      {"map_layers", "_zones_file:=secret.yaml"},
      {"simulator", "_world:=secret.sdf"},
      {"simulator", "_sensor_faults:=secret.yaml"}};
  for (const auto& [node, option] : options) {
    const bool xml = option.find(".sdf") != std::string::npos;
    folder_.write("files/" + option.substr(option.find('=') + 1),
                  xml ? "<sdf version='1.6'><world name='hunter2'><model name='hunter2'><hunter2/>"
                        "</model></world></sdf>"
                      : "root:hunter2:19000:0:99999:7:::\n");
    EXPECT_EQ(exitCodeOf(node, {option, "--load-folder", files()}), 1) << node << ' ' << option;
    ros::param::del("/" + node);
  }
}

TEST_F(NamedFiles, WhatIsReadAtTheStartLiesBelowTheFolderToo) {
  for (const auto& [node, option] : kAtTheStart)
    for (const std::string& name : {start_up_, other_, std::string("../home/notes.yaml")}) {
      EXPECT_EQ(exitCodeOf(node, {"_" + option + ":=" + name, "--load-folder", files()}), 1)
          << node;
      ros::param::del("/" + node);
    }
}

}  // namespace
}  // namespace grid_path_planner::nodes
