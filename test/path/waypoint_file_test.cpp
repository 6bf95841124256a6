#include "grid_path_planner/path/waypoint_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::path {

using base::InputError;

namespace {

using test::contains;
using test::contentOf;
using test::errorText;
using test::TemporaryFolder;

Path read(const std::string& text) {
  const TemporaryFolder folder;
  return readWaypointFile(folder.write("path.yaml", text)).path;
}

// What is said of a file with this text, from its name on.
std::string complaint(const std::string& text) {
  const TemporaryFolder folder;
  const std::string file = folder.write("path.yaml", text);
  const std::string error = errorText([&] { readWaypointFile(file); });
  EXPECT_EQ(error.find(file), 0u) << error << "\nabout\n" << text;
  return error.substr(error.find("path.yaml"));
}

std::string entry(const std::string& position, const std::string& orientation) {
  return "  - position: {" + position + "}\n    orientation: {" + orientation + "}\n";
}

const std::string kGood = entry("x: 1.0, y: 2.0, z: 3.0", "x: 0.0, y: 0.0, z: 0.0, w: 1.0");

// A file whose second waypoint is `bad`.
std::string secondIs(const std::string& bad) {
  return "waypoints:\n" + kGood + bad;
}

Path onePose(double x, double y, double z, double yaw) {
  Path path;
  path.poses.resize(1);
  path.poses[0].position << x, y, z;
  path.poses[0].yaw = yaw;
  return path;
}

TEST(WaypointFile, IsReadAsDocumented) {
  const Path path = read(
      "header: {frame_id: odom}\n"
      "waypoints:\n"
      "  - position: {x: 13.5, y: -13.5, z: 4.5}\n"
      "    orientation: {x: 0.0, y: 0.0, z: 0.745, w: 0.663}\n");
  EXPECT_EQ(path.frame_id, "odom");
  ASSERT_EQ(path.poses.size(), 1u);
  EXPECT_EQ(path.poses[0].position, Eigen::Vector3d(13.5, -13.5, 4.5));
  EXPECT_NEAR(path.poses[0].yaw, 2 * std::atan2(0.745, 0.663), 1e-15);
}

TEST(WaypointFile, TheShortFormIsRead) {
  const Path path = read(
      "waypoints:\n"
      "  - {x: 13.5, y: -13.5, yaw: 1.5}\n"
      "  - {yaw: -4.0, z: 2, y: 1, x: 0}\n");
  ASSERT_EQ(path.poses.size(), 2u);
  EXPECT_EQ(path.poses[0].position, Eigen::Vector3d(13.5, -13.5, 0.0));
  EXPECT_EQ(path.poses[0].yaw, 1.5);
  EXPECT_EQ(path.poses[1].position, Eigen::Vector3d(0.0, 1.0, 2.0));
  EXPECT_NEAR(path.poses[1].yaw, 2 * M_PI - 4.0, 1e-12);
  EXPECT_TRUE(contains(complaint("waypoints:\n  - {x: 1, y: 2}\n"), "waypoint 1 has no yaw"));
}

// {x: 1,5, y: 2} was read as x 1, a metre and a half became one; of two x the first counted.
TEST(WaypointFile, StrayAndSecondKeysAreNamedWithLineAndColumn) {
  const std::string turned = "x: 0, y: 0, z: 0, w: 1";
  EXPECT_EQ(complaint(secondIs(entry("x: 1,5, y: 2, z: 3", turned))),
            "path.yaml:4: the position of waypoint 2 has the key '5' at column 21, which means "
            "nothing there");
  EXPECT_EQ(complaint(secondIs(entry("x: 1, y: 2, x: 3, z: 0", turned))),
            "path.yaml:4: the position of waypoint 2 has a second key 'x' at column 28");
  EXPECT_TRUE(contains(complaint(secondIs(entry("x: 1, y: 2, z: 3", turned + ", v: 1"))),
                       "path.yaml:5: the orientation of waypoint 2 has the key 'v'"));
  EXPECT_TRUE(contains(complaint("waypoints:\n  - {x: 1, y: 2,5, yaw: 0}\n"),
                       "waypoint 1 has the key '5' at column 17"));
  EXPECT_TRUE(contains(complaint(secondIs("  - position: {x: 1, y: 2, z: 3}\n"
                                          "    position: {x: 1, y: 2, z: 3}\n")),
                       "waypoint 2 has a second key 'position'"));
}

// The original study wrote nested lines, no header, one z and one orientation.
TEST(WaypointFile, OriginalFilesAreRead) {
  const Path path = read(
      "waypoints:\n"
      "- position:\n"
      "    x: -9.25\n"
      "    y: 1e-3\n"
      "    z: 4.5\n"
      "  orientation:\n"
      "    x: 0\n"
      "    y: 0\n"
      "    z: 0.745\n"
      "    w: 0.663\n"
      "\n"
      "- orientation: {z: 0.745, w: 0.663}  # the order is free, and x and y may be left out\n"
      "  position: {z: 4.5, y: 2, x: 1}\n");
  EXPECT_EQ(path.frame_id, "map");
  ASSERT_EQ(path.poses.size(), 2u);
  EXPECT_EQ(path.poses[0].position, Eigen::Vector3d(-9.25, 0.001, 4.5));
  EXPECT_EQ(path.poses[1].position, Eigen::Vector3d(1, 2, 4.5));
  EXPECT_EQ(path.poses[0].yaw, path.poses[1].yaw);
}

TEST(WaypointFile, OrientationsNeedNotBeOfLengthOne) {
  for (const std::string length : {"3e-6", "0.1", "5", "1e300"}) {
    const Path path =
        read("waypoints:\n" + entry("x: 0, y: 0, z: 0", "z: " + length + ", w: " + length));
    EXPECT_NEAR(path.poses[0].yaw, M_PI / 2, 1e-15) << length;
  }
}

TEST(WaypointFile, YawsAreNormalised) {
  const Path path = read("waypoints:\n" + entry("x: 0, y: 0, z: 0", "z: 0.6, w: -0.8"));
  EXPECT_NEAR(path.poses[0].yaw, -2 * std::atan2(0.6, 0.8), 1e-15);
}

// navigation2#2186: "/map" is "map".
TEST(WaypointFile, LeadingSlashOfTheFrameIsDropped) {
  EXPECT_EQ(read("header: {frame_id: /map}\nwaypoints:\n" + kGood).frame_id, "map");
  // One was taken away, so that each time the file was written another one went: a finding of the fuzzer.
  EXPECT_EQ(read("header: {frame_id: //map}\nwaypoints:\n" + kGood).frame_id, "map");
}

TEST(WaypointFile, HeaderWithoutAFrameIsTheMaps) {
  EXPECT_EQ(read("header: {seq: 3}\nwaypoints:\n" + kGood).frame_id, "map");
}

// One with a tab was read, and could not be written again: a finding of the fuzzer.
TEST(WaypointFile, BadHeadersAreNamed) {
  const std::string rest = "\nwaypoints:\n" + kGood;
  for (const std::string frame :
       {"''", "/", "//", "[map]", "", R"("a\tmap")", R"("two\nlines")", "'a\tmap'"})
    EXPECT_TRUE(contains(complaint("header: {frame_id: " + frame + "}" + rest), "frame_id must be"))
        << frame;
  EXPECT_TRUE(contains(complaint("header: map" + rest), "path.yaml:1: "));
}

// navigation2 PR#3165: zero waypoints crash.
TEST(WaypointFile, ZeroWaypointsAreRefused) {
  for (const std::string list : {"[]", "", "{}", "3"})
    EXPECT_TRUE(contains(complaint("waypoints: " + list + "\n"), "at least one waypoint")) << list;
  EXPECT_TRUE(contains(complaint("poses: []\n"), "path.yaml:1: has no 'waypoints'"));
  EXPECT_TRUE(contains(complaint("- 1\n"), "got a list"));
}

TEST(WaypointFile, NumbersThatAreNotFiniteAreNamed) {
  for (const std::string value : {".nan", ".inf", "-.inf", "1e400", "nan"}) {
    const std::string text =
        complaint(secondIs(entry("x: 1, y: " + value + ", z: 0", "z: 0, w: 1")));
    EXPECT_EQ(text, "path.yaml:4: y of waypoint 2 must be a finite number, got '" + value + "'");
  }
  EXPECT_EQ(complaint(secondIs(entry("x: 1, y: 1, z: 0", "z: 0, w: .nan"))),
            "path.yaml:5: w of waypoint 2 must be a finite number, got '.nan'");
}

// uuv_simulator: coordinates of 1e180 were driven to.
TEST(WaypointFile, AbsurdCoordinatesAreNamed) {
  EXPECT_EQ(complaint(secondIs(entry("x: 1, y: 1, z: 1e180", "z: 0, w: 1"))),
            "path.yaml:4: z of waypoint 2 must be within 1e6 m of 0, got '1e180'");
  EXPECT_TRUE(contains(complaint(secondIs(entry("x: -1000000.1, y: 1, z: 1", "z: 0, w: 1"))),
                       "x of waypoint 2"));
  EXPECT_EQ(read(secondIs(entry("x: -1e6, y: 1e6, z: 0", "z: 0, w: 1"))).poses.size(), 2u);
}

TEST(WaypointFile, MissingFieldsAreNamed) {
  EXPECT_EQ(complaint(secondIs("  - position: {x: 1, y: 2, z: 3}\n")),
            "path.yaml:4: waypoint 2 has no orientation");
  EXPECT_EQ(complaint(secondIs("  - orientation: {z: 0, w: 1}\n")),
            "path.yaml:4: waypoint 2 has no position");
  EXPECT_EQ(complaint(secondIs(entry("x: 1, y: 2", "z: 0, w: 1"))),
            "path.yaml:4: waypoint 2 has no z");
  EXPECT_EQ(complaint(secondIs(entry("x: 1, y: 2, z: 3", "x: 0, y: 0, z: 0"))),
            "path.yaml:5: waypoint 2 has no w");
}

TEST(WaypointFile, WrongTypesAreNamed) {
  const auto position = [](const std::string& x) {
    return complaint(secondIs(entry("x: " + x + ", y: 0, z: 0", "z: 0, w: 1")));
  };
  for (const std::string x : {"far", "[1]", "{a: 1}", "", "'1 2'", "0x", "true", "1.5.2"})
    EXPECT_TRUE(contains(position(x), "x of waypoint 2 must be a finite number")) << x;
  EXPECT_TRUE(contains(complaint(secondIs("  - 3\n")), "waypoint 2 must have a position"));
  EXPECT_TRUE(contains(complaint(secondIs("  - [1, 2, 3]\n")), "waypoint 2 must have a position"));
  EXPECT_TRUE(contains(complaint(secondIs("  - position: [1, 2, 3]\n    orientation: 0\n")),
                       "the position of waypoint 2 must have x, y and z, got a list"));
}

TEST(WaypointFile, ZeroQuaternionIsNamed) {
  EXPECT_EQ(complaint(secondIs(entry("x: 0, y: 0, z: 0", "x: 0, y: 0, z: 0, w: 0"))),
            "path.yaml:5: waypoint 2: orientation x 0 y 0 z 0 w 0 has length zero");
}

TEST(WaypointFile, TheYawOfATiltedWaypointIsTakenAndItsTiltTold) {
  // As the original study printed it: by roll and pitch together 6.85 degrees from upright.
  const std::string text =
      "waypoints:\n" +
      entry("x: 13.5, y: -13.5, z: 4.5", "x: 0.0444, y: -0.0400, z: 0.745, w: 0.663") +
      entry("x: 1, y: 2, z: 3", "z: 0, w: 1");
  const TemporaryFolder folder;
  const WaypointFile published = readWaypointFile(folder.write("published.yaml", text));
  EXPECT_NEAR(published.tilt, 6.85 * M_PI / 180.0, 1e-3);
  // Where its x axis points: (1 - 2 (y^2 + z^2), 2 (x y + z w)), of the normalised quaternion.
  EXPECT_NEAR(published.path.poses[0].yaw, std::atan2(0.98613, -0.11530), 1e-4);
  EXPECT_EQ(published.path.poses[0].position, Eigen::Vector3d(13.5, -13.5, 4.5));
  EXPECT_EQ(published.path.poses[1].yaw, 0.0);
}

TEST(WaypointFile, ALargeTiltIsRefused) {
  for (const std::string tilted : {"x: 0.5, y: 0, z: 0, w: 1", "x: 0, y: -0.4, z: 0.7, w: 0.7",
                                   "x: 1, y: 0, z: 0, w: 0", "x: 1e300, y: 1e300, z: 1, w: 1"}) {
    const std::string error = complaint(secondIs(entry("x: 0, y: 0, z: 0", tilted)));
    EXPECT_EQ(error.find("path.yaml:5: waypoint 2: the orientation must tilt by at most 0.7 rad"),
              0u)
        << error;
  }
}

TEST(WaypointFile, FilesThatAreNoWaypointsAreRefused) {
  EXPECT_TRUE(contains(complaint(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16)), "not text"));
  EXPECT_TRUE(contains(complaint("waypoints: " + std::string(100000, '[')), "nested deeper"));
  EXPECT_TRUE(contains(complaint("waypoints: [}\n"), "not YAML"));
  EXPECT_TRUE(contains(complaint(""), "empty"));
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(errorText([&] { readWaypointFile(folder.path("none.yaml")); }),
                       "none.yaml: cannot be read"));
  EXPECT_TRUE(contains(errorText([&] { readWaypointFile(folder.path(".")); }), "directory"));
}

TEST(WaypointFile, WritesTheDocumentedForm) {
  const TemporaryFolder folder;
  const std::string file = folder.path("path.yaml");
  writeWaypointFile(file, onePose(13.5, -1e-7, 4, 0));
  EXPECT_EQ(contentOf(file),
            "header: {frame_id: map}\n"
            "waypoints:\n"
            "  - position: {x: 13.5, y: 0.0, z: 4.0}\n"
            "    orientation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}\n");
}

TEST(WaypointFile, EveryFrameComesBack) {
  const TemporaryFolder folder;
  const std::string file = folder.path("path.yaml");
  for (const std::string frame : {"map", "robot1/odom", "null", "true", "12", "a b", "a: {b}",
                                  "\"quoted\\\" #", "~", "x-y", "Yes", "off", "\x7f"}) {
    Path path = onePose(1, 2, 3, 0);
    path.frame_id = frame;
    writeWaypointFile(file, path);
    EXPECT_EQ(readWaypointFile(file).path.frame_id, frame);
  }
}

// $(touch x) as the frame of a map stood in the file as it was, for whatever shell read it.
TEST(WaypointFile, NothingOfAFrameMeansAnythingToAShell) {
  const TemporaryFolder folder;
  const std::string file = folder.path("path.yaml");
  for (const std::string frame : {"$(touch x)", "`touch x`", "a\"; touch x; \"", "a'b", "a\\b"}) {
    Path path = onePose(1, 2, 3, 0);
    path.frame_id = frame;
    writeWaypointFile(file, path);
    const std::string first_line = contentOf(file).substr(0, contentOf(file).find('\n'));
    EXPECT_EQ(first_line.find_first_of("$`'"), std::string::npos) << first_line;
    EXPECT_EQ(std::count(first_line.begin(), first_line.end(), '"'), 2) << first_line;
    EXPECT_EQ(readWaypointFile(file).path.frame_id, frame);
  }
}

TEST(WaypointFile, WhatCouldNotBeReadBackIsNotWritten) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TemporaryFolder folder;
  const std::string file = folder.write("path.yaml", "old");
  const auto refusal = [&](const Path& path) {
    return errorText([&] { writeWaypointFile(file, path); });
  };
  EXPECT_EQ(refusal(Path()), file + ": is not written: a path without waypoints");
  EXPECT_TRUE(contains(refusal(onePose(nan, 0, 0, 0)), "waypoint 1"));
  EXPECT_TRUE(contains(refusal(onePose(0, 0, 0, nan)), "waypoint 1"));
  EXPECT_TRUE(contains(refusal(onePose(0, 2e6, 0, 0)), "waypoint 1"));
  for (const std::string frame : {"", "/", "two\nlines"}) {
    Path path = onePose(0, 0, 0, 0);
    path.frame_id = frame;
    EXPECT_TRUE(contains(refusal(path), "frame")) << frame;
  }
  EXPECT_EQ(contentOf(file), "old");
}

TEST(WaypointFile, APlaceThatCannotBeWrittenIsNamed) {
  const TemporaryFolder folder;
  const std::string parent = folder.write("file", "not a folder");
  const std::string error =
      errorText([&] { writeWaypointFile(parent + "/path.yaml", onePose(0, 0, 0, 0)); });
  EXPECT_EQ(error, parent + "/path.yaml: cannot be written: Not a directory");
  EXPECT_EQ(contentOf(parent), "not a folder");
}

// A full disk, as a limit on the size of files in a process of its own.
TEST(WaypointFile, FullDiskLeavesTheOldFileWhole) {
  const TemporaryFolder folder;
  const std::string file = folder.path("path.yaml");
  writeWaypointFile(file, onePose(1, 2, 3, 0.5));
  const std::string old = contentOf(file);
  Path longer;
  longer.poses.resize(1000);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const rlimit limit = {4096, 4096};
    setrlimit(RLIMIT_FSIZE, &limit);
    const std::string error = errorText([&] { writeWaypointFile(file, longer); });
    _exit(contains(error, file + ": cannot be written: File too large") ? 42 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 42) << status;
  EXPECT_EQ(contentOf(file), old);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"path.yaml"});
}

}  // namespace
}  // namespace grid_path_planner::path
