// A nodelet manager ended by SIGABRT, in two of some 60 runs of unload.test: it destroyed navigate_path in the thread
// of its callbacks while it unloaded path_planner in another, roscpp took a topic of the simulator out of its list, and
// the simulator published the next message there.
#include "ros/guard/outgoing/topic_changes.h"

#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <std_msgs/Empty.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "ros/guard/nodelet_shell.h"
#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

using std::chrono::milliseconds;

// How many threads make or destroy a node just now.
std::atomic<int> inside{0}, most_inside{0};

void stayInside() {
  most_inside = std::max(most_inside.load(), ++inside);
  std::this_thread::sleep_for(milliseconds(10));
  --inside;
}

struct SlowNode {
  SlowNode(const ros::NodeHandle&, const ros::NodeHandle&) { stayInside(); }
  ~SlowNode() { stayInside(); }
};

class SlowNodelet : public NodeletShell<SlowNode> {};

TEST(TopicChanges, NodeletsAreMadeAndDestroyedOneAtATime) {
  const auto live = [](const std::string& name) {
    ros::CallbackQueue queue;
    for (int time = 0; time < 5; ++time) {
      SlowNodelet nodelet;
      nodelet.init(name, {}, {}, &queue, &queue);
    }
  };
  std::thread one(live, "/one"), other(live, "/other");
  one.join();
  other.join();
  EXPECT_EQ(most_inside, 1);
}

std::atomic<bool> stopped{false};

struct Commander {
  Commander(const ros::NodeHandle&, const ros::NodeHandle&) {}
  ~Commander() { EXPECT_TRUE(stopped); }
  void stop() { stopped = true; }
};

class CommanderNodelet : public CommanderShell<Commander> {};

// The lock may be held by a nodelet that reads a world for half a minute.
TEST(TopicChanges, ACommanderStopsTheVehicleBeforeItsTurnComes) {
  ros::CallbackQueue queue;
  auto nodelet = std::make_unique<CommanderNodelet>();
  nodelet->init("/commander", {}, {}, &queue, &queue);
  auto whole = lockTopics();
  std::thread unloading([&] { nodelet.reset(); });
  EXPECT_TRUE(test::waitFor([] { return stopped.load(); }));
  whole.unlock();
  unloading.join();
}

TEST(TopicChanges, ANodeThatRunsDoesNotWaitForWhoDestroysIt) {
  const auto whole = lockTopics();
  EXPECT_TRUE(lockTopicsOfRunningNode().owns_lock()) << "the same thread may";
  std::thread of_the_node([] { EXPECT_FALSE(lockTopicsOfRunningNode().owns_lock()); });
  of_the_node.join();
}

// Advertises and gives up a topic until it is over, as a node does that is loaded and unloaded.
class ComingAndGoing {
 public:
  ComingAndGoing(const std::string& topic, const std::atomic<bool>& over)
      : thread_([topic, &over] {
          ros::NodeHandle nh;
          while (!over) {
            auto alone = lockTopics();
            ros::Publisher publisher = nh.advertise<std_msgs::Empty>(topic, 1);
            alone.unlock();
            publisher.publish(std_msgs::Empty());
            alone.lock();
            publisher.shutdown();
          }
        }) {}
  ~ComingAndGoing() { thread_.join(); }

 private:
  std::thread thread_;
};

TEST(TopicChanges, NobodysTopicIsTakenOutForAnother) {
  ros::NodeHandle nh;
  std::vector<ros::Publisher> staying;
  for (const char* topic : {"first", "second", "third"})
    staying.push_back(nh.advertise<std_msgs::Empty>(topic, 1));
  std::atomic<bool> over{false};
  {
    const ComingAndGoing one("one", over), two("two", over), three("three", over);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(3);
    while (std::chrono::steady_clock::now() < end)
      for (const ros::Publisher& publisher : staying) publisher.publish(std_msgs::Empty());
    over = true;
  }
  std_msgs::Empty last;
  for (const ros::Publisher& publisher : staying) publisher.publish(last);
}

}  // namespace
}  // namespace grid_path_planner::nodes
