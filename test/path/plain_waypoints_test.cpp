// What is written is read without a YAML parser, to the same path.
//
// What was seen before: yaml-cpp took 285 us a waypoint, 5.7 s for 20,000.
#include "path/plain_waypoints.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>

#include "grid_path_planner/path/waypoint_file.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::path {
namespace {

using test::contentOf;

void write(const std::string& file, const std::string& text) {
  std::ofstream(file) << text;
}

Path randomPath(std::mt19937& random, int poses) {
  std::uniform_real_distribution<double> exponent(-12.0, 6.0), yaw(-3.2, 3.2);
  const auto number = [&] {
    return (random() % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, exponent(random));
  };
  Path path;
  path.frame_id = random() % 2 == 0 ? "map" : "site_1/odom";
  for (int i = 0; i < poses; ++i)
    path.poses.push_back({{number(), number(), number()}, yaw(random)});
  return path;
}

TEST(PlainWaypointsLaw, AreReadAsByTheYamlParser) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("a.yaml"), slow = folder.path("b.yaml");
  std::mt19937 random(3);
  for (int trial = 0; trial < 30; ++trial) {
    writeWaypointFile(file, randomPath(random, 1 + static_cast<int>(random() % 9)));
    const std::string text = contentOf(file);
    const auto plain = plainWaypoints(text);
    ASSERT_TRUE(plain) << text;
    write(slow, "# by the parser\n" + text);
    EXPECT_FALSE(plainWaypoints(contentOf(slow)));
    const Path parsed = readWaypointFile(slow).path;
    EXPECT_EQ(plain->frame_id, parsed.frame_id);
    ASSERT_EQ(plain->poses.size(), parsed.poses.size());
    for (std::size_t i = 0; i < parsed.poses.size(); ++i) {
      EXPECT_EQ(plain->poses[i].position, parsed.poses[i].position);
      EXPECT_EQ(plain->poses[i].yaw, parsed.poses[i].yaw);
    }
  }
}

// Whatever byte is changed: it is read as the parser reads it, or left to it.
TEST(PlainWaypointsLaw, WhatDiffersIsLeftToTheParser) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("a.yaml");
  std::mt19937 random(4);
  writeWaypointFile(file, randomPath(random, 3));
  const std::string text = contentOf(file);
  int plain_ones = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string changed = text;
    const char letters[] = "0123456789.-+eE{}:, \n#xyzwnaif\t\"";
    changed[random() % changed.size()] = letters[random() % (sizeof(letters) - 1)];
    const auto plain = plainWaypoints(changed);
    if (!plain) continue;
    ++plain_ones;
    write(file, "# by the parser\n" + changed);
    const Path parsed = readWaypointFile(file).path;
    ASSERT_EQ(plain->frame_id, parsed.frame_id) << changed;
    ASSERT_EQ(plain->poses.size(), parsed.poses.size()) << changed;
    for (std::size_t i = 0; i < parsed.poses.size(); ++i)
      ASSERT_EQ(plain->poses[i].position, parsed.poses[i].position) << changed;
  }
  EXPECT_GT(plain_ones, 100);
}

TEST(PlainWaypoints, ManyAreReadInLittleTime) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("a.yaml"), slow = folder.path("b.yaml");
  std::mt19937 random(5);
  writeWaypointFile(file, randomPath(random, 20000));
  write(slow, "# by the parser\n" + contentOf(file));
  const auto microseconds = [](const std::string& name) {
    const auto begin = std::chrono::steady_clock::now();
    const std::size_t poses = readWaypointFile(name).path.poses.size();
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
               .count() /
           static_cast<double>(poses);
  };
  const double plain = microseconds(file), parsed = microseconds(slow);
  std::printf("%.2f us a waypoint, with the parser %.1f\n", plain, parsed);
  EXPECT_LT(plain, 0.2 * parsed);
}

}  // namespace
}  // namespace grid_path_planner::path
