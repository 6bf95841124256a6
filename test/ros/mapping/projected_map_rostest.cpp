// projected_map as octomap_server's users know it: clouds to a map, files, services.
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <std_srvs/Empty.h>

#include <filesystem>
#include <fstream>

#include "grid_path_planner/SaveFile.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/mapping/octree_map.h"
#include "ros/mapping/mapping_services.h"
#include "ros/support/mapping_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {

using grid::readMapFile;
using mapping::OctreeMap;
using mapping::OctreeOptions;

namespace {

using test::valueAt;
using test::wallAt;

class ProjectedMapTest : public test::MappingTest {
 protected:
  SaveFile::Response save(const std::string& service, const std::string& file) {
    SaveFile call;
    call.request.filename = file;
    EXPECT_TRUE(ros::service::call("/projected_map/" + service, call));
    return call.response;
  }
  // An octree with one occupied voxel at (1.05, 0.05, 0.05).
  std::string octreeFile(const std::string& name) {
    OctreeOptions options;
    options.resolution = 0.1;
    OctreeMap map(options);
    map.insert({{0.05F, 0.05F, 0.05F}, {{1.05F, 0.05F, 0.05F}}, {}});
    map.save(folder_.path(name));
    return folder_.path(name);
  }

  const test::TemporaryFolder folder_;
};

TEST_F(ProjectedMapTest, ACloudInTheSensorsFrameBecomesAMap) {
  startMapping();
  const Maps maps(nh_, "projected_map");
  const ros::Time stamp = ros::Time::now();
  placeSensor(1.0, 2.0, 0.5, "sensor", stamp);
  clouds_.publish(test::cloudOf(wallAt(2.0F), "sensor", stamp));
  ASSERT_TRUE(becomes(maps, 3.05, 2.05, 100));
  const nav_msgs::OccupancyGrid map = maps.all().back();
  EXPECT_EQ(map.header.frame_id, "map");
  EXPECT_FLOAT_EQ(map.info.resolution, 0.1F);
  EXPECT_EQ(valueAt(map, 2.05, 2.05), 0) << "between sensor and wall";
  EXPECT_EQ(valueAt(map, 3.35, 2.05), -1) << "behind the wall";
}

// octomap_mapping PR#127 and #90, and the band of existing launch files.
TEST_F(ProjectedMapTest, TheBandIsOccupancyZUnlessItIsSetItself) {
  startMapping({"_occupancy_min_z:=0.3", "_occupancy_max_z:=0.5"});
  const Maps maps(nh_, "projected_map");
  publish(wallAt(2.0F, -0.45F, 0.05F));
  const auto map = maps.waitFor(0, [](const auto& m) { return m.info.width > 1; });
  ASSERT_TRUE(map);
  EXPECT_EQ(valueAt(*map, 2.05, 0.05), -1) << "the wall ends below the band";
  startMapping({"_occupancy_min_z:=0.3", "_occupancy_max_z:=0.5", "_projection_min_z:=-0.5"});
  publish(wallAt(2.0F, -0.45F, 0.05F));
  EXPECT_TRUE(becomes(maps, 2.05, 0.05, 100));
}

// octomap_mapping#85, PR#34: reset gave no answer, an empty tree crashed.
TEST_F(ProjectedMapTest, OM85ResetPublishesAClearedGridOfTheSameExtent) {
  startMapping();
  const Maps maps(nh_, "projected_map");
  ASSERT_TRUE(maps.waitForMoreThan(0)) << "an empty tree is a map too";
  EXPECT_EQ(maps.all().back().data, (std::vector<std::int8_t>{-1}));
  std_srvs::Empty call;
  EXPECT_TRUE(ros::service::call("/projected_map/reset", call)) << "of an empty tree";
  publish(wallAt(2.0F));
  ASSERT_TRUE(becomes(maps, 2.05, 0.05, 100));
  const nav_msgs::OccupancyGrid before = maps.all().back();
  EXPECT_TRUE(ros::service::call("/projected_map/reset", call));
  const auto cleared = maps.waitFor(0, [&](const nav_msgs::OccupancyGrid& map) {
    return map.info.width == before.info.width &&
           map.data == std::vector<std::int8_t>(before.data.size(), -1);
  });
  ASSERT_TRUE(cleared);
  EXPECT_EQ(cleared->info.origin, before.info.origin);
  publish(wallAt(1.0F));
  EXPECT_TRUE(becomes(maps, 1.05, 0.05, 100)) << "mapping goes on";
}

TEST_F(ProjectedMapTest, ClearBbxFreesABox) {
  startMapping();
  const Maps maps(nh_, "projected_map");
  publish(wallAt(2.0F));
  ASSERT_TRUE(becomes(maps, 2.05, 0.05, 100));
  ClearBoxService call;
  call.request.min.x = 1.9;
  call.request.min.y = -0.2;
  call.request.min.z = -1.0;
  call.request.max.x = 2.2;
  call.request.max.y = 0.2;
  call.request.max.z = 1.0;
  ASSERT_TRUE(ros::service::call("/projected_map/clear_bbx", call));
  EXPECT_TRUE(becomes(maps, 2.05, 0.05, 0));
  EXPECT_EQ(valueAt(maps.all().back(), 2.05, 0.55), 100) << "outside the box";
  std::swap(call.request.min, call.request.max);
  EXPECT_FALSE(ros::service::call("/projected_map/clear_bbx", call));
}

// It was written, in the place of the survey that had been saved before.
TEST_F(ProjectedMapTest, AMapOfNothingIsNotSaved) {
  startMapping({"--save-folder", folder_.path("")});
  const SaveFile::Response saved = save("save_map", "map.yaml");
  EXPECT_FALSE(saved.success);
  EXPECT_EQ(saved.message, "nothing has been mapped yet: every cell is unknown");
  EXPECT_FALSE(std::ifstream(folder_.path("map.yaml")));
}

TEST_F(ProjectedMapTest, MapAndOctreeAreSavedAndLoaded) {
  startMapping({"_octree_file:=parameter.ot", "--save-folder", folder_.path("")});
  const Maps maps(nh_, "projected_map");
  publish(wallAt(2.0F));
  ASSERT_TRUE(becomes(maps, 2.05, 0.05, 100));
  const SaveFile::Response saved = save("save_map", "map.yaml");
  EXPECT_EQ(saved.message.find("written to " + folder_.path("map.yaml")), 0u) << saved.message;
  EXPECT_TRUE(saved.success);
  EXPECT_EQ(readMapFile(folder_.path("map.yaml")), occupancyFromMessage(maps.all().back()));
  EXPECT_TRUE(save("save_octree", folder_.path("tree.bt")).success);
  EXPECT_TRUE(save("save_octree", "").success) << "where the parameter says";
  EXPECT_FALSE(save("save_map", "").success);
  const SaveFile::Response refused = save("save_octree", folder_.path("none/tree.bt"));
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("none/tree.bt"), std::string::npos) << refused.message;
  for (const char* name : {"tree.bt", "parameter.ot"}) {
    startMapping({"_filename:=" + folder_.path(name), "--load-folder", folder_.path("")});
    const Maps loaded(nh_, "projected_map");
    EXPECT_TRUE(becomes(loaded, 2.05, 0.05, 100)) << name;
  }
}

// The name of the refused file was taken for the one in force: the one before was looked for anew with every other
// parameter, and all were refused once it was gone.
TEST_F(ProjectedMapTest, ParametersChangeAfterAFileThatWasRefused) {
  startMapping({"--save-folder", folder_.path("")});
  publish(wallAt(2.0F));
  ASSERT_TRUE(save("save_octree", "tree.bt").success);
  startMapping({"--load-folder", folder_.path("")});
  const auto ask = [](const std::string& name, const std::string& text) {
    dynamic_reconfigure::Reconfigure call;
    call.request.config.strs.resize(1);
    call.request.config.strs[0].name = name;
    call.request.config.strs[0].value = text;
    EXPECT_TRUE(ros::service::call("/projected_map/set_parameters", call));
    std::string now;
    EXPECT_TRUE(ros::param::get("/projected_map/" + name, now));
    return now;
  };
  EXPECT_EQ(ask("filename", "tree.bt"), "tree.bt");
  std::ofstream(folder_.path("damaged.bt")) << "nothing";
  EXPECT_EQ(ask("filename", "damaged.bt"), "tree.bt");
  std::filesystem::remove(folder_.path("tree.bt"));
  EXPECT_EQ(ask("projection_max_z", "1.5"), "1.5");
}

// Nobody listened to the 2-D map while a bag was mapped, and what was saved was all floor without a word.
TEST_F(ProjectedMapTest, WhoSavesAMapOfTheFloorIsTold) {
  startMapping({"--save-folder", folder_.path("")});
  std::vector<Eigen::Vector3f> floor;
  for (int i = 0; i < 900; ++i)
    floor.emplace_back(0.05F + 0.1F * static_cast<float>(i % 30),
                       0.05F + 0.1F * static_cast<float>(i / 30), 0.05F);
  publish(floor);
  ASSERT_TRUE(reports("inserted", "1"));
  const SaveFile::Response saved = save("save_map", "floor.yaml");
  EXPECT_TRUE(saved.success);
  EXPECT_NE(saved.message.find("is the floor mapped as an obstacle?"), std::string::npos)
      << saved.message;
}

// A wrong cloud_topic looked like a slow sensor.
TEST_F(ProjectedMapTest, ATopicOnWhichNoCloudComesIsNamed) {
  startMapping();
  EXPECT_TRUE(node_->says("nothing has come on /cloud_in yet, in 5 s"));
}

// octomap#211: the .bt given as an argument was ignored.
TEST_F(ProjectedMapTest, O211AFileAsArgumentIsLoadedOrTheNodeFailsLoudly) {
  startMapping({octreeFile("one.bt")});
  const Maps maps(nh_, "projected_map");
  EXPECT_TRUE(becomes(maps, 1.05, 0.05, 100));
  node_.reset();
  const std::string damaged = folder_.path("damaged.bt");
  std::ofstream(damaged) << "# Octomap OcTree binary file\nid OcTree\nsize 9\nres 0.1\ndata\nx";
  for (const std::string& file : {damaged, std::string("/no/such/tree.bt")}) {
    test::Process failing("projected_map", {file});
    ASSERT_TRUE(failing.waitForExit());
    EXPECT_EQ(failing.exitCode(), 1);
    EXPECT_TRUE(failing.says(file)) << failing.output();
  }
  test::Process two_files("projected_map", {"a.bt", "b.bt"});
  ASSERT_TRUE(two_files.waitForExit());
  EXPECT_EQ(two_files.exitCode(), 2);
}

// octomap_mapping#90: limits were clamped without a word.
TEST_F(ProjectedMapTest, OM90NothingIsClampedAndUnknownNamesAreSaid) {
  ros::param::del("/projected_map");
  for (const std::string argument :
       {"_sensor_model/hit:=1.5", "_occupancy_min_z:=2e9", "_projection_min_z:=low"}) {
    test::Process failing("projected_map", {argument});
    ASSERT_TRUE(failing.waitForExit());
    EXPECT_EQ(failing.exitCode(), 1);
    EXPECT_TRUE(failing.says("must be")) << failing.output();
    ros::param::del("/projected_map");
  }
  startMapping({"_compress_map:=true", "_sensor_model/hitt:=0.8"});
  EXPECT_TRUE(node_->says("compress_map has no effect"));
  EXPECT_TRUE(node_->says("did you mean sensor_model/hit"));
}

}  // namespace
}  // namespace grid_path_planner::nodes
