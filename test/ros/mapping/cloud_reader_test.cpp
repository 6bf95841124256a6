#include "ros/messages/cloud_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <limits>

#include "support/error_text.h"

namespace grid_path_planner::nodes {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

PointField field(const std::string& name, std::uint32_t offset, std::uint8_t type) {
  PointField field;
  field.name = name;
  field.offset = offset;
  field.datatype = type;
  field.count = 1;
  return field;
}

template <class Number>
void put(PointCloud2& cloud, std::size_t at, Number number) {
  if (cloud.data.size() < at + sizeof(number)) cloud.data.resize(at + sizeof(number));
  std::memcpy(cloud.data.data() + at, &number, sizeof(number));
}

// `points` points (i, -i, 0.5 i) with x as FLOAT32 at byte 13, y as FLOAT64 at byte 1 and z as
// FLOAT32 at byte 20 of 30: nothing is aligned.
PointCloud2 oddCloud(std::uint32_t points) {
  PointCloud2 cloud;
  cloud.height = 1;
  cloud.width = points;
  cloud.point_step = 30;
  cloud.row_step = 30 * points;
  cloud.fields = {field("intensity", 0, PointField::UINT8), field("z", 20, PointField::FLOAT32),
                  field("y", 1, PointField::FLOAT64), field("x", 13, PointField::FLOAT32)};
  cloud.data.resize(cloud.row_step);
  for (std::uint32_t i = 0; i < points; ++i) {
    put(cloud, 30 * i + 13, static_cast<float>(i));
    put(cloud, 30 * i + 1, -static_cast<double>(i));
    put(cloud, 30 * i + 20, 0.5F * static_cast<float>(i));
  }
  return cloud;
}

std::string refusal(const PointCloud2& cloud) {
  return test::errorText([&] { finitePoints(cloud); });
}

TEST(CloudReader, FieldsStandAtAnyOffsetAsFloatOrDouble) {
  const auto points = finitePoints(oddCloud(3));
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[1], Eigen::Vector3d(2.0, -2.0, 1.0));
}

TEST(CloudReader, DoublesKeepTheirDigits) {
  PointCloud2 cloud = oddCloud(1);
  put(cloud, 1, 5412345.0625);
  EXPECT_EQ(finitePoints(cloud).at(0).y(), 5412345.0625);
}

TEST(CloudReader, PointsThatAreNotFiniteAreLeftOut) {
  PointCloud2 cloud = oddCloud(4);
  put(cloud, 13, NAN);
  put(cloud, 30 + 1, std::numeric_limits<double>::infinity());
  put(cloud, 60 + 20, -INFINITY);
  const auto points = finitePoints(cloud);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].x(), 3.0);
}

TEST(CloudReader, OrganisedCloudsWithPaddedRows) {
  PointCloud2 cloud = oddCloud(2);
  cloud.height = 2;
  cloud.width = 1;
  cloud.row_step = 37;
  cloud.data.insert(cloud.data.begin() + 30, 7, 0xff);
  EXPECT_EQ(finitePoints(cloud).at(0).x(), 1.0);
  cloud.data.resize(cloud.data.size() - 1);
  EXPECT_EQ(refusal(cloud), "the cloud of 1x2 points needs 67 bytes, got 66");
}

// Recordings of computers of the other byte order were refused.
TEST(CloudReader, CloudsOfTheOtherByteOrderAreRead) {
  PointCloud2 cloud = oddCloud(3);
  for (std::size_t i = 0; i < 3; ++i)
    for (const auto& [at, bytes] : {std::pair(13, 4), std::pair(1, 8), std::pair(20, 4)}) {
      const auto first = cloud.data.begin() + static_cast<std::ptrdiff_t>(30 * i) + at;
      std::reverse(first, first + bytes);
    }
  cloud.is_bigendian = true;
  EXPECT_EQ(finitePoints(cloud), finitePoints(oddCloud(3)));
  EXPECT_EQ(allPoints(cloud), allPoints(oddCloud(3)));
}

// Livox and others have 0 0 0 for a ray without return: the sensor was an obstacle to itself.
TEST(CloudReader, TheSensorItselfIsNoPoint) {
  EXPECT_EQ(finitePoints(oddCloud(3)).size(), 2u);
  EXPECT_EQ(allPoints(oddCloud(3)).size(), 9u) << "all pixels";
}

TEST(CloudReader, EmptyClouds) {
  EXPECT_TRUE(finitePoints(oddCloud(0)).empty());
  PointCloud2 cloud = oddCloud(0);
  cloud.height = 0;
  EXPECT_TRUE(finitePoints(cloud).empty());
}

// 4,294,967,295 rows without a byte stood the mapping still for 18 s: a message of n bytes costs O(n).
TEST(CloudReader, RowsWithoutPointsTakeNoTime) {
  PointCloud2 cloud = oddCloud(0);
  cloud.height = std::numeric_limits<std::uint32_t>::max();
  const std::clock_t begin = std::clock();
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(finitePoints(cloud).empty());
  EXPECT_LT(std::clock() - begin, CLOCKS_PER_SEC) << "of the processor";
}

// 64 MB of other bytes, in points of one byte each, took 1.5 GB before the cloud was refused.
TEST(CloudReader, RoomIsTakenForPointsThatAreThere) {
  PointCloud2 cloud = oddCloud(3);
  cloud.data.resize(1 << 20);
  EXPECT_EQ(finitePoints(cloud).capacity(), 3u);
  EXPECT_EQ(allPoints(cloud).capacity(), 9u);
}

TEST(CloudReader, WhatCannotBeReadIsRefusedWithASentence) {
  PointCloud2 cloud = oddCloud(2);
  cloud.fields[1].name = "depth";
  EXPECT_EQ(refusal(cloud), "the cloud has no field z, only: intensity, depth, y, x");
  cloud = oddCloud(2);
  cloud.fields[3].datatype = PointField::INT16;
  EXPECT_EQ(refusal(cloud), "the cloud's field x must be FLOAT32 (7) or FLOAT64 (8), got type 3");
  cloud = oddCloud(2);
  cloud.fields[2].offset = 23;
  EXPECT_EQ(refusal(cloud), "the cloud's field y ends at byte 31 of points of 30 bytes");
  cloud = oddCloud(2);
  cloud.fields[2].offset = std::numeric_limits<std::uint32_t>::max();
  EXPECT_NE(refusal(cloud), "");
  cloud = oddCloud(2);
  cloud.height = 3;
  cloud.row_step = 10;
  EXPECT_EQ(refusal(cloud), "the cloud's rows of 10 bytes are too short for 2 points of 30 bytes");
  cloud = oddCloud(2);
  cloud.width = cloud.height = std::numeric_limits<std::uint32_t>::max();
  EXPECT_NE(refusal(cloud), "");
  cloud = oddCloud(2);
  cloud.point_step = 0;
  EXPECT_NE(refusal(cloud), "");
}

}  // namespace
}  // namespace grid_path_planner::nodes
