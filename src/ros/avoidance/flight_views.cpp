#include "ros/avoidance/flight_views.h"

#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace grid_path_planner::nodes {

using avoidance::HistogramView;
using avoidance::PilotOptions;
using avoidance::RememberedPoint;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

namespace {

constexpr int kPixelsOfBin = 8;
constexpr float kFarthest = 12.0F;  // m

sensor_msgs::PointCloud2 cloudOf(const std::vector<RememberedPoint>& remembered) {
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(remembered.size());
  if (remembered.empty()) return cloud;  // an iterator asks for the first byte
  sensor_msgs::PointCloud2Iterator<float> value(cloud, "x");
  for (const RememberedPoint& point : remembered) {
    for (int axis = 0; axis < 3; ++axis) value[axis] = static_cast<float>(point.position[axis]);
    ++value;
  }
  return cloud;
}

// The nearest of each column's rows within 30 degrees of level, from behind on anticlockwise.
sensor_msgs::LaserScan scanOf(const HistogramView& view, double yaw) {
  sensor_msgs::LaserScan scan;
  const double width = 2.0 * M_PI / view.columns;
  scan.angle_min = static_cast<float>(-M_PI - yaw);
  scan.angle_increment = static_cast<float>(width);
  scan.angle_max = static_cast<float>(scan.angle_min + width * (view.columns - 1));
  scan.range_max = kFarthest;
  const int middle = view.rows / 2, reach = view.rows / 6;
  for (int column = 0; column < view.columns; ++column) {
    float nearest = std::numeric_limits<float>::infinity();
    for (int row = middle - reach; row <= middle + reach; ++row)
      nearest = std::min(nearest, view.distances[row * view.columns + column]);
    scan.ranges.push_back(nearest);
  }
  return scan;
}

using Colour = std::array<std::uint8_t, 3>;

// Red: closed; the nearer the brighter; black: nothing.
Colour colourOf(float distance, double closed_within) {
  if (distance <= closed_within) return {220, 40, 30};
  if (!(distance < kFarthest)) return {0, 0, 0};
  const auto grey = static_cast<std::uint8_t>(230.0F - 190.0F * distance / kFarthest);
  return {grey, grey, grey};
}

// Ahead is in the middle, left is left and up is up.
sensor_msgs::Image pictureOf(const HistogramView& view, double yaw, double closed_within) {
  sensor_msgs::Image image;
  image.width = static_cast<std::uint32_t>(view.columns * kPixelsOfBin);
  image.height = static_cast<std::uint32_t>(view.rows * kPixelsOfBin);
  image.encoding = "rgb8";
  image.step = 3 * image.width;
  const int ahead = static_cast<int>(std::lround((yaw + M_PI) / (2.0 * M_PI) * view.columns));
  for (int row = view.rows - 1; row >= 0; --row) {
    std::vector<std::uint8_t> line;
    for (int column = 0; column < view.columns; ++column) {
      const int turned =
          ((ahead + view.columns / 2 - column) % view.columns + view.columns) % view.columns;
      const Colour colour = colourOf(view.distances[row * view.columns + turned], closed_within);
      for (int pixel = 0; pixel < kPixelsOfBin; ++pixel)
        line.insert(line.end(), colour.begin(), colour.end());
    }
    for (int i = 0; i < kPixelsOfBin; ++i)
      image.data.insert(image.data.end(), line.begin(), line.end());
  }
  return image;
}

geometry_msgs::Point pointOf(const Eigen::Vector3d& position) {
  geometry_msgs::Point point;
  point.x = position.x();
  point.y = position.y();
  point.z = position.z();
  return point;
}

Marker marker(int id, int type, double size, const Colour& colour, float opaque) {
  Marker marker;
  marker.ns = "local_planner";
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = size;
  marker.color.r = static_cast<float>(colour[0]) / 255.0F;
  marker.color.g = static_cast<float>(colour[1]) / 255.0F;
  marker.color.b = static_cast<float>(colour[2]) / 255.0F;
  marker.color.a = opaque;
  return marker;
}

// The part of a path that begins with it and is `length` long.
std::vector<geometry_msgs::Point> beginning(const std::vector<Eigen::Vector3d>& path,
                                            double length) {
  std::vector<geometry_msgs::Point> points;
  for (std::size_t i = 0; i < path.size() && length > 0.0; ++i) {
    points.push_back(pointOf(path[i]));
    if (i + 1 == path.size()) break;
    const Eigen::Vector3d edge = path[i + 1] - path[i];
    if (edge.norm() > length) points.push_back(pointOf(path[i] + edge * (length / edge.norm())));
    length -= edge.norm();
  }
  return points;
}

// Lines need two points.
void addLine(Marker line, const std::vector<geometry_msgs::Point>& points, MarkerArray& all) {
  line.points = points;
  line.scale.y = line.scale.z = 0.0;
  if (points.size() < 2) line.action = Marker::DELETE;
  all.markers.push_back(line);
}

// The path, the part of it that is open now, the ball that is kept free, and the sentence above it.
MarkerArray markersOf(const FlightViews::View& view) {
  MarkerArray all;
  const auto& path = view.pilot.path();
  addLine(marker(0, Marker::LINE_STRIP, 0.05, {250, 160, 30}, 1.0F), beginning(path, 1e9), all);
  addLine(marker(1, Marker::LINE_STRIP, 0.1, {40, 200, 60}, 1.0F),
          beginning(path, view.answer.clear_path), all);
  Marker ball = marker(2, Marker::SPHERE, 2.0 * view.pilot.options().d_safe, {60, 120, 250}, 0.25F);
  ball.pose.position = pointOf(view.at.position);
  all.markers.push_back(ball);
  Marker text = marker(3, Marker::TEXT_VIEW_FACING, 0.4, {255, 255, 255}, 1.0F);
  text.pose.position = pointOf(view.at.position + Eigen::Vector3d(0.0, 0.0, 1.2));
  text.text = std::string(toString(view.answer.status)) + ": " + view.answer.sentence;
  all.markers.push_back(text);
  for (Marker& each : all.markers) {
    each.header.frame_id = view.map_frame;
    each.header.stamp = view.stamp;
  }
  return all;
}

template <class Message>
void send(ros::Publisher& publisher, Message message, const std::string& frame,
          const ros::Time& stamp) {
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  publisher.publish(message);
}

}  // namespace

FlightViews::FlightViews(ros::NodeHandle& nh)
    : distances_(nh.advertise<sensor_msgs::LaserScan>("obstacle_distance", 1)),
      points_(nh.advertise<sensor_msgs::PointCloud2>("remembered_points", 1)),
      histogram_(nh.advertise<sensor_msgs::Image>("histogram_image", 1)),
      markers_(nh.advertise<MarkerArray>("avoidance_markers", 1)) {}

void FlightViews::show(const View& view) {
  const PilotOptions& options = view.pilot.options();
  const bool asked = distances_.getNumSubscribers() + histogram_.getNumSubscribers() > 0;
  const HistogramView histogram = asked ? view.pilot.histogram() : HistogramView();
  if (distances_.getNumSubscribers() > 0)
    send(distances_, scanOf(histogram, view.at.yaw), view.base_frame, view.stamp);
  if (histogram_.getNumSubscribers() > 0)
    send(histogram_, pictureOf(histogram, view.at.yaw, options.step + options.d_safe),
         view.base_frame, view.stamp);
  if (points_.getNumSubscribers() > 0)
    send(points_, cloudOf(view.pilot.rememberedPoints()), view.map_frame, view.stamp);
  if (markers_.getNumSubscribers() > 0) markers_.publish(markersOf(view));
}

}  // namespace grid_path_planner::nodes
