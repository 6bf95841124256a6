#include "ros/messages/cloud_reader.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "grid_path_planner/base/errors.h"
#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

using base::InputError;

namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

const PointField& fieldNamed(const PointCloud2& cloud, const std::string& name) {
  constexpr std::size_t kMostBytes = 256;
  std::string names;
  for (const PointField& field : cloud.fields) {
    if (field.name == name) return field;
    if (names.size() < kMostBytes) names += (names.empty() ? "" : ", ") + printable(field.name);
  }
  throw InputError("the cloud has no field " + name +
                   ", only: " + (names.empty() ? "none" : names));
}

bool isBigEndian() {
  const std::uint16_t one = 1;
  std::uint8_t first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

struct Coordinate {
  std::size_t offset;
  bool is_double;
  bool is_reversed;  // of another byte order than this computer's

  double read(const std::uint8_t* point) const {
    if (is_double) return load<double>(point + offset);
    return load<float>(point + offset);
  }
  std::size_t end() const { return offset + (is_double ? sizeof(double) : sizeof(float)); }

 private:
  template <class Number>
  Number load(const std::uint8_t* from) const {
    std::uint8_t bytes[sizeof(Number)];
    std::memcpy(bytes, from, sizeof bytes);
    if (is_reversed) std::reverse(bytes, bytes + sizeof bytes);
    Number number;
    std::memcpy(&number, bytes, sizeof bytes);
    return number;
  }
};

Coordinate coordinateOf(const PointCloud2& cloud, const std::string& name) {
  const PointField& field = fieldNamed(cloud, name);
  if (field.datatype != PointField::FLOAT32 && field.datatype != PointField::FLOAT64)
    throw InputError("the cloud's field " + name +
                     " must be FLOAT32 (7) or FLOAT64 (8), got type " +
                     std::to_string(field.datatype));
  const Coordinate coordinate{field.offset, field.datatype == PointField::FLOAT64,
                              (cloud.is_bigendian != 0) != isBigEndian()};
  if (coordinate.end() > cloud.point_step)
    throw InputError("the cloud's field " + name + " ends at byte " +
                     std::to_string(coordinate.end()) + " of points of " +
                     std::to_string(cloud.point_step) + " bytes");
  return coordinate;
}

void checkLayout(const PointCloud2& cloud) {
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

// Where the coordinates of a cloud's points are. Throws InputError where they are not.
class PointReader {
 public:
  explicit PointReader(const PointCloud2& cloud)
      : cloud_(cloud),
        x_(coordinateOf(cloud, "x")),
        y_(coordinateOf(cloud, "y")),
        z_(coordinateOf(cloud, "z")) {
    checkLayout(cloud);
  }

  std::size_t size() const { return rows() * cloud_.width; }

  template <class Action>
  void forEach(const Action& action) const {
    for (std::size_t row = 0; row < rows(); ++row) {
      const std::uint8_t* point = cloud_.data.data() + row * cloud_.row_step;
      for (std::size_t column = 0; column < cloud_.width; ++column, point += cloud_.point_step)
        action(Eigen::Vector3d(x_.read(point), y_.read(point), z_.read(point)));
    }
  }

 private:
  std::size_t rows() const {
    return cloud_.width == 0 ? 0 : cloud_.height;
  }  // no bytes stand for empty ones

  const PointCloud2& cloud_;
  Coordinate x_, y_, z_;
};

}  // namespace

std::vector<Eigen::Vector3d> finitePoints(const PointCloud2& cloud) {
  const PointReader reader(cloud);
  std::vector<Eigen::Vector3d> points;
  points.reserve(reader.size());
  reader.forEach([&](const Eigen::Vector3d& point) {
    if (point.allFinite() && !point.isZero(0.0)) points.push_back(point);
  });
  return points;
}

std::vector<float> allPoints(const PointCloud2& cloud) {
  const PointReader reader(cloud);
  std::vector<float> points;
  points.reserve(3 * reader.size());
  reader.forEach([&](const Eigen::Vector3d& point) {
    for (int axis = 0; axis < 3; ++axis) points.push_back(static_cast<float>(point[axis]));
  });
  return points;
}

}  // namespace grid_path_planner::nodes
