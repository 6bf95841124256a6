// Nodelets that are unloaded while they work: maps, clouds, goals and questions come, and go on coming.
// None hangs, none takes the manager with it. How long they take at most is printed: only a quiet machine says something by it.
#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/Twist.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <move_base_msgs/MoveBaseActionGoal.h>
#include <nav_msgs/GetMap.h>
#include <nav_msgs/GetPlan.h>
#include <sensor_msgs/Joy.h>
#include <std_srvs/Empty.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "grid_path_planner/NavigatePathActionGoal.h"
#include "grid_path_planner/PlanPathActionGoal.h"
#include "ros/support/known_nodes.h"
#include "ros/support/manager_client.h"
#include "ros/support/mapping_fixture.h"
#include "ros/support/nodelet_command.h"
#include "ros/support/planner_fixture.h"

namespace grid_path_planner::nodes {
namespace {

using test::poseAt;
using test::Process;
using test::waitFor;

constexpr int kCells = 500;  // a side of the map, of 0.1 m

// Their types by their names; the mapping's own would be remapped with its map.
const std::map<std::string, std::string> kNodelets = {{"map_publisher", "map_publisher"},
                                                      {"path_planner", "path_planner"},
                                                      {"mapping", "projected_map"},
                                                      {"simulator", "simulator"},
                                                      {"navigate_path", "navigate_path"},
                                                      {"teleop_joy", "teleop_joy"},
                                                      {"go_to_pose", "go_to_pose"},
                                                      {"map_layers", "map_layers"},
                                                      {"marker_localizer", "marker_localizer"},
                                                      {"vehicle_localizer", "vehicle_localizer"},
                                                      {"pilot", "local_planner"}};

// Of those that would command or publish what another does.
const std::map<std::string, std::map<std::string, std::string>> kRemapped = {
    {"mapping", {{"/projected_map", "/octree_map"}}},
    {"map_layers", {{"/projected_map", "/layered_map"}, {"/static_map", "/projected_map"}}},
    {"pilot",
     {{"/cmd_vel", "/pilot/cmd_vel"}, {"/navigate_path", "/fly"}, {"/points", "/cloud_in"}}}};

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& [name, type] : kNodelets) all.push_back(name);
  return all;
}

// What the nodelets hear, each message so often a second, from threads of its own.
class Messages {
 public:
  Messages() {
    const nav_msgs::OccupancyGrid map = mapWithPillars();
    say<nav_msgs::OccupancyGrid>("projected_map", 5, [map] { return map; });
    say<map_msgs::OccupancyGridUpdate>("projected_map_updates", 20, [] { return update(); });
    say<sensor_msgs::PointCloud2>(
        "cloud_in", 20, [] { return test::cloudOf(test::wallAt(2.0F), "map", ros::Time::now()); });
    say<geometry_msgs::PoseStamped>("goal", 50, [] { return poseAt(45.0, 45.0); });
    say<PlanPathActionGoal>("plan_path/goal", 20, [] {
      PlanPathActionGoal goal;
      goal.goal.start = poseAt(5.0, 5.0);
      goal.goal.goal = poseAt(45.0, 40.0);
      return goal;
    });
    say<NavigatePathActionGoal>("navigate_path/goal", 20, [] {
      NavigatePathActionGoal goal;
      goal.goal.path.header.frame_id = "map";
      goal.goal.path.poses = {poseAt(1.0, 1.0), poseAt(3.0, 1.0)};
      return goal;
    });
    say<move_base_msgs::MoveBaseActionGoal>("move_base/goal", 20, [] {
      move_base_msgs::MoveBaseActionGoal goal;
      goal.goal.target_pose = poseAt(45.0, 40.0);
      return goal;
    });
    say<sensor_msgs::Joy>("joy", 50, [] {
      sensor_msgs::Joy joy;
      joy.axes.resize(8);
      joy.buttons.resize(11);
      return joy;
    });
  }
  ~Messages() {
    over_ = true;
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  template <class Message, class Make>
  void say(const std::string& topic, double rate, Make make) {
    const auto publisher = nh_.advertise<Message>(topic, 2);
    threads_.emplace_back([this, publisher, rate, make] {
      for (ros::WallRate pause(rate); !over_; pause.sleep()) publisher.publish(make());
    });
  }
  static nav_msgs::OccupancyGrid mapWithPillars() {
    grid::OccupancyGrid map(grid::GridGeometry(kCells, kCells, 0.1));
    for (std::uint32_t i = 0; i < map.values().size(); ++i)
      map.values()[i] = i % 37 == 0 && i / kCells % 7 == 0 ? 100 : 0;
    return occupancyToMessage(map, "map", ros::Time::now());
  }
  static map_msgs::OccupancyGridUpdate update() {
    map_msgs::OccupancyGridUpdate message;
    message.header.frame_id = "map";
    message.header.stamp = ros::Time::now();
    message.x = message.y = 100;
    message.width = message.height = 50;
    message.data.assign(2500, 0);
    return message;
  }

  ros::NodeHandle nh_;
  std::atomic<bool> over_{false};
  std::vector<std::thread> threads_;
};

// Clients of their services, which ask again as soon as they are answered, or refused.
class Questions {
 public:
  Questions() {
    nav_msgs::GetPlan plan;
    plan.request.start = poseAt(5.0, 5.0);
    plan.request.goal = poseAt(45.0, 45.0);
    ask("/path_planner/make_plan", plan);
    ask("/path_planner/make_plan", plan);
    ask("/mapping/reset", std_srvs::Empty());
    ask("/static_map", nav_msgs::GetMap());
    ask("/navigate_path/pause", std_srvs::Trigger());
    for (const std::string& name : names())
      ask("/" + name + "/set_parameters", dynamic_reconfigure::Reconfigure());
  }
  ~Questions() {
    over_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  // How many of a service were answered.
  int answers(const std::string& service) const { return answers_.at(service); }

 private:
  template <class Service>
  void ask(const std::string& service, const Service& question) {
    std::atomic<int>& answers = answers_[service];
    threads_.emplace_back([this, &answers, service, question] {
      while (!over_) {
        Service call = question;
        if (ros::service::exists(service, false) && ros::service::call(service, call)) ++answers;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    });
  }

  std::atomic<bool> over_{false};
  std::map<std::string, std::atomic<int>> answers_;
  std::vector<std::thread> threads_;
};

class Unload : public testing::Test {
 protected:
  Unload() {
    ::setenv("GRID_PATH_PLANNER_LOAD_FOLDER", GPP_TEST_DATA, 1);
    ros::param::set("/map_publisher/filename", "projected_map.bag");
    ros::param::set("/map_publisher/topic", "map_of_the_file");
    ros::param::set("/path_planner/timeout", 0);
    ros::param::set("/marker_localizer/layout", "two_markers.yaml");
    for (const char* transform : {"publish_map_to_odom", "publish_odom_to_base"})
      ros::param::set(std::string("/vehicle_localizer/") + transform, false);
    ros::param::set("/simulator/camera_width", 32);
    ros::param::set("/simulator/camera_height", 24);
    manager_ = std::make_unique<Process>(test::nodeletCommand({"manager", "__name:=manager"}));
    client_ = std::make_unique<test::ManagerClient>("/manager");
  }

  void load(const std::string& name) {
    nodelet::NodeletLoad call;
    call.request.name = "/" + name;
    call.request.type = "grid_path_planner/" + kNodelets.at(name);
    const auto remapped = kRemapped.find(name);
    if (remapped != kRemapped.end())
      for (const auto& [from, to] : remapped->second) {
        call.request.remap_source_args.push_back(from);
        call.request.remap_target_args.push_back(to);
      }
    ASSERT_TRUE(client_->load(call)) << name;
  }
  void unload(const std::string& name) {
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(client_->unload("/" + name)) << name;
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    longest_ = std::max(longest_, taken.count());
  }

  std::unique_ptr<Process> manager_;
  std::unique_ptr<test::ManagerClient> client_;
  inline static double longest_ = 0.0;
};

TEST(UnloadedNodelets, AreAllOfThePackage) {
  std::set<std::string> tested;
  for (const auto& [name, type] : kNodelets) tested.insert(type);
  EXPECT_EQ(tested, test::knownNodes());
}

TEST_F(Unload, OfEveryNodeletUnderLoad) {
  const Messages messages;
  const Questions questions;
  std::mt19937 random(7);  // NOLINT: the same order every time
  std::vector<std::string> order = names();
  for (int round = 0; round < 4; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const int before = questions.answers("/path_planner/make_plan");
    for (const std::string& name : order) load(name);
    EXPECT_TRUE(waitFor([&] { return questions.answers("/path_planner/make_plan") > before + 5; }));
    std::shuffle(order.begin(), order.end(), random);
    for (const std::string& name : order) unload(name);
    ASSERT_TRUE(manager_->running());
  }
  std::printf("the longest unload took %.2f s\n", longest_);
  for (const char* service : {"/static_map", "/mapping/reset", "/navigate_path/pause"})
    EXPECT_GT(questions.answers(service), 0) << service;
  for (const std::string& name : names())
    EXPECT_GT(questions.answers("/" + name + "/set_parameters"), 0) << name;
}

// Not one by one, but with the manager, which gives its names back to the master: it was taken for a
// master that had lost them, and the process ended by SIGABRT when it registered again.
TEST_F(Unload, WithTheManager) {
  const Messages messages;
  const Questions questions;
  for (const std::string& name : names()) load(name);
  EXPECT_TRUE(waitFor([&] { return questions.answers("/path_planner/make_plan") > 5; }));
  manager_->signal(SIGINT);
  EXPECT_TRUE(manager_->waitForExit());
  EXPECT_EQ(manager_->exitCode(), 0);
}

}  // namespace
}  // namespace grid_path_planner::nodes
