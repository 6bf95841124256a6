#include "ros/common/incoming/cloud_reader.h"

#include <cstdint>
#include <cstring>
#include <string>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::nodes {

using base::InputError;

namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

const PointField& fieldNamed(const PointCloud2& cloud, const std::string& name) {
  std::string names;
  for (const PointField& field : cloud.fields) {
    if (field.name == name) return field;
    names += (names.empty() ? "" : ", ") + field.name;
  }
  throw InputError("the cloud has no field " + name +
                   ", only: " + (names.empty() ? "none" : names));
}

struct Coordinate {
  std::size_t offset;
  bool is_double;

  double read(const std::uint8_t* point) const {
    if (is_double) return load<double>(point + offset);
    return load<float>(point + offset);
  }
  std::size_t end() const { return offset + (is_double ? sizeof(double) : sizeof(float)); }

 private:
  template <class Number>
  static Number load(const std::uint8_t* from) {
    Number number;
    std::memcpy(&number, from, sizeof(number));
    return number;
  }
};

Coordinate coordinateOf(const PointCloud2& cloud, const std::string& name) {
  const PointField& field = fieldNamed(cloud, name);
  if (field.datatype != PointField::FLOAT32 && field.datatype != PointField::FLOAT64)
    throw InputError("the cloud's field " + name +
                     " must be FLOAT32 (7) or FLOAT64 (8), got type " +
                     std::to_string(field.datatype));
  const Coordinate coordinate{field.offset, field.datatype == PointField::FLOAT64};
  if (coordinate.end() > cloud.point_step)
    throw InputError("the cloud's field " + name + " ends at byte " +
                     std::to_string(coordinate.end()) + " of points of " +
                     std::to_string(cloud.point_step) + " bytes");
  return coordinate;
}

void checkLayout(const PointCloud2& cloud) {
  if (cloud.is_bigendian) throw InputError("the cloud is big-endian, which is not read");
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  if (cloud.height > 1 && row > cloud.row_step)
    throw InputError("the cloud's rows of " + std::to_string(cloud.row_step) +
                     " bytes are too short for " + std::to_string(cloud.width) + " points of " +
                     std::to_string(cloud.point_step) + " bytes");
  const std::uint64_t needed =
      cloud.height == 0 ? 0 : std::uint64_t{cloud.height - 1} * cloud.row_step + row;
  if (cloud.data.size() < needed)
    throw InputError("the cloud of " + std::to_string(cloud.width) + "x" +
                     std::to_string(cloud.height) + " points needs " + std::to_string(needed) +
                     " bytes, got " + std::to_string(cloud.data.size()));
}

template <class Action>
void forPoints(const PointCloud2& cloud, const Action& action) {
  checkLayout(cloud);
  const Coordinate x = coordinateOf(cloud, "x");
  const Coordinate y = coordinateOf(cloud, "y");
  const Coordinate z = coordinateOf(cloud, "z");
  const std::size_t rows = cloud.width == 0 ? 0 : cloud.height;  // no bytes stand for empty ones
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint8_t* point = cloud.data.data() + row * cloud.row_step;
    for (std::size_t column = 0; column < cloud.width; ++column, point += cloud.point_step)
      action(Eigen::Vector3d(x.read(point), y.read(point), z.read(point)));
  }
}

std::size_t mostPoints(const PointCloud2& cloud) {
  return cloud.point_step == 0 ? 0 : cloud.data.size() / cloud.point_step;
}

}  // namespace

std::vector<Eigen::Vector3d> finitePoints(const PointCloud2& cloud) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(mostPoints(cloud));
  forPoints(cloud, [&](const Eigen::Vector3d& point) {
    if (point.allFinite()) points.push_back(point);
  });
  return points;
}

std::vector<float> allPoints(const PointCloud2& cloud) {
  std::vector<float> points;
  points.reserve(3 * mostPoints(cloud));
  forPoints(cloud, [&](const Eigen::Vector3d& point) {
    for (int axis = 0; axis < 3; ++axis) points.push_back(static_cast<float>(point[axis]));
  });
  return points;
}

}  // namespace grid_path_planner::nodes
