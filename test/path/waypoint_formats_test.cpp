// Waypoints in the formats of other programs: samples of theirs, what is written read again, refusals.
#include "path/waypoint_formats/waypoint_formats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"
#include "support/text_variants.h"

namespace grid_path_planner::path {
namespace {

using test::contains;
using test::errorText;

const Datum kDatum = {{53.5, 8.1, 3.0}, 0.3};

class WaypointFormats : public testing::Test {
 protected:
  Path read(const std::string& name, const std::string& content,
            const std::optional<Datum>& datum = kDatum) const {
    const std::string file = folder_.write(name, content);
    return readWaypoints(file, waypointFormatOf(file), datum);
  }
  std::string refusal(const std::string& name, const std::string& content) const {
    return errorText([&] { read(name, content); });
  }

  const test::TemporaryFolder folder_;
};

// As export_to_file() of uuv_waypoints writes it.
TEST_F(WaypointFormats, ReadsTheFilesOfUuvSimulator) {
  const Path path = read("uuv.yaml",
                         "inertial_frame_id: world\n"
                         "waypoints:\n"
                         "- heading: 1.5\n"
                         "  max_forward_speed: 0.4\n"
                         "  point: [1.0, -2.5, -20.0]\n"
                         "  use_fixed_heading: true\n"
                         "- heading: 0.0\n"
                         "  max_forward_speed: 0.4\n"
                         "  point: [1.0, 7.5, -21.0]\n"
                         "  use_fixed_heading: false\n");
  ASSERT_EQ(path.poses.size(), 2u);
  EXPECT_EQ(path.frame_id, "world");
  EXPECT_EQ(path.poses[0].position, Eigen::Vector3d(1.0, -2.5, -20.0));
  EXPECT_EQ(path.poses[0].yaw, 1.5);
  EXPECT_NEAR(path.poses[1].yaw, M_PI / 2, 1e-12) << "along the path";
}

// Spreadsheets begin UTF-8 with a mark, and Windows ends lines with CR LF.
TEST_F(WaypointFormats, WhatEditorsLeaveIsRead) {
  const std::pair<const char*, const char*> files[] = {
      {"a.csv", "# frame_id: odom\nx,y,z,yaw\n1,2,3,0.5\n"},
      {"b.csv", "1, 2, 3, 0.5\n"},
      {"uuv.yaml",
       "inertial_frame_id: world\nwaypoints:\n- heading: 0.5\n  point: [1, 2, 3]\n"
       "  max_forward_speed: 1\n  use_fixed_heading: true\n"},
      {"poses.yaml",
       "poses:\n- position: {x: 1, y: 2, z: 3}\n"
       "  orientation: {x: 0, y: 0, z: 0.247403959, w: 0.968912422}\n"},
      {"planner.yaml",
       "header: {frame_id: map}\nwaypoints:\n  - position: {x: 1.0, y: 2.0, z: 3.0}\n"
       "    orientation: {x: 0.0, y: 0.0, z: 0.247403959, w: 0.968912422}\n"}};
  for (const auto& [file, content] : files)
    for (const auto& [name, text] :
         test::variantsOf(content, std::string(file).back() == 'v' ? " " : ": ")) {
      const Path path = read(file, text);
      ASSERT_EQ(path.poses.size(), 1u) << file << ", " << name;
      EXPECT_EQ(path.poses[0].position, Eigen::Vector3d(1.0, 2.0, 3.0)) << file << ", " << name;
      EXPECT_NEAR(path.poses[0].yaw, 0.5, 1e-8) << file << ", " << name;
    }
}

// The older files are the list alone.
TEST_F(WaypointFormats, ReadsOlderFilesOfUuvSimulator) {
  const Path path = read("old.yaml",
                         "- {point: [0, 0, 1], heading: 0.5, max_forward_speed: 1,"
                         " use_fixed_heading: false}\n"
                         "- {point: [3, 0, 1], heading: 0, max_forward_speed: 1,"
                         " use_fixed_heading: false}\n");
  ASSERT_EQ(path.poses.size(), 2u);
  EXPECT_NEAR(path.poses[0].yaw, 0.5, 1e-12) << "beside the direction of the path";
}

TEST_F(WaypointFormats, NorthEastDownBecomesEastNorthUp) {
  const Path path = read("ned.yaml",
                         "inertial_frame_id: world_ned\n"
                         "waypoints:\n"
                         "- {point: [10, 2, 5], heading: 0, max_forward_speed: 1,"
                         " use_fixed_heading: true}\n");
  EXPECT_EQ(path.poses[0].position, Eigen::Vector3d(2.0, 10.0, -5.0));
  EXPECT_NEAR(path.poses[0].yaw, M_PI / 2, 1e-12) << "to the north";
}

// As `rostopic echo -n 1` prints it.
TEST_F(WaypointFormats, ReadsPoseArrays) {
  const Path path = read("poses.yaml",
                         "header: \n  seq: 0\n  stamp: \n    secs: 1\n    nsecs: 5\n"
                         "  frame_id: \"odom\"\nposes: \n"
                         "  - \n    position: \n      x: 1.5\n      y: 2.0\n      z: 0.0\n"
                         "    orientation: \n      x: 0.0\n      y: 0.0\n      z: 1.0\n"
                         "      w: 0.0\n---\n");
  ASSERT_EQ(path.poses.size(), 1u);
  EXPECT_EQ(path.frame_id, "odom");
  EXPECT_EQ(path.poses[0].position, Eigen::Vector3d(1.5, 2.0, 0.0));
  EXPECT_NEAR(std::abs(path.poses[0].yaw), M_PI, 1e-12);
}

TEST_F(WaypointFormats, ReadsCsvWithAndWithoutNames) {
  const Path named = read("a.csv", "# by hand\r\n\r\nyaw, y, x\r\n0.5, 2, 1\r\n0.5, 2, 4\r\n");
  ASSERT_EQ(named.poses.size(), 2u);
  EXPECT_EQ(named.poses[1].position, Eigen::Vector3d(4.0, 2.0, 0.0));
  EXPECT_EQ(named.poses[1].yaw, 0.5);
  const Path plain = read("b.csv", "1,2\n1,5\n");
  ASSERT_EQ(plain.poses.size(), 2u);
  EXPECT_NEAR(plain.poses[0].yaw, M_PI / 2, 1e-12) << "along the path";
  EXPECT_NEAR(plain.poses[1].yaw, M_PI / 2, 1e-12);
}

// As drawn with a map in the browser: no altitudes, no yaws.
TEST_F(WaypointFormats, ReadsDrawnGeojson) {
  const std::string line =
      "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{},"
      "\"geometry\":{\"coordinates\":[[8.1,53.5],[8.1,53.501]],\"type\":\"LineString\"}}]}";
  const Path path = read("drawn.geojson", line, Datum{{53.5, 8.1, 0.0}, 0.0});
  ASSERT_EQ(path.poses.size(), 2u);
  EXPECT_NEAR(path.poses[0].position.norm(), 0.0, 1e-6);
  EXPECT_NEAR(path.poses[1].position.y(), 111.29, 0.02);
  EXPECT_EQ(path.poses[1].position.z(), 0.0);
  EXPECT_NEAR(path.poses[0].yaw, M_PI / 2, 1e-6);
}

TEST_F(WaypointFormats, WhatIsWrittenIsReadAgain) {
  std::mt19937 random(40);
  std::uniform_real_distribution<double> place(-500.0, 500.0), turn(-M_PI, M_PI);
  for (const auto& choice : choicesOf(WaypointFormat::PLANNER))
    for (int count = 1; count < 6; ++count) {
      Path path;
      path.frame_id = choice.second == WaypointFormat::UUV ? "world" : "odom";
      for (int i = 0; i < count; ++i) {
        Pose pose;
        pose.position << place(random), place(random), place(random) / 10.0;
        pose.yaw = turn(random);
        path.poses.push_back(pose);
      }
      const std::string file = folder_.write("again", "");
      writeWaypoints(file, choice.second, path, {kDatum, 0.4});
      const Path again = readWaypoints(file, choice.second, kDatum);
      EXPECT_EQ(again.frame_id, path.frame_id) << choice.first;
      ASSERT_EQ(again.poses.size(), path.poses.size()) << choice.first;
      for (std::size_t i = 0; i < path.poses.size(); ++i) {
        EXPECT_LT((again.poses[i].position - path.poses[i].position).norm(), 2e-6) << choice.first;
        EXPECT_LT(std::abs(std::remainder(again.poses[i].yaw - path.poses[i].yaw, 2 * M_PI)), 1e-8)
            << choice.first;
      }
    }
}

// What users of move_base have: follow_waypoints saves pose.csv without names, others name the columns, and a path is
// echoed. Two of the three were refused.
TEST_F(WaypointFormats, ReadsWhatFollowWaypointsAndRostopicWrite) {
  const std::string pose = "  - \n    header: \n      frame_id: \"map\"\n    pose: \n";
  const std::pair<const char*, std::string> files[] = {
      {"pose.csv", "1.0,2.0,0.0,0.0,0.0,0.0,1.0\n3.0,2.0,0.0,0.0,0.0,0.7071068,0.7071068\n"},
      {"named.csv", "qw,qx,qy,qz,x,y\n1,0,0,0,1,2\n0.7071068,0,0,0.7071068,3,2\n"},
      {"rpy.csv", "x,y,z,roll,pitch,yaw\n1.0,2.0,0.0,0.01,0.0,0.0\n3.0,2.0,0.0,0.0,0.0,1.570796\n"},
      {"path.yaml", "header: \n  frame_id: \"map\"\nposes: \n" + pose +
                        "      position: {x: 1.0, y: 2.0, z: 0.0}\n"
                        "      orientation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}\n" +
                        pose +
                        "      position: {x: 3.0, y: 2.0, z: 0.0}\n"
                        "      orientation: {x: 0.0, y: 0.0, z: 0.7071068, w: 0.7071068}\n---\n"}};
  for (const auto& [name, content] : files) {
    const Path path = read(name, content);
    ASSERT_EQ(path.poses.size(), 2u) << name;
    EXPECT_EQ(path.poses[0].position, Eigen::Vector3d(1.0, 2.0, 0.0)) << name;
    EXPECT_EQ(path.poses[1].position, Eigen::Vector3d(3.0, 2.0, 0.0)) << name;
    EXPECT_NEAR(path.poses[0].yaw, 0.0, 1e-6) << name;
    EXPECT_NEAR(path.poses[1].yaw, M_PI / 2, 1e-6) << name;
  }
}

// Coordinates of utm are millions of metres, until tf brings them into the map.
TEST_F(WaypointFormats, AFrameThatIsNotTheMapsMayBeFarFromIt) {
  const Path path = read("utm.csv", "# frame_id: utm\n500006.46061108634,4500006.1855076095\n");
  EXPECT_EQ(path.poses[0].position.y(), 4500006.1855076095);
  const std::string file = folder_.write("utm.yaml", "");
  writeWaypoints(file, WaypointFormat::PLANNER, path, {});
  EXPECT_NEAR(readWaypointFile(file).path.poses[0].position.y(), 4500006.1855076095, 1e-6);
  EXPECT_TRUE(
      contains(refusal("a.csv", "# frame_id: utm\n1,1e9\n"), "a.csv:2: y must be within 1e8"));
}

TEST_F(WaypointFormats, RefusalsNameTheLine) {
  const auto isRefused = [&](const std::string& name, const std::string& content,
                             const std::string& words) {
    EXPECT_TRUE(contains(refusal(name, content), words)) << refusal(name, content);
  };
  isRefused("a.csv", "x,y\n1,2\n3\n", "a.csv:3: expected 2 values");
  isRefused("a.csv", "1,2\n1,abc\n", "a.csv:2: ");
  isRefused("a.csv", "1,2\n1,nan\n", "a.csv:2: ");
  isRefused("a.csv", "1,1e180\n", "a.csv:1: y must be within 1e6");
  isRefused("a.csv", "x,x\n", "a.csv:1: the columns are");
  isRefused("a.csv", "x,z\n", "a.csv:1: there must be columns x and y");
  isRefused("a.csv", "# nothing\n", "holds no waypoint");
  isRefused("a.csv", "1,2,3,4,5\n", "a.csv:1: a waypoint is x,y or");
  isRefused("a.csv", "1,2,0,0,0,0,0\n", "a.csv:1: orientation x 0 y 0 z 0 w 0 has length zero");
  isRefused("a.csv", "x,y,qw\n", "a.csv:1: a quaternion has the columns");
  isRefused("a.csv", "x,y,qx,qy,qz,qw,yaw\n", "a.csv:1: a waypoint has either");
  isRefused("a.csv", "x,y,roll\n1,2,1\n", "a.csv:2: the orientation must tilt by at most 0.7");
  isRefused("u.yaml", "inertial_frame_id: world\nwaypoints:\n- point: [1, 2]\n",
            "u.yaml:3: the point of waypoint 1 must be a list [x, y, z]");
  isRefused("u.yaml", "inertial_frame_id: moon\nwaypoints: []\n", "u.yaml:1: ");
  isRefused("u.yaml", "inertial_frame_id: world\nwaypoints: []\n", "at least one");
  isRefused("p.yaml", "poses: []\n", "p.yaml:1: poses must be a list of at least one pose");
  isRefused("p.yaml", "poses:\n- position: {x: 0, y: .inf, z: 0}\n  orientation: {w: 1, z: 0}\n",
            "p.yaml:2: y of waypoint 1");
  isRefused("p.yaml", "header:\n  frame_id: o\fm\nposes: [{position: {x: 0, y: 0, z: 0}}]\n",
            "p.yaml:2: frame_id must be the name of a frame, got one with control characters");
  isRefused("n.yaml", "nothing: 1\n", "neither waypoints nor poses");
  isRefused("g.json", "{\"type\": \"Point\",\n\"coordinates\": [8.1, 153]}",
            "g.json:2: the latitude of position 1");
  isRefused("g.json", "{\"type\": \"Point\", \"coordinates\": [100, 20]}", "1e6 m from the datum");
  isRefused("g.json", "{\"type\": \"Polygon\", \"coordinates\": []}", "got 'Polygon'");
  isRefused("g.json", "{\"type\": \"FeatureCollection\", \"features\": []}", "holds no waypoint");
  isRefused("w.txt", "1,2\n", "must end in");
  const std::string point =
      folder_.write("d.json", "{\"type\": \"Point\", \"coordinates\": [8, 53]}");
  EXPECT_TRUE(contains(
      errorText([&] { readWaypoints(point, WaypointFormat::GEOJSON, std::nullopt); }), "datum"));
}

TEST_F(WaypointFormats, WhatCannotBeReadAgainIsNotWritten) {
  Path path;
  const std::string file = folder_.write("old.csv", "1,2\n");
  const auto writing = [&](WaypointFormat format) {
    return errorText([&] { writeWaypoints(file, format, path, {}); });
  };
  EXPECT_TRUE(contains(writing(WaypointFormat::CSV), "without waypoints"));
  path.poses.resize(1);
  EXPECT_TRUE(contains(writing(WaypointFormat::GEOJSON), "datum"));
  path.frame_id = "a b";
  EXPECT_TRUE(contains(writing(WaypointFormat::CSV), "no frame 'a b'"));
  path.frame_id = "map";
  path.poses[0].yaw = std::nan("");
  EXPECT_TRUE(contains(writing(WaypointFormat::UUV), "waypoint 1"));
  EXPECT_EQ(readWaypoints(file, WaypointFormat::CSV, {}).poses.size(), 1u) << "as it was";
}

}  // namespace
}  // namespace grid_path_planner::path
