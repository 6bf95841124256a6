#include "planners/astar/bound_choice.h"

#include <algorithm>

namespace grid_path_planner::planners {

using costmap::CostGrid;
using grid::CellRect, grid::GridGeometry;

namespace {

constexpr int kSampledRows = 24;
constexpr int kCellsBetweenSamples = 4;
// Blocked runs of fewer cells may hold no whole block of 4.
constexpr int kThinWall = 7;
// Where one wall in so many is thin the bound is still nearly that of the walls: on maps that were
// measured it is one in five or fewer where blocks pay, but for islands, and three in four where not.
constexpr std::size_t kWallsPerThinOne = 4;

// What a sample of rows tells.
struct Sample {
  double inverse_weights = 0.0;
  std::size_t passable = 0, walls = 0, thin_walls = 0;

  void addRow(const CostGrid& map, int row);
  void addWall(int cells) {
    ++walls;
    if (cells < kThinWall) ++thin_walls;
  }
};

void Sample::addRow(const CostGrid& map, int row) {
  const CostGrid::Weight* weights = map.weights().row(row);
  const int width = map.geometry().width();
  int wall_from = width;  // the first wall begins beside a passable cell
  for (int column = 0; column < width; ++column) {
    if (weights[column] == CostGrid::kBlocked) continue;
    if (column > wall_from) addWall(column - wall_from);
    wall_from = column + 1;
    if (column % kCellsBetweenSamples != 0) continue;
    ++passable;
    inverse_weights += 1.0 / weights[column];
  }
}

}  // namespace

void BoundChoice::prepare(const CostGrid& map) {
  *this = BoundChoice(prices_);
  if (map.uniform()) return;
  const std::int64_t height = map.geometry().height();
  const std::int64_t rows = std::min<std::int64_t>(kSampledRows, height);
  Sample sample;
  for (std::int64_t i = 0; i < rows; ++i)
    sample.addRow(map, static_cast<int>((2 * i + 1) * height / (2 * rows)));
  const double octile_says = map.minWeight() * sample.inverse_weights;
  const bool little = 2 * octile_says < static_cast<double>(sample.passable);
  blocks_ = decided_ = little && kWallsPerThinOne * sample.thin_walls <= sample.walls;
}

void BoundChoice::update(const CostGrid& map, const std::vector<CellRect>& changed) {
  for (const CellRect& rect : changed) noteChange(map.geometry(), rect);
  if (changed_blocks_ * kChangedBlock * kChangedBlock > map.geometry().size() / 8) prepare(map);
}

void BoundChoice::noteChange(const GridGeometry& geometry, const CellRect& rect) {
  const auto blocks = [](int cells) {
    return static_cast<std::size_t>((cells + kChangedBlock - 1) / kChangedBlock);
  };
  const std::size_t width = blocks(geometry.width());
  changed_.resize(width * blocks(geometry.height()));
  for (int row = rect.row / kChangedBlock; row * kChangedBlock < rect.row + rect.height; ++row) {
    for (int column = rect.column / kChangedBlock;
         column * kChangedBlock < rect.column + rect.width; ++column) {
      const std::size_t block =
          static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
      if (!changed_[block]) ++changed_blocks_;
      changed_[block] = true;
    }
  }
}

void BoundChoice::learn(const Evidence& evidence) {
  const double left = (1.0 - evidence.spared) * static_cast<double>(evidence.expanded);
  with_blocks_ += prices_.expansion * left + prices_.node * static_cast<double>(evidence.nodes);
  expanded_ += evidence.expanded;
  ++searches_;
  decided_ = expanded_ >= (searches_ < prices_.searches ? 4 : 1) * prices_.enough;
  blocks_ = decided_ && with_blocks_ < static_cast<double>(expanded_);
}

}  // namespace grid_path_planner::planners
