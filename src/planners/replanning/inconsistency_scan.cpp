#include "planners/replanning/inconsistency_scan.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace grid_path_planner::planners {

using costmap::CostGrid;
using grid::CellRect;

namespace {

using Two = double __attribute__((vector_size(16)));
using TwoSigns = std::int64_t __attribute__((vector_size(16)));

constexpr double kNoG = std::numeric_limits<double>::infinity();
constexpr double kNoCell = std::numeric_limits<double>::quiet_NaN();

static_assert(BackwardNodes::kLargest < SearchKey{1} << 51, "doubles hold g-values exactly");

Two from(const double* values) {
  Two two;
  std::memcpy(&two, values, sizeof two);
  return two;
}

TwoSigns inconsistent(const Two& g, const Two& weight, const Two& other, const Two& other_weight,
                      double length) {
  const Two difference = g - other;
  const Two step = (weight > other_weight ? weight : other_weight) * length;
  return (difference > step) | (-difference > step);
}

}  // namespace

InconsistencyScan::InconsistencyScan(const BackwardNodes& nodes, const CellRect& rect)
    : nodes_(nodes), rect_(rect) {
  const std::size_t cells = static_cast<std::size_t>(rect.width) + 2 * kTogether;
  for (Line& line : lines_) {
    line.g.assign(cells, kNoCell);
    line.weights.assign(cells, 0.0);
  }
}

void InconsistencyScan::fill(Line& line, int row) {
  const bool inside = row < rect_.row + rect_.height;
  if (!inside) return std::fill(line.g.begin(), line.g.end(), kNoCell);
  auto index =
      static_cast<BackwardNodes::Index>(nodes_.geometry().index({rect_.column, row}).value());
  for (int i = 0; i < rect_.width; ++i, ++index) {
    const CostGrid::Weight weight = nodes_.weight(index);
    line.weights[static_cast<std::size_t>(i)] = weight;
    double& g = line.g[static_cast<std::size_t>(i)];
    g = weight == CostGrid::kBlocked ? kNoCell : kNoG;
    if (weight == CostGrid::kBlocked || nodes_.state(index) == BackwardNodes::NEW) continue;
    g = static_cast<double>(static_cast<std::int64_t>(nodes_.g(index)));
  }
}

bool InconsistencyScan::suspect(std::size_t first) const {
  const double* g = lines_[0].g.data() + first;
  const double* weights = lines_[0].weights.data() + first;
  const double* north_g = lines_[1].g.data() + first;
  const double* north_weights = lines_[1].weights.data() + first;
  const Two here = from(g), here_weight = from(weights);
  const Two east = from(g + 1), east_weight = from(weights + 1);
  const Two north = from(north_g), north_weight = from(north_weights);
  const Two beyond = from(north_g + 1), beyond_weight = from(north_weights + 1);
  const auto straight = static_cast<double>(nodes_.stepLength(0));
  const auto diagonal = static_cast<double>(nodes_.stepLength(4));
  const TwoSigns any = inconsistent(here, here_weight, east, east_weight, straight) |
                       inconsistent(here, here_weight, north, north_weight, straight) |
                       inconsistent(here, here_weight, beyond, beyond_weight, diagonal) |
                       inconsistent(east, east_weight, north, north_weight, diagonal);
  return (any[0] | any[1]) != 0;
}

}  // namespace grid_path_planner::planners
