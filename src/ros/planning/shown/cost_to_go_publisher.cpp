#include "ros/planning/shown/cost_to_go_publisher.h"

#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner::nodes {

using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::CostGrid;
using grid::Cell;
using grid::CellIndex;
using grid::GridGeometry;
using grid::OccupancyGrid;
using planners::CostToGo;
using planners::TooExpensive;

namespace {

constexpr char kFieldSlot[] = "cost to go";

bool isBigEndian() {
  const std::uint16_t one = 1;
  std::uint8_t first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

}  // namespace

std::vector<float> costsToGo(const CostToGo& field) {
  const GridGeometry& geometry = field.map().geometry();
  // A cost is in cell lengths of the full map.
  const double cell = geometry.resolution() / field.map().kernel();
  std::vector<float> costs(geometry.size(), std::numeric_limits<float>::infinity());
  for (std::uint32_t i = 0; i < costs.size(); ++i) {
    const Cell at = geometry.cell(CellIndex(i));
    if (field.reached(at)) costs[i] = static_cast<float>(field.cost(at).toDouble() * cell);
  }
  return costs;
}

nav_msgs::OccupancyGrid costToGoMap(const GridGeometry& geometry, const std::vector<float>& costs,
                                    const std::string& frame_id, const ros::Time& stamp) {
  float largest = 0.0F;
  for (const float cost : costs)
    if (std::isfinite(cost)) largest = std::max(largest, cost);
  const float scale = largest > 0.0F ? 100.0F / largest : 0.0F;
  OccupancyGrid shown(geometry);
  for (std::uint32_t i = 0; i < costs.size(); ++i)
    shown[CellIndex(i)] = static_cast<std::int8_t>(
        std::isfinite(costs[i]) ? std::lround(costs[i] * scale) : long{-1});
  return occupancyToMessage(std::move(shown), frame_id, stamp);
}

sensor_msgs::Image costToGoImage(const GridGeometry& geometry, const std::vector<float>& costs,
                                 const std::string& frame_id, const ros::Time& stamp) {
  sensor_msgs::Image image;
  image.header.frame_id = frame_id;
  image.header.stamp = stamp;
  image.width = static_cast<std::uint32_t>(geometry.width());
  image.height = static_cast<std::uint32_t>(geometry.height());
  image.encoding = "32FC1";
  image.is_bigendian = isBigEndian() ? 1 : 0;
  image.step = image.width * static_cast<std::uint32_t>(sizeof(float));
  image.data.resize(costs.size() * sizeof(float));
  std::memcpy(image.data.data(), costs.data(), image.data.size());
  return image;
}

CostToGoPublisher::CostToGoPublisher(ros::NodeHandle private_nh,
                                     std::function<void()> on_subscriber) {
  const ros::SubscriberStatusCallback told =
      [on_subscriber = std::move(on_subscriber)](const ros::SingleSubscriberPublisher&) {
        on_subscriber();
      };
  map_ = private_nh.advertise<nav_msgs::OccupancyGrid>("cost_to_go", 1, told);
  image_ = private_nh.advertise<sensor_msgs::Image>("cost_to_go_image", 1, told);
}

void CostToGoPublisher::publish(std::shared_ptr<const CostGrid> costs, const Eigen::Vector2d& goal,
                                const std::string& frame_id, std::size_t memory_limit) {
  const GridGeometry& geometry = costs->geometry();
  const auto cell = geometry.cellAt(goal);
  if (!cell) return;
  const std::size_t bytes = CostToGo::bytesFor(geometry) + geometry.size() * 2 * sizeof(float);
  if (bytes > memory_limit) {
    ROS_ERROR(
        "The cost to go on this map takes %zu MB, more than memory_limit, %zu MB: it is not "
        "published",
        bytes / 1000000, memory_limit / 1000000);
    return;
  }
  worker_.post(
      [this, costs = std::move(costs), goal = *cell, frame_id](const StopSource& stop) mutable {
        try {
          computeAndTell(std::move(costs), goal, frame_id, stop.token());
        } catch (const Stopped&) {
          // The destructor was called.
        } catch (const TooExpensive&) {
          ROS_ERROR("The cost to go is not published: a path costs more than 2.9e9 cells x weight");
        }
      },
      kFieldSlot);
}

void CostToGoPublisher::computeAndTell(std::shared_ptr<const CostGrid> costs, Cell goal,
                                       const std::string& frame_id, const StopToken& stop) {
  const GridGeometry geometry = costs->geometry();
  std::vector<float> values = costsToGo(CostToGo(std::move(costs), {goal}, 1, stop));
  const ros::Time now = ros::Time::now();
  if (map_.getNumSubscribers() > 0) map_.publish(costToGoMap(geometry, values, frame_id, now));
  if (image_.getNumSubscribers() > 0)
    image_.publish(costToGoImage(geometry, values, frame_id, now));
}

}  // namespace grid_path_planner::nodes
