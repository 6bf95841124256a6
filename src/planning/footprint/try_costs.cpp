#include "planning/footprint/try_costs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grid_path_planner::planning {

using costmap::CostGrid;
using Eigen::Vector2d;
using grid::Cell, grid::CellRect, grid::GridGeometry;
using path::Path;
using vehicle::FootprintContact;

namespace {

// The places of a path by its length, in metres.
class Lengths {
 public:
  explicit Lengths(const Path& path) : path_(path), until_(path.poses.size(), 0.0) {
    for (std::size_t i = 1; i < until_.size(); ++i)
      until_[i] = until_[i - 1] + (at(i) - at(i - 1)).norm();
  }

  double total() const { return until_.back(); }
  double of(const FootprintContact& contact) const {
    return until_[contact.pose] + (contact.position - at(contact.pose)).norm();
  }
  Vector2d placeAt(double length) const {
    const auto behind = std::upper_bound(until_.begin(), until_.end(), length);
    if (behind == until_.end()) return at(until_.size() - 1);
    const auto i = static_cast<std::size_t>(behind - until_.begin());
    const double share = (length - until_[i - 1]) / (until_[i] - until_[i - 1]);
    return at(i - 1) + share * (at(i) - at(i - 1));
  }

 private:
  Vector2d at(std::size_t i) const { return path_.poses[i].position.head<2>(); }

  const Path& path_;
  std::vector<double> until_;
};

}  // namespace

TryCosts::TryCosts(const CostGrid& costs, const Vector2d& start, const Vector2d* goal)
    : original_(costs), weights_(costs.weights()) {
  if (const auto cell = costs.geometry().cellAt(start)) ends_.push_back(*cell);
  if (!goal) return;
  if (const auto cell = costs.geometry().cellAt(*goal)) ends_.push_back(*cell);
}

void TryCosts::raise(const CostGrid& turning, int factor) {
  constexpr int kMost = std::numeric_limits<CostGrid::Weight>::max();
  for (int row = 0; row < weights_.height(); ++row) {
    CostGrid::Weight* weights = weights_.row(row);
    const CostGrid::Weight* free = turning.weights().row(row);
    for (int column = 0; column < weights_.width(); ++column)
      if (free[column] == CostGrid::kBlocked)
        weights[column] = static_cast<CostGrid::Weight>(std::min(kMost, factor * weights[column]));
  }
}

bool TryCosts::close(const Path& path, const std::vector<FootprintContact>& contacts,
                     double radius) {
  const Lengths lengths(path);
  const double aside =
      std::min(radius + 2.0 * original_.geometry().resolution(), 0.5 * lengths.total());
  bool closed = false;
  for (const FootprintContact& contact : contacts) {
    const double length = std::clamp(lengths.of(contact), aside, lengths.total() - aside);
    closed |= closeAround(lengths.placeAt(length), radius);
  }
  return closed;
}

bool TryCosts::closeAround(const Vector2d& centre, double radius) {
  const GridGeometry& geometry = original_.geometry();
  const Vector2d middle = geometry.gridFromWorld(centre);
  const double reach = radius / geometry.resolution();
  const Cell low{static_cast<int>(std::floor(middle.x() - reach)),
                 static_cast<int>(std::floor(middle.y() - reach))};
  const int side = static_cast<int>(std::ceil(2.0 * reach)) + 1;
  const CellRect rect = CellRect{low.column, low.row, side, side}.intersection(geometry.rect());
  bool closed = false;
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    for (int column = rect.column; column < rect.column + rect.width; ++column) {
      const Cell cell{column, row};
      const bool near = (Vector2d(column + 0.5, row + 0.5) - middle).norm() <= reach;
      if (!near || weights_[cell] == CostGrid::kBlocked) continue;
      if (std::find(ends_.begin(), ends_.end(), cell) != ends_.end()) continue;
      weights_[cell] = CostGrid::kBlocked;
      closed = true;
    }
  return closed;
}

std::shared_ptr<const CostGrid> TryCosts::costs() const {
  auto costs = std::make_shared<CostGrid>(weights_, original_.classes(), original_.motion());
  costs->setKeptDistances(original_.keptDistances());
  return costs;
}

}  // namespace grid_path_planner::planning
