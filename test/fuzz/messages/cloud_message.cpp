// A cloud and the transform of its sensor, as projected_map puts them into its map.
#include <geometry_msgs/Transform.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstring>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/mapping/map_model.h"
#include "ros/messages/cloud_reader.h"

namespace grid_path_planner::fuzz {
namespace {

// So many points are enough; a cloud of n bytes takes O(n), and far points take long rays.
constexpr std::size_t kMostPoints = 20;

std::string cloudOf(const std::vector<float>& coordinates) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = "camera";
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(coordinates.size() / 3);
  cloud.point_step = 3 * sizeof(float);
  cloud.row_step = cloud.width * cloud.point_step;
  for (const char* name : {"x", "y", "z"}) {
    cloud.fields.emplace_back();
    cloud.fields.back().name = name;
    cloud.fields.back().offset =
        static_cast<std::uint32_t>(sizeof(float) * (cloud.fields.size() - 1));
    cloud.fields.back().datatype = sensor_msgs::PointField::FLOAT32;
    cloud.fields.back().count = 1;
  }
  cloud.data.resize(coordinates.size() * sizeof(float));
  if (!coordinates.empty()) std::memcpy(cloud.data.data(), coordinates.data(), cloud.data.size());
  return bytesOf(cloud);
}

std::vector<std::string> seedsOfClouds() {
  geometry_msgs::Transform transform;
  transform.translation.x = 0.5;
  transform.rotation.w = 1.0;
  return {bytesOf(transform) + cloudOf({1.0f, 0.1f, 0.2f, 2.0f, -0.3f, 0.4f}),
          bytesOf(transform) + cloudOf({})};
}

// As projected_map makes it of what tf knows.
Eigen::Isometry3d isometryOf(const geometry_msgs::Transform& t) {
  const Eigen::Quaterniond rotation(t.rotation.w, t.rotation.x, t.rotation.y, t.rotation.z);
  return Eigen::Translation3d(t.translation.x, t.translation.y, t.translation.z) *
         rotation.normalized();
}

FUZZ_TARGET(cloud_message, seedsOfClouds) {
  const std::size_t at = bytesOf(geometry_msgs::Transform()).size();
  if (input.size() < at) return;
  const auto transform = messageOf<geometry_msgs::Transform>(input.substr(0, at));
  const auto cloud = messageOf<sensor_msgs::PointCloud2>(input.substr(at));
  if (!transform || !cloud) return;
  mayRefuse([&] {
    std::vector<Eigen::Vector3d> points = nodes::finitePoints(*cloud);
    points.resize(std::min(points.size(), kMostPoints));
    mapping::CloudFrames frames;
    frames.map_from_sensor = isometryOf(*transform);
    mapping::MapModel model{mapping::ProjectedMapOptions()};
    model.insert(points, frames);
    grid::checkOccupancyValues(model.grid());
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
