#include "ros/planning/shown/planning_map_publisher.h"

#include <cmath>
#include <utility>

#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner::nodes {

using costmap::CostChanges;
using costmap::CostGrid;
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

  // Of `count` cells of a row, from `column` on. Map after map of millions is shown: no index is
  // checked, cell by cell.
  void write(int row, int column, int count, std::int8_t* shown) const {
    const CostGrid::Weight* const weights = costs_.weights().row(row) + column;
    const Occupancy* const classes = costs_.classes().row(row) + column;
    for (int i = 0; i < count; ++i)
      shown[i] = classes[i] == Occupancy::UNKNOWN && weights[i] != CostGrid::kBlocked
                     ? -1
                     : shades_[weights[i]];
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
  for (int row = 0; row < shown.height(); ++row)
    shades.write(row, 0, shown.width(), shown.row(row));
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
    std::vector<std::int8_t>& shown = updates.back().data;
    shown.resize(static_cast<std::size_t>(rect.width) * rect.height);
    for (int row = 0; row < rect.height; ++row)
      shades.write(rect.row + row, rect.column, rect.width,
                   shown.data() + static_cast<std::size_t>(row) * rect.width);
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
                                   const std::string& frame_id, const ros::Time& newest,
                                   double full_map_period) {
  if (!topic_.hasSubscribers()) {
    published_.reset();
    topic_.forget();
    return;
  }
  const auto cells = changed(costs, changes, frame_id);
  const bool whole = topic_.takeNewSubscriber() || !cells || topic_.wholeMapIsDue(full_map_period);
  published_.reset();  // until it is sent
  if (whole || !cells->empty()) {
    const ros::Time stamp = topic_.stampFor(newest, ros::Time::now());
    if (whole || topic_.needsWholeMaps())
      topic_.send(planningMapMessage(costs, frame_id, stamp));
    else
      for (const auto& update : planningMapUpdates(costs, updateRects(*cells), frame_id, stamp))
        topic_.send(update);
  }
  published_ = Published{costs.revision(), costs.maxWeight(), frame_id};
}

}  // namespace grid_path_planner::nodes
