// A projected_map that was killed, or ended, and starts again.
#include <std_srvs/Empty.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "grid_path_planner/SaveFile.h"
#include "ros/support/mapping_fixture.h"
#include "ros/support/own_master.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using test::cloudOf;
using test::Process;
using test::valueAt;
using test::wallAt;

class Restart : public test::MappingTest {
 protected:
  Restart() { ros::param::del("/projected_map"); }

  void start(const std::vector<std::string>& more = {}) { startIn(folder_.path("."), more); }
  void startIn(const std::string& folder, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"_resolution:=0.1",        "_publish_rate:=50",
                                          "_diagnostic_period:=0.1", "_autosave_period:=0.2",
                                          "--save-folder",           folder};
    arguments.insert(arguments.end(), more.begin(), more.end());
    node_.reset();
    ASSERT_TRUE(test::waitFor([this] { return clouds_.getNumSubscribers() == 0; }));
    node_ = std::make_unique<Process>("projected_map", arguments);
    ASSERT_TRUE(test::waitFor([this] { return clouds_.getNumSubscribers() > 0; }));
  }
  void kill() {
    node_->signal(SIGKILL);
    ASSERT_TRUE(node_->waitForExit());
    ASSERT_TRUE(test::waitFor([this] { return clouds_.getNumSubscribers() == 0; }));
  }
  // Whether the last cloud comes to be in the file.
  bool isKept() const {
    std::ostringstream stamp;
    stamp << last_stamp_;
    return reports("newest_cloud", stamp.str(), "autosave");
  }
  static std::optional<nav_msgs::OccupancyGrid> firstMap(const Maps& maps) {
    return maps.waitFor(0, [](const nav_msgs::OccupancyGrid&) { return true; });
  }
  static bool isEmpty(const nav_msgs::OccupancyGrid& map) {
    return std::all_of(map.data.begin(), map.data.end(), [](std::int8_t v) { return v == -1; });
  }
  void mapWall(float x) {
    const Maps maps(nh_, "projected_map");
    last_stamp_ = ros::Time::now();
    clouds_.publish(cloudOf(wallAt(x), "map", last_stamp_));
    ASSERT_TRUE(becomes(maps, x + 0.05, 0.05, 100));
  }

  const test::TemporaryFolder folder_;
  ros::Time last_stamp_;
};

// Every occupied cell of `before` is occupied in `after`.
void expectNothingErased(const nav_msgs::OccupancyGrid& before,
                         const nav_msgs::OccupancyGrid& after) {
  const grid::OccupancyGrid grid = occupancyFromMessage(before);
  for (std::uint32_t i = 0; i < grid.geometry().size(); ++i) {
    if (grid[grid::CellIndex(i)] != 100) continue;
    const auto at = grid.geometry().centre(grid.geometry().cell(grid::CellIndex(i)));
    ASSERT_EQ(valueAt(after, at.x(), at.y()), 100) << at.transpose();
  }
}

// A projected_map that was killed and respawned published an empty map one second later: what was
// UNREACHABLE became a path through the wall.
TEST_F(Restart, AMappingThatIsKilledDoesNotEraseTheWorld) {
  start();
  nav_msgs::OccupancyGrid before;
  for (int round = 0; round < 2; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    mapWall(1.5F + 0.5F * static_cast<float>(round));
    ASSERT_TRUE(isKept());
    const Maps maps(nh_, "projected_map");
    ASSERT_TRUE(maps.waitForMoreThan(0));
    before = maps.all().back();
    kill();
    const std::size_t seen = maps.count();
    start();
    EXPECT_TRUE(node_->says("Begins with the map that was kept in"));
    ASSERT_TRUE(maps.waitForMoreThan(seen));
    const auto all = maps.all();
    for (std::size_t i = seen; i < all.size(); ++i) expectNothingErased(before, all[i]);
  }
}

TEST_F(Restart, WhatIsMappedBeforeAnOrderlyEndIsKept) {
  start({"_autosave_period:=1000"});
  mapWall(1.5F);
  start({"_autosave_period:=1000"});
  const Maps maps(nh_, "projected_map");
  ASSERT_TRUE(firstMap(maps));
  EXPECT_EQ(valueAt(*firstMap(maps), 1.55, 0.05), 100);
}

// It was refused as any file that takes more memory to be read than is allowed, called lost, and written over.
TEST_F(Restart, AMapIsReadWhateverReadingTakes) {
  start({"_resolution:=0.01"});
  const Maps maps(nh_, "projected_map");
  last_stamp_ = ros::Time::now();
  clouds_.publish(cloudOf(wallAt(1.505F), "map", last_stamp_));
  ASSERT_TRUE(becomes(maps, 1.505, 0.025, 100));
  ASSERT_TRUE(isKept());
  kill();
  start({"_resolution:=0.01", "_read_memory_limit:=1"});
  EXPECT_TRUE(node_->says("Begins with the map that was kept in"));
  const Maps after(nh_, "projected_map");
  ASSERT_TRUE(firstMap(after));
  expectNothingErased(maps.all().back(), *firstMap(after));
}

TEST_F(Restart, AFileThatIsGoneIsWrittenAgain) {
  start();
  mapWall(1.5F);
  ASSERT_TRUE(isKept());
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path(".")))
    std::filesystem::remove(entry.path());
  EXPECT_TRUE(test::waitFor([this] { return !std::filesystem::is_empty(folder_.path(".")); }));
}

// Whoever switches it off has no disk for it, or saves maps when it matters.
TEST_F(Restart, WithoutAutosaveNothingIsWrittenAndItBeginsEmpty) {
  for (const int signal : {SIGKILL, SIGINT}) {
    start({"_autosave_period:=0"});
    mapWall(1.5F);
    node_->signal(signal);
    ASSERT_TRUE(node_->waitForExit());
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path(".")));
    start({"_autosave_period:=0"});
    const Maps maps(nh_, "projected_map");
    const auto map = firstMap(maps);
    ASSERT_TRUE(map);
    EXPECT_TRUE(isEmpty(*map));
  }
}

TEST_F(Restart, UnderAnotherRunItBeginsEmpty) {
  start();
  mapWall(1.5F);
  ASSERT_TRUE(isKept());
  kill();
  std::string run;
  ASSERT_TRUE(ros::param::get("/run_id", run));
  ros::param::set("/run_id", "another");
  start();
  const Maps maps(nh_, "projected_map");
  const auto map = firstMap(maps);
  ros::param::set("/run_id", run);
  ASSERT_TRUE(map);
  EXPECT_TRUE(isEmpty(*map));
}

// Started again with another file, it showed the map of the one before.
TEST_F(Restart, WithAnotherOctreeFileItBeginsWithThat) {
  start();
  mapWall(1.5F);
  for (const char* name : {"one.bt", "two.bt"}) {
    SaveFile saving;
    saving.request.filename = name;
    ASSERT_TRUE(ros::service::call("/projected_map/save_octree", saving) &&
                saving.response.success);
  }
  const std::string one = folder_.path("one.bt"), two = folder_.path("two.bt");
  start({one});
  mapWall(2.0F);
  start({one});
  EXPECT_TRUE(node_->says("which began with " + one));
  const Maps kept(nh_, "projected_map");
  ASSERT_TRUE(firstMap(kept));
  EXPECT_EQ(valueAt(*firstMap(kept), 2.05, 0.05), 100);
  start({two});
  EXPECT_TRUE(node_->says("is of another frame, resolution or octree file"));
  const Maps fresh(nh_, "projected_map");
  ASSERT_TRUE(firstMap(fresh));
  EXPECT_EQ(valueAt(*firstMap(fresh), 1.55, 0.05), 100) << "as in the file";
  EXPECT_NE(valueAt(*firstMap(fresh), 2.05, 0.05), 100) << "mapped on the other file";
}

// It began with the coarse map, and set the parameter back to its resolution.
TEST_F(Restart, WithAnotherResolutionItBeginsEmpty) {
  start();
  mapWall(1.5F);
  ASSERT_TRUE(isKept());
  start({"_resolution:=0.05"});
  EXPECT_TRUE(node_->says("is of another frame, resolution or octree file"));
  const Maps maps(nh_, "projected_map");
  ASSERT_TRUE(firstMap(maps));
  EXPECT_TRUE(isEmpty(*firstMap(maps)));
  EXPECT_NEAR(firstMap(maps)->info.resolution, 0.05, 1e-6);
}

TEST_F(Restart, AResetIsForEver) {
  start();
  mapWall(1.5F);
  ASSERT_TRUE(isKept());
  std_srvs::Empty call;
  ASSERT_TRUE(ros::service::call("/projected_map/reset", call));
  kill();
  start();
  const Maps maps(nh_, "projected_map");
  const auto map = firstMap(maps);
  ASSERT_TRUE(map);
  EXPECT_TRUE(isEmpty(*map));
}

TEST_F(Restart, NodesOfTwoNamesShareNoFile) {
  start();
  mapWall(1.5F);
  ASSERT_TRUE(isKept());
  kill();
  start({"__name:=mapping"});
  const Maps maps(nh_, "projected_map");
  const auto map = firstMap(maps);
  ASSERT_TRUE(map);
  EXPECT_TRUE(isEmpty(*map));
}

TEST_F(Restart, AFolderThatCannotBeWrittenIsAWarningAndNoEnd) {
  startIn("/dev/null/nowhere");
  mapWall(1.5F);
  EXPECT_TRUE(node_->says("The map cannot be kept"));
  mapWall(2.0F);
  EXPECT_TRUE(node_->running());
}

TEST_F(Restart, ADamagedFileIsNamedAndTheNodeBeginsEmpty) {
  start();
  mapWall(1.5F);
  ASSERT_TRUE(isKept());
  kill();
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path(".")))
    std::filesystem::resize_file(entry.path(), std::filesystem::file_size(entry.path()) - 3);
  start();
  EXPECT_TRUE(node_->says("is truncated"));
  const Maps maps(nh_, "projected_map");
  const auto map = firstMap(maps);
  ASSERT_TRUE(map);
  EXPECT_TRUE(isEmpty(*map));
}

// A master of the test's own, as roslaunch starts it: with an id of the run.
class RunOfMaster : public ::testing::Test {
 protected:
  RunOfMaster() { setRun("first"); }

  void setRun(const std::string& run) {
    using XmlRpc::XmlRpcValue;
    tellMaster("setParam", {XmlRpcValue("/test"), XmlRpcValue("/run_id"), XmlRpcValue(run)});
  }
  void tellMaster(const std::string& method, const std::vector<XmlRpc::XmlRpcValue>& what) {
    ASSERT_TRUE(
        test::waitFor([&] { return callXmlRpc(master_.uri(), method, what, 1.0).has_value(); }));
  }
  std::unique_ptr<Process> started() {
    return master_.start("projected_map",
                         {"_autosave_period:=0.2", "--save-folder", folder_.path(".")});
  }
  // The kept map of a run; empty where there is none.
  std::filesystem::path keptOf(const std::string& run) const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path(".")))
      if (test::contentOf(entry.path().string()).find("run " + run + ",") != std::string::npos)
        return entry.path();
    return {};
  }
  bool becomesOf(const std::string& run) const {
    return test::waitFor([&] { return !keptOf(run).empty(); });
  }
  void kill(Process& node) const {
    node.signal(SIGKILL);
    ASSERT_TRUE(node.waitForExit());
  }
  // As a node would have written it `hours` ago.
  void writeKept(const std::string& name, int hours) const {
    const std::string file = folder_.write(name, "# Octomap OcTree file");
    std::filesystem::last_write_time(
        file, std::filesystem::file_time_type::clock::now() - std::chrono::hours(hours));
  }

  const test::TemporaryFolder folder_;
  test::OwnMaster master_;
};

// The kept map was of the run before, so that a mapping that was killed later began empty.
TEST_F(RunOfMaster, OfARosCoreThatWasRestartedIsThatOfTheKeptMap) {
  auto node = started();
  ASSERT_TRUE(becomesOf("first"));
  master_.kill();
  master_.run();
  setRun("second");
  ASSERT_TRUE(becomesOf("second"));
  EXPECT_TRUE(test::waitFor([this] { return keptOf("first").empty(); }));
  kill(*node);
  node = started();
  EXPECT_TRUE(node->says("Begins with the map that was kept in"));
}

// Two masters of one address, in two network namespaces or containers that share a folder: each node wrote over the
// other's map.
TEST_F(RunOfMaster, TwoMastersOfOneAddressHaveAMapEach) {
  auto node = started();
  ASSERT_TRUE(becomesOf("first"));
  kill(*node);
  setRun("second");
  node = started();
  ASSERT_TRUE(becomesOf("second"));
  kill(*node);
  setRun("first");
  node = started();
  EXPECT_TRUE(node->says("Begins with the map that was kept in"));
}

// The question for it was asked once: where it failed, the diagnostics said for ever that the map was kept.
TEST_F(RunOfMaster, IsAskedForUntilThereIsOne) {
  tellMaster("deleteParam", {XmlRpc::XmlRpcValue("/test"), XmlRpc::XmlRpcValue("/run_id")});
  const auto node = started();
  EXPECT_TRUE(node->says("cannot be kept for a node that starts again: the master has no /run_id"));
  setRun("first");
  EXPECT_TRUE(becomesOf("first"));
}

// What lies there is not written over by a node that has not begun with it, however old.
TEST_F(RunOfMaster, ThatComesLateTakesNothingThatWasKept) {
  auto node = started();
  ASSERT_TRUE(becomesOf("first"));
  kill(*node);
  const std::filesystem::path kept = keptOf("first");
  const auto long_ago = std::filesystem::last_write_time(kept) - std::chrono::hours(2);
  std::filesystem::last_write_time(kept, long_ago);
  tellMaster("deleteParam", {XmlRpc::XmlRpcValue("/test"), XmlRpc::XmlRpcValue("/run_id")});
  node = started();
  ASSERT_TRUE(node->says("the master has no /run_id"));
  setRun("first");
  EXPECT_TRUE(node->says("is of this run and was not begun with"));
  ASSERT_TRUE(std::filesystem::exists(kept));
  EXPECT_EQ(std::filesystem::last_write_time(kept), long_ago);
}

// One question that a busy master lost, and a node that was killed began with an empty world.
TEST_F(RunOfMaster, IsAskedForAgainWhereAQuestionIsLost) {
  const test::TemporaryFolder apart;
  master_.stayBehind(apart.path("lossy"));
  auto node = started();
  ASSERT_TRUE(becomesOf("first"));
  kill(*node);
  apart.write("lossy", "x");
  node = started();
  EXPECT_TRUE(node->says("Begins with the map that was kept in"));
}

TEST_F(RunOfMaster, OfLongAgoIsForgotten) {
  auto node = started();
  ASSERT_TRUE(becomesOf("first"));
  kill(*node);
  const std::string name = keptOf("first").filename().string();
  const std::string before = name.substr(0, name.rfind("first"));
  writeKept(before + "long-ago.ot", 2);
  writeKept(before + "now.ot", 0);
  writeKept(".other" + before + "long-ago.ot", 2);
  node = started();
  EXPECT_TRUE(node->says("Begins with the map that was kept in"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path(before + "long-ago.ot")));
  EXPECT_TRUE(std::filesystem::exists(folder_.path(before + "now.ot")));
  EXPECT_TRUE(std::filesystem::exists(folder_.path(".other" + before + "long-ago.ot")));
}

}  // namespace
}  // namespace grid_path_planner::nodes
