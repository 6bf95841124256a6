// navigate_path drives by a map that is there and kept up, or not at all.
//
// What was seen before: with check_map it drove without any map, by one whose publisher was gone, and
// by one of any age, without a word.
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <new>
#include <optional>
#include <thread>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/driving/map_monitor.h"
#include "ros/guard/guarded_queue.h"
#include "ros/support/still_fixture.h"
#include "support/ascii_map.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using test::pathOf;
using test::Process;
using test::StillWorld;

class NavigateMap : public test::StillTest {
 protected:
  void publishMap() {
    maps_.publish(occupancyToMessage(test::AsciiMap({"........"}).map, "map", ros::Time::now()));
  }
  // With a newest cloud that is so old.
  ros::Time beat(double age = 0.5) {
    map_msgs::OccupancyGridUpdate heartbeat;
    heartbeat.header.frame_id = "map";
    heartbeat.header.stamp = ros::Time::now() - ros::Duration(age);
    updates_.publish(heartbeat);
    return heartbeat.header.stamp;
  }
  // Whether `condition` comes true while the heart beats.
  bool beatsUntil(const std::function<bool()>& condition) {
    return test::waitFor([&] {
      beat();
      return condition();
    });
  }
  bool drivesNow() {
    const auto all = velocity_.all();
    return !all.empty() && !test::isZero(all.back());
  }

  std::size_t beatsOfAnother() const {
    const auto all = beats_.all();
    return static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(),
        [](const map_msgs::OccupancyGridUpdate& update) { return update.header.stamp.isZero(); }));
  }

  test::Latest<map_msgs::OccupancyGridUpdate> beats_{nh_, "projected_map_updates"};
  ros::Publisher maps_ = nh_.advertise<nav_msgs::OccupancyGrid>("projected_map", 1, true);
  ros::Publisher updates_ =
      nh_.advertise<map_msgs::OccupancyGridUpdate>("projected_map_updates", 10);
  StillWorld world_{100.0};
};

// By the code, what one thread read before the other had told was told after it: a sign of life was taken back for a second.
TEST_F(NavigateMap, WhatOneThreadTellsIsNeverOlderThanWhatTheOtherHasTold) {
  std::mutex mutex;
  std::map<std::thread::id, int>
      times;  // told, by thread: that of maps, and that which asks their publisher
  std::atomic<int> telling{0}, at_once{0};
  const auto main = std::this_thread::get_id();
  ros::CallbackQueue queue;
  GuardedQueue guarded(queue);
  ros::NodeHandle nh;
  nh.setCallbackQueue(&guarded);
  const MapMonitor watch(nh, [&](const MapLiveness&) {
    at_once = std::max(at_once.load(), ++telling);
    ros::WallDuration(0.1).sleep();
    --telling;
    const std::lock_guard<std::mutex> lock(mutex);
    if (std::this_thread::get_id() != main) ++times[std::this_thread::get_id()];
  });
  ros::AsyncSpinner spinner(1, &queue);
  spinner.start();
  const auto told_by_both = [&] {
    publishMap();
    const std::lock_guard<std::mutex> lock(mutex);
    return times.size() == 2 && std::all_of(times.begin(), times.end(),
                                            [](const auto& thread) { return thread.second > 2; });
  };
  EXPECT_TRUE(test::waitFor(told_by_both));
  spinner.stop();
  EXPECT_EQ(at_once, 1);
}

TEST_F(NavigateMap, WithoutOneItDoesNotStartAndSaysWhatToDo) {
  startNavigate({"_check_map:=true", "projected_map:=/site/map"});
  publishPath(pathOf({{0, 0}, {50, 0}}));
  EXPECT_TRUE(navigate_->says("no map has come on /site/map yet"));
  EXPECT_TRUE(navigate_->says("check_map:=false"));
  EXPECT_TRUE(stops());
  EXPECT_TRUE(reports(DiagnosticStatus::WARN, "no map has come on /site/map yet"));
  EXPECT_EQ(reported("topic"), "/site/map");
  ros::Publisher late = nh_.advertise<nav_msgs::OccupancyGrid>("/site/map", 1, true);
  late.publish(occupancyToMessage(test::AsciiMap({"........"}).map, "map", ros::Time::now()));
  EXPECT_TRUE(isDriving()) << "by itself when there is a map";
}

// It drove on by a map that it knew to lack changes, for ever where its publisher sends no whole map when it is asked.
TEST_F(NavigateMap, ALostUpdateThatIsNotMendedHoldsTheDrive) {
  updates_.shutdown();
  auto numbered = ros::AdvertiseOptions::create<map_msgs::OccupancyGridUpdate>(
      "projected_map_updates", 1000, {}, {}, {}, nullptr);  // in a shorter queue others are lost
  numbered.has_header = false;                              // header.seq is the test's
  updates_ = nh_.advertise(numbered);
  ASSERT_TRUE(test::waitFor([&] {
    return std::abs(ros::Time::now().toSec() - world_.time()) < 1.0;
  })) << "/clock of this test";
  publishMap();
  startNavigate({"_check_map:=true", "_map_timeout:=1.0", "_no_progress_timeout:=0"});
  publishPath(pathOf({{0, 0}, {50, 0}}));
  std::uint32_t number = 0;
  const auto beatNumbered = [&] {
    map_msgs::OccupancyGridUpdate heartbeat;
    heartbeat.header.seq = ++number;
    heartbeat.header.stamp = ros::Time::now();
    updates_.publish(heartbeat);
  };
  const auto beatsUntilIt = [&](bool drives) {
    return test::waitFor([&] {
      beatNumbered();
      return drivesNow() == drives;
    });
  };
  ASSERT_TRUE(test::waitFor([&] { return updates_.getNumSubscribers() > 0; }));
  ASSERT_TRUE(beatsUntilIt(true));
  number += 3;  // one that was lost; the map that comes again is the one of before
  ASSERT_TRUE(beatsUntilIt(false));
  EXPECT_TRUE(navigate_->says("lacks changes: 3 updates of the map were lost"))
      << navigate_->output();
  publishMap();
  EXPECT_TRUE(beatsUntilIt(true)) << "by itself when a whole map has come";
}

TEST_F(NavigateMap, AHeartThatStopsHoldsTheDriveUntilItBeatsAgain) {
  publishMap();
  startNavigate({"_check_map:=true", "_map_timeout:=1.0", "_no_progress_timeout:=0"});
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(beatsUntil([&] { return drivesNow() && reported("heartbeat") == "True"; }));
  EXPECT_NEAR(std::stod(reported("age (s)")), 1.0, 1.0) << "of the newest cloud";
  EXPECT_TRUE(stops());
  EXPECT_TRUE(reports(DiagnosticStatus::WARN, "blocked: the map on /projected_map is not kept up"));
  EXPECT_TRUE(beatsUntil([&] { return drivesNow(); }));
  EXPECT_FALSE(navigate_->output().find("ENDED") != std::string::npos) << "it is no failure";
}

// What was seen before, by reading: a path was compared with a map of another frame by the last transform between them, however
// old, while the pose in the path's own frame was new.
TEST_F(NavigateMap, AnOldTransformToTheMapsFrameHoldsTheDrive) {
  tf2_ros::TransformBroadcaster broadcaster;
  const auto join = [&] {
    geometry_msgs::TransformStamped joint;
    joint.header.frame_id = "site";
    joint.header.stamp = ros::Time::now();
    joint.child_frame_id = "map";
    joint.transform.rotation.w = 1.0;
    broadcaster.sendTransform(joint);
  };
  const auto joinsUntilItDrives = [&] {
    return beatsUntil([&] {
      join();
      return drivesNow();
    });
  };
  maps_.publish(occupancyToMessage(test::AsciiMap({"........"}).map, "site", ros::Time::now()));
  startNavigate({"_check_map:=true", "_no_progress_timeout:=0"});
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(joinsUntilItDrives());
  EXPECT_TRUE(beatsUntil([&] { return !drivesNow(); }));
  EXPECT_TRUE(navigate_->says("the transform from map to site is"));
  EXPECT_TRUE(joinsUntilItDrives());
}

// A heartbeat is no change of the map, nor one that is older than it.
TEST_F(NavigateMap, HeartbeatsChangeNothing) {
  publishMap();
  startNavigate({"_check_map:=true", "_no_progress_timeout:=0"});
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(beatsUntil([&] { return drivesNow() && reported("heartbeat") == "True"; }));
  EXPECT_EQ(navigate_->output().find("was dropped"), std::string::npos);
}

// What was seen before: the beats of another node, as of a second mapping, ended the watch of those of
// the map's own publisher, which then needed only to answer XML-RPC.
TEST_F(NavigateMap, HeartbeatsOfAnotherNodeDoNotCount) {
  publishMap();
  startNavigate({"_check_map:=true", "_map_timeout:=1.0", "_no_progress_timeout:=0"});
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(beatsUntil([&] { return drivesNow() && reported("heartbeat") == "True"; }));
  const test::Process other("projected_map", {"__name:=another_mapping", "projected_map:=elsewhere",
                                              "_heartbeat_period:=0.1", "_autosave_period:=0"});
  ASSERT_TRUE(beatsUntil([&] { return updates_.getNumSubscribers() > 0 && beatsOfAnother() > 2; }));
  EXPECT_TRUE(stops());
  EXPECT_TRUE(reports(DiagnosticStatus::WARN, "blocked: the map on /projected_map is not kept up"));
}

// A free cell a second of anybody kept the map of a mapping alive that had been killed.
TEST_F(NavigateMap, PiecesOfAnotherNodeAreNoSignOfLife) {
  publishMap();
  startNavigate({"_check_map:=true", "_map_timeout:=1.0", "_no_progress_timeout:=0"});
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(beatsUntil([&] { return drivesNow() && reported("heartbeat") == "True"; }));
  // It hands on what changes in a map of the test's.
  const test::Process other("map_layers", {"projected_map:=elsewhere", "_publish_rate:=20"});
  ros::Publisher below = nh_.advertise<nav_msgs::OccupancyGrid>("static_map", 1, true);
  ros::Publisher changes = nh_.advertise<map_msgs::OccupancyGridUpdate>("static_map_updates", 10);
  below.publish(occupancyToMessage(test::AsciiMap({"........"}).map, "map", ros::Time::now()));
  ASSERT_TRUE(beatsUntil([&] { return changes.getNumSubscribers() > 0; }));
  std::int8_t value = 0;
  const auto change = [&] {
    map_msgs::OccupancyGridUpdate update;
    update.header.frame_id = "map";
    update.header.stamp = ros::Time::now();
    update.x = 7;
    update.width = update.height = 1;
    update.data = {value = value == 0 ? -1 : 0};
    changes.publish(update);
  };
  const auto pieces = [&] {
    const auto all = beats_.all();
    return std::count_if(all.begin(), all.end(), [](const map_msgs::OccupancyGridUpdate& update) {
      return update.width == 1;
    });
  };
  ASSERT_TRUE(beatsUntil([&] {
    change();
    return pieces() > 5;
  }));
  const auto before = pieces();
  EXPECT_TRUE(test::waitFor([&] {
    change();
    return !drivesNow() && pieces() > before + 5;
  }));
  EXPECT_TRUE(reports(DiagnosticStatus::WARN, "blocked: the map on /projected_map is not kept up"));
}

// A map_publisher with a map of its own, which says nothing once the map is sent.
class NavigateByMapServer : public test::StillTest {
 protected:
  NavigateByMapServer() { serve(); }

  void serve() { server_ = std::make_unique<Process>("map_publisher", arguments()); }
  std::vector<std::string> arguments() const { return {"--filename", file_}; }

  const test::TemporaryFolder folder_;
  const std::string file_ =
      folder_.write("site.map", "type octile\nheight 1\nwidth 8\nmap\n........\n");
  std::unique_ptr<Process> server_;
  StillWorld world_{100.0};
};

// roscpp keeps counting the link to a publisher that was killed.
TEST_F(NavigateByMapServer, OneThatWasKilledHoldsTheDriveUntilItIsBack) {
  drive({"_check_map:=true"});
  server_->signal(SIGKILL);
  EXPECT_TRUE(stops());
  EXPECT_TRUE(reports(DiagnosticStatus::WARN, "/map_publisher has not answered for"));
  serve();
  EXPECT_TRUE(isDriving());
}

TEST_F(NavigateByMapServer, OneThatHangsHoldsTheDriveUntilItAnswers) {
  drive({"_check_map:=true"});
  server_->signal(SIGSTOP);
  EXPECT_TRUE(stops());
  server_->signal(SIGCONT);
  EXPECT_TRUE(isDriving());
}

}  // namespace
}  // namespace grid_path_planner::nodes
