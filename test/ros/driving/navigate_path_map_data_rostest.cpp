// navigate_path drives by what sensors see, and holds when they have ceased, whatever comes between it and them.
//
// What was seen before: a camera ceased, and the vehicle drove on for 9.8 m in 12 s: the heartbeats of the map went on, and
// all diagnostics were OK.
#include <dynamic_reconfigure/Reconfigure.h>
#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <atomic>
#include <mutex>
#include <thread>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/support/mapping_fixture.h"
#include "ros/support/still_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using test::pathOf;
using test::Process;
using test::waitFor;

constexpr double kTimeout = 3.0;  // map_data_timeout
constexpr double kBraking = 0.8;  // s: 0.8 m/s at 1 m/s^2
// s of simulated time, until the stop is seen: heartbeats come five times a second of the wall clock, at twice real time.
constexpr double kReserve = 3.0;

// Sends something stamped now, again and again.
class Feed {
 public:
  explicit Feed(std::function<void(const ros::Time&)> send) : send_(std::move(send)) {
    thread_ = std::thread([this] {
      while (!done_) {
        sendNow();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    });
  }
  ~Feed() {
    done_ = true;
    thread_.join();
  }
  // The stamp of the last one.
  ros::Time cease() {
    const std::lock_guard<std::mutex> lock(mutex_);
    sends_ = false;
    return last_;
  }
  void goOn() {
    const std::lock_guard<std::mutex> lock(mutex_);
    sends_ = true;
  }

 private:
  void sendNow() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (sends_ && !ros::Time::now().isZero()) send_(last_ = ros::Time::now());
  }

  const std::function<void(const ros::Time&)> send_;
  std::mutex mutex_;
  bool sends_ = true;
  ros::Time last_;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

class NavigateMapData : public test::StillTest {
 protected:
  NavigateMapData() {
    for (const char* node : {"/mapping", "/map_layers", "/map_publisher"}) ros::param::del(node);
  }
  // A wall beside the path, as a camera at the map's origin sees it.
  std::unique_ptr<Feed> camera() {
    return std::make_unique<Feed>([this](const ros::Time& stamp) {
      clouds_.publish(test::cloudOf({{2.0F, 3.0F, 0.05F}, {3.0F, 3.0F, 0.05F}}, "map", stamp));
    });
  }
  std::unique_ptr<Feed> laser() {
    return std::make_unique<Feed>([this](const ros::Time& stamp) {
      sensor_msgs::LaserScan scan;
      scan.header.frame_id = "base_link";
      scan.header.stamp = stamp;
      scan.angle_min = 1.0F;
      scan.angle_increment = 0.1F;
      scan.range_max = 30.0F;
      scan.ranges.assign(5, 5.0F);
      scans_.publish(scan);
    });
  }
  static std::unique_ptr<Process> mapping(const std::string& topic) {
    return std::make_unique<Process>(
        "projected_map",
        std::vector<std::string>{"__name:=mapping", "projected_map:=" + topic,
                                 "projected_map_updates:=" + topic + "_updates", "_resolution:=0.2",
                                 "_heartbeat_period:=0.2", "_autosave_period:=0"});
  }
  void publishRoom(const ros::Publisher& topic) {
    topic.publish(occupancyToMessage(
        grid::OccupancyGrid(grid::GridGeometry(200, 40, 0.5, {-5.0, -10.0, 0.0}), 0), "map",
        ros::Time::now()));
  }
  void setOff(std::vector<std::string> arguments = {}) {
    arguments.insert(arguments.end(), {"_check_map:=true", "_no_progress_timeout:=0"});
    startNavigate(arguments);
    publishPath(pathOf({{0, 0}, {80, 0}}));
    ASSERT_TRUE(moves());
  }
  // Whether it is held in time, and says why; and drives on when the sensor is back.
  void ceases(Feed& sensor) {
    const ros::Time last = sensor.cease();
    ASSERT_TRUE(standsStill());
    EXPECT_LT((odom_.all().back().header.stamp - last).toSec(), kTimeout + kBraking + kReserve);
    EXPECT_TRUE(reports(DiagnosticStatus::WARN,
                        "blocked: the map on /projected_map is too old: its newest data is"));
    EXPECT_TRUE(reports(DiagnosticStatus::WARN,
                        "the map on /projected_map is too old: its newest data is"));
    EXPECT_TRUE(staysStill());
    sensor.goOn();
    EXPECT_TRUE(moves()) << "by itself";
  }
  bool comesTo(double x) {
    return waitFor([&] { return pose().position.x() > x; });
  }

  ros::Publisher clouds_ = nh_.advertise<sensor_msgs::PointCloud2>("cloud_in", 10);
  ros::Publisher scans_ = nh_.advertise<sensor_msgs::LaserScan>("scan", 10);
  ros::Publisher static_ = nh_.advertise<nav_msgs::OccupancyGrid>("static_map", 1, true);
};

TEST_F(NavigateMapData, ACameraThatCeasesHoldsTheVehicle) {
  startSimulator({}, 2);
  const auto sensor = camera();
  const auto map = mapping("projected_map");
  setOff();
  ceases(*sensor);
}

TEST_F(NavigateMapData, ACameraThatCeasesHoldsTheVehicleThroughMapLayers) {
  startSimulator({}, 2);
  const auto sensor = camera();
  const auto map = mapping("live_map");
  publishRoom(static_);
  const Process layers("map_layers", {"_use_live_map:=true"});
  setOff();
  ceases(*sensor);
}

// source_timeout says how long the merged map may be published without it, not how old it may be to be driven by.
TEST_F(NavigateMapData, ALaserThatCeasesHoldsTheVehicleThroughMapLayers) {
  startSimulator({}, 2);
  const auto sensor = laser();
  publishRoom(static_);
  const Process layers("map_layers", {"_use_scan:=true", "_source_timeout:=600"});
  setOff();
  ceases(*sensor);
}

// As gmapping's or octomap_server's, which send none when their laser or camera has ceased.
TEST_F(NavigateMapData, AMapperWithoutHeartbeatsThatSendsNoMoreHoldsTheVehicle) {
  startSimulator({}, 2);
  ros::Publisher maps = nh_.advertise<nav_msgs::OccupancyGrid>("projected_map", 1, true);
  Feed mapper([&](const ros::Time&) { publishRoom(maps); });
  setOff();
  mapper.cease();
  ASSERT_TRUE(standsStill());
  EXPECT_TRUE(reports(DiagnosticStatus::WARN,
                      "blocked: the map on /projected_map is too old: no other one has come"));
  EXPECT_TRUE(staysStill());
  publishPath(pathOf({{0, 0}, {70, 0}}));
  EXPECT_TRUE(staysStill()) << "another path is no other map";
  mapper.goOn();
  EXPECT_TRUE(moves());
}

// gmapping sends none while the vehicle stands: one that is held for want of a map would stand for ever.
TEST_F(NavigateMapData, AMapperThatIsSilentWhileTheVehicleStandsLetsItSetOff) {
  startSimulator({}, 8);
  ros::Publisher maps = nh_.advertise<nav_msgs::OccupancyGrid>("projected_map", 1, true);
  Feed mapper([&](const ros::Time&) { publishRoom(maps); });
  setOff();
  ASSERT_TRUE(ask("pause"));
  mapper.cease();
  ASSERT_TRUE(staysStill(10.0));
  ASSERT_TRUE(ask("resume"));
  EXPECT_TRUE(moves());
}

TEST_F(NavigateMapData, AStaticMapIsNeverTooOld) {
  startSimulator({}, 8);
  const test::TemporaryFolder folder;
  std::string room = "type octile\nheight 40\nwidth 100\nmap\n";
  for (int row = 0; row < 40; ++row) room += std::string(100, '.') + "\n";
  for (const char* file : {"room.map", "second.map", "third.map"}) folder.write(file, room);
  Process server("map_publisher", {"--load-folder", folder.path("."), "_filename:=room.map"});
  setOff();
  EXPECT_TRUE(comesTo(10.0)) << "after a dozen seconds";
  // It is changed twice: two more maps in a minute.
  for (const std::string file : {"second.map", "third.map"}) {
    dynamic_reconfigure::Reconfigure call;
    call.request.config.strs.resize(1);
    call.request.config.strs[0].name = "filename";
    call.request.config.strs[0].value = file;
    ASSERT_TRUE(ros::service::call("/map_publisher/set_parameters", call));
    EXPECT_TRUE(server.says("Published " + file));
  }
  EXPECT_TRUE(comesTo(40.0)) << navigate_->output();
}

}  // namespace
}  // namespace grid_path_planner::nodes
