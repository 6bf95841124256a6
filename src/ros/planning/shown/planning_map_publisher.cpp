#include "ros/planning/shown/planning_map_publisher.h"

#include <cmath>
#include <utility>

#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner::nodes {

using costmap::CostChanges;
using costmap::CostGrid;
using grid::CellIndex;
using grid::CellRect;
using grid::Occupancy;
using grid::OccupancyGrid;

namespace {

// How weights are shown.
class WeightShades {
 public:
  explicit WeightShades(const CostGrid& costs)
      : costs_(costs), shades_(std::size_t(costs.maxWeight()) + 1, 0) {
    const int largest = costs.maxWeight();
    for (int weight = 2; weight <= largest; ++weight)
      shades_[weight] = static_cast<std::int8_t>(std::lround(99.0 * (weight - 1) / (largest - 1)));
    shades_[CostGrid::kBlocked] = 100;
  }

  std::int8_t of(CellIndex cell) const {
    const CostGrid::Weight weight = costs_.weights()[cell];
    const bool unknown = costs_.classes()[cell] == Occupancy::UNKNOWN;
    return unknown && weight != CostGrid::kBlocked ? -1 : shades_[weight];
  }

 private:
  const CostGrid& costs_;
  std::vector<std::int8_t> shades_;  // of each weight
};

}  // namespace

nav_msgs::OccupancyGrid planningMapMessage(const CostGrid& costs, const std::string& frame_id,
                                           const ros::Time& stamp) {
  const WeightShades shades(costs);
  OccupancyGrid shown(costs.geometry());
  for (std::uint32_t i = 0; i < shown.values().size(); ++i)
    shown[CellIndex(i)] = shades.of(CellIndex(i));
  return occupancyToMessage(std::move(shown), frame_id, stamp);
}

std::vector<map_msgs::OccupancyGridUpdate> planningMapUpdates(const CostGrid& costs,
                                                              const std::vector<CellRect>& cells,
                                                              const std::string& frame_id,
                                                              const ros::Time& stamp) {
  const WeightShades shades(costs);
  std::vector<map_msgs::OccupancyGridUpdate> updates;
  for (const CellRect& rect : cells) {
    updates.push_back(updateOf(rect, frame_id, stamp));
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      for (int column = rect.column; column < rect.column + rect.width; ++column)
        updates.back().data.push_back(shades.of(costs.geometry().index({column, row})));
  }
  return updates;
}

PlanningMapPublisher::PlanningMapPublisher(ros::NodeHandle nh, std::function<void()> on_subscriber)
    : topic_(std::move(nh), "planning_map", true, std::move(on_subscriber)) {}

std::optional<std::vector<CellRect>> PlanningMapPublisher::changed(
    const CostGrid& costs, const CostChanges& changes, const std::string& frame_id) const {
  if (!published_ || frame_id != published_->frame_id ||
      costs.maxWeight() != published_->max_weight)
    return std::nullopt;
  auto change = changes.since(published_->revision);
  if (!change) return std::nullopt;
  addChange(change->classes, change->weights);  // unknown cells are shown as such
  return std::move(change->weights);
}

void PlanningMapPublisher::publish(const CostGrid& costs, const CostChanges& changes,
                                   const std::string& frame_id, double full_map_period) {
  if (!topic_.hasSubscribers()) {
    published_.reset();
    topic_.forget();
    return;
  }
  const auto cells = changed(costs, changes, frame_id);
  const bool whole = topic_.takeNewSubscriber() || !cells || topic_.wholeMapIsDue(full_map_period);
  const ros::Time now = ros::Time::now();
  published_.reset();  // until it is sent
  if (whole || (!cells->empty() && topic_.needsWholeMaps()))
    topic_.send(planningMapMessage(costs, frame_id, now));
  else
    for (const auto& update : planningMapUpdates(costs, *cells, frame_id, now)) topic_.send(update);
  published_ = Published{costs.revision(), costs.maxWeight(), frame_id};
}

}  // namespace grid_path_planner::nodes
