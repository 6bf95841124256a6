#include "ros/guard/master/commanders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace grid_path_planner::nodes {
namespace {

Commands driver() {
  return {{"/cmd_vel"}, {"/navigate_path"}, "/manual_control", false};
}
Commands joystick() {
  return {{"/cmd_vel"}, {}, "/manual_control", true};
}

std::vector<std::string> namesOf(const std::vector<OtherCommander>& others) {
  std::vector<std::string> names;
  for (const OtherCommander& other : others) names.push_back(other.node);
  return names;
}

using Names = std::vector<std::string>;

TEST(Commanders, OthersAreThoseThatPublishOrOfferTheSame) {
  SystemState state;
  state.publishers = {{"/cmd_vel", {"/a", "/own"}},
                      {"/navigate_path/status", {"/b", "/own"}},
                      {"/elsewhere/cmd_vel", {"/c"}}};
  const auto others = otherCommanders(state, driver(), "/own");
  EXPECT_EQ(namesOf(others), (Names{"/a", "/b"}));
  EXPECT_EQ(others[0].sentence, "the node /a publishes /cmd_vel");
  EXPECT_EQ(others[1].sentence, "the node /b offers /navigate_path");
  EXPECT_TRUE(otherCommanders({}, driver(), "/own").empty());
}

TEST(Commanders, DriverAndJoystickDoNotCount) {
  SystemState state;
  state.publishers = {{"/cmd_vel", {"/driver", "/joystick"}}, {"/manual_control", {"/joystick"}}};
  state.subscribers = {{"/manual_control", {"/driver"}}};
  EXPECT_TRUE(otherCommanders(state, driver(), "/driver").empty());
  EXPECT_TRUE(otherCommanders(state, joystick(), "/joystick").empty());
  EXPECT_EQ(namesOf(otherCommanders(state, joystick(), "/second")), Names{"/joystick"});
}

TEST(Commanders, EarlierAreThoseBeforeItInTheListOfTheFirstTopicOfBoth) {
  SystemState state;
  state.publishers = {{"/cmd_vel", {"/a", "/own", "/b"}},
                      {"/navigate_path/status", {"/b", "/own", "/a"}}};
  EXPECT_EQ(namesOf(earlierCommanders(state, driver(), "/own")), Names{"/a"});
  EXPECT_EQ(namesOf(earlierCommanders(state, driver(), "/b")), (Names{"/a", "/own"}));
  EXPECT_TRUE(earlierCommanders(state, driver(), "/a").empty());
}

TEST(Commanders, AllAreEarlierThanOneThatTheMasterDoesNotKnow) {
  SystemState state;
  state.publishers = {{"/cmd_vel", {"/a", "/b"}}};
  EXPECT_EQ(namesOf(earlierCommanders(state, driver(), "/own")), (Names{"/a", "/b"}));
}

// A node that starts: it looks, registers its topics one by one, and looks again.
class StartingNode {
 public:
  StartingNode(std::string name, std::vector<std::string> topics)
      : name_(std::move(name)), topics_(std::move(topics)) {}

  bool isThrough() const { return left_ || stays_; }
  bool stays() const { return stays_; }

  void step(SystemState& state) {
    if (!looked_) {
      looked_ = true;
      if (!otherCommanders(state, driver(), name_).empty()) leave(state);
    } else if (registered_ < topics_.size()) {
      state.publishers[topics_[registered_++]].push_back(name_);
    } else if (!earlierCommanders(state, driver(), name_).empty()) {
      leave(state);
    } else {
      stays_ = true;
    }
  }

 private:
  void leave(SystemState& state) {
    left_ = true;
    for (auto& [topic, nodes] : state.publishers)
      nodes.erase(std::remove(nodes.begin(), nodes.end(), name_), nodes.end());
  }

  std::string name_;
  std::vector<std::string> topics_;
  std::size_t registered_ = 0;
  bool looked_ = false, left_ = false, stays_ = false;
};

std::vector<StartingNode> someNodes(std::mt19937& random) {
  std::vector<StartingNode> nodes;
  const int count = 2 + static_cast<int>(random() % 3);
  for (int i = 0; i < count; ++i) {
    std::vector<std::string> topics{"/cmd_vel", "/navigate_path/status"};
    std::shuffle(topics.begin(), topics.end(), random);
    nodes.emplace_back("/node" + std::to_string(random()), topics);
  }
  return nodes;
}

int countOfThoseThatStay(std::vector<StartingNode>& nodes, std::mt19937& random) {
  SystemState state;
  const auto through = [](const StartingNode& node) { return node.isThrough(); };
  while (!std::all_of(nodes.begin(), nodes.end(), through)) {
    StartingNode& node = nodes[random() % nodes.size()];
    if (!node.isThrough()) node.step(state);
  }
  return static_cast<int>(
      std::count_if(nodes.begin(), nodes.end(), [](const auto& node) { return node.stays(); }));
}

// The node with the earlier name looked while the other had been through: it took the other for one that would go, and both
// drove. In CI a local_planner that started beside a second one took so long.
TEST(Commanders, LawOfThoseThatStartAtOnceOneAtMostStays) {
  std::mt19937 random(20261124);
  int stayed = 0;
  for (int round = 0; round < 20000; ++round) {
    std::vector<StartingNode> nodes = someNodes(random);
    const int count = countOfThoseThatStay(nodes, random);
    ASSERT_LE(count, 1) << "round " << round;
    stayed += count;
  }
  EXPECT_GT(stayed, 10000) << "that all leave is the exception";
}

}  // namespace
}  // namespace grid_path_planner::nodes
