#include "ros/planning/shown/planning_map_publisher.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner::nodes {

using costmap::CostGrid;
using grid::CellIndex;
using grid::CellRect;
using grid::Occupancy;
using grid::OccupancyGrid;

namespace {

constexpr int kRowsApart = 8;  // between changes that are told apart

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

// Of two rows of cells: [first, end), empty where they are equal.
template <class T>
std::pair<int, int> differingColumns(const T* a, const T* b, int width) {
  if (std::memcmp(a, b, width * sizeof(T)) == 0) return {width, 0};
  int first = 0, end = width;
  while (a[first] == b[first]) ++first;
  while (a[end - 1] == b[end - 1]) --end;
  return {first, end};
}

CellRect differingInRow(const CostGrid& a, const CostGrid& b, int row) {
  const int width = a.geometry().width();
  const auto weights = differingColumns(a.weights().row(row), b.weights().row(row), width);
  const auto classes = differingColumns(a.classes().row(row), b.classes().row(row), width);
  const int first = std::min(weights.first, classes.first);
  return {first, row, std::max(weights.second, classes.second) - first, 1};
}

}  // namespace

nav_msgs::OccupancyGrid planningMapMessage(const CostGrid& costs, const std::string& frame_id,
                                           const ros::Time& stamp) {
  const WeightShades shades(costs);
  OccupancyGrid shown(costs.geometry());
  for (std::uint32_t i = 0; i < shown.values().size(); ++i)
    shown[CellIndex(i)] = shades.of(CellIndex(i));
  return occupancyToMessage(std::move(shown), frame_id, stamp);
}

map_msgs::OccupancyGridUpdate planningMapUpdate(const CostGrid& costs, const CellRect& cells,
                                                const std::string& frame_id,
                                                const ros::Time& stamp) {
  const WeightShades shades(costs);
  map_msgs::OccupancyGridUpdate update = updateOf(cells, frame_id, stamp);
  for (int row = cells.row; row < cells.row + cells.height; ++row)
    for (int column = cells.column; column < cells.column + cells.width; ++column)
      update.data.push_back(shades.of(costs.geometry().index({column, row})));
  return update;
}

std::vector<CellRect> differingCells(const CostGrid& a, const CostGrid& b) {
  std::vector<CellRect> differing;
  for (int row = 0; row < a.geometry().height(); ++row) {
    const CellRect cells = differingInRow(a, b, row);
    if (cells.empty()) continue;
    if (!differing.empty() && row < differing.back().row + differing.back().height + kRowsApart)
      differing.back() = differing.back().hull(cells);
    else
      differing.push_back(cells);
  }
  return differing;
}

PlanningMapPublisher::PlanningMapPublisher(ros::NodeHandle nh, std::function<void()> on_subscriber)
    : topic_(std::move(nh), "planning_map", true, std::move(on_subscriber)) {}

bool PlanningMapPublisher::wholeMapIsWanted(const CostGrid& costs, const std::string& frame_id,
                                            double full_map_period) {
  return topic_.takeNewSubscriber() || !published_ || frame_id != frame_id_ ||
         costs.geometry() != published_->geometry() ||
         costs.maxWeight() != published_->maxWeight() || topic_.wholeMapIsDue(full_map_period);
}

void PlanningMapPublisher::publish(const std::shared_ptr<const CostGrid>& costs,
                                   const std::string& frame_id, double full_map_period) {
  if (!costs) return;
  if (!topic_.hasSubscribers()) {
    published_.reset();
    topic_.forget();
    return;
  }
  const bool whole = wholeMapIsWanted(*costs, frame_id, full_map_period);
  if (!whole && costs == published_) return;
  if (whole || topic_.needsWholeMaps())
    topic_.send(planningMapMessage(*costs, frame_id, ros::Time::now()));
  else
    sendChanges(*costs);
  published_ = costs;
  frame_id_ = frame_id;
}

void PlanningMapPublisher::sendChanges(const CostGrid& costs) {
  const ros::Time now = ros::Time::now();
  for (const CellRect& cells : differingCells(*published_, costs))
    topic_.send(planningMapUpdate(costs, cells, frame_id_, now));
}

}  // namespace grid_path_planner::nodes
