#include "ros/planning/rectangle_publisher.h"

#include <ros/console.h>

#include <utility>

#include "grid_path_planner/planners/decomposition.h"
#include "ros/guard/outgoing/latched_message.h"
#include "ros/planning/rectangle_markers.h"

namespace grid_path_planner::nodes {

using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::BitMaps;
using costmap::CostGrid;
using grid::CellRect;
using grid::GridGeometry;
using planners::DecompositionLimits;
using planners::DecompositionTooLarge;
using planners::largestFirst;

namespace {

constexpr char kSlot[] = "rectangles";

}  // namespace

RectanglePublisher::RectanglePublisher(ros::NodeHandle nh)
    : map_(nh.advertise<RectangleMap>("rectangle_map", 1, true)),
      markers_(nh.advertise<visualization_msgs::MarkerArray>("rectangle_markers", 1, true)) {}

void RectanglePublisher::clear() {
  shown_ = false;
  worker_.cancel(kSlot);
  worker_.post(
      [this](const StopSource&) {
        forgetLatched(map_);
        publishLatched(markers_, rectangleMarkers({}, {}, "map", ros::Time::now()));
      },
      kSlot);
}

void RectanglePublisher::publish(std::shared_ptr<const CostGrid> costs, const std::string& frame_id,
                                 std::size_t memory_limit) {
  shown_ = true;
  worker_.post(
      [this, costs = std::move(costs), frame_id, memory_limit](const StopSource& stop) mutable {
        try {
          cutAndTell(std::move(costs), frame_id, memory_limit, stop.token());
        } catch (const Stopped&) {
          // clear() or the destructor was called.
        } catch (const DecompositionTooLarge&) {
          ROS_ERROR(
              "To cut this map into rectangles takes more than memory_limit, %zu MB: "
              "they are not published",
              memory_limit / 1000000);
        }
      },
      kSlot);
}

void RectanglePublisher::cutAndTell(std::shared_ptr<const CostGrid> costs,
                                    const std::string& frame_id, std::size_t memory_limit,
                                    const StopToken& stop) {
  const GridGeometry geometry = costs->geometry();
  const BitMaps free = costs->bitMaps(stop);
  costs.reset();  // while it is held, its buffer cannot be reused (double_buffered.h)
  DecompositionLimits limits;
  limits.bytes = memory_limit;
  const std::vector<CellRect> rectangles = largestFirst(free, limits, stop);
  const ros::Time now = ros::Time::now();
  publishLatched(map_, rectanglesToMessage(geometry, rectangles, frame_id, now));
  publishLatched(markers_, rectangleMarkers(geometry, rectangles, frame_id, now));
}

}  // namespace grid_path_planner::nodes
