// The order in which via-points are visited at least cost: a travelling salesman's path with fixed ends.
//
//   LegCosts costs(via_points);                 // places: 0 the start, 1..n the via-points, n+1 the goal
//   costs.at(from, to) = costBetween(from, to);
//   VisitingOrder found = bestVisitingOrder(costs, stop);
//
// Guaranteed: up to kMostExact via-points no order costs less (dynamic programming over subsets, Held
// and Karp 1962), and `exact` says so; the same costs give the same order. Costs may differ between the
// two directions.
// Not guaranteed: that the order of more via-points is the best. It is that of insertion at least cost,
// improved by reversing and moving stretches, from several beginnings (iterated local search).
#pragma once

#include <cstddef>
#include <vector>

#include "grid_path_planner/base/stop_token.h"

namespace grid_path_planner::planning {

class LegCosts {
 public:
  explicit LegCosts(std::size_t via_points) : side_(via_points + 2), costs_(side_ * side_, 0.0) {}

  std::size_t viaPoints() const { return side_ - 2; }
  std::size_t start() const { return 0; }
  std::size_t via(std::size_t index) const { return index + 1; }
  std::size_t goal() const { return side_ - 1; }
  // Of the leg between two places; at least 0.
  double& at(std::size_t from, std::size_t to) { return costs_[from * side_ + to]; }
  double at(std::size_t from, std::size_t to) const { return costs_[from * side_ + to]; }
  // From the start by the via-points (indices from 0) in this order to the goal.
  double ofOrder(const std::vector<std::size_t>& order) const;

 private:
  std::size_t side_;
  std::vector<double> costs_;
};

struct VisitingOrder {
  std::vector<std::size_t> order;  // indices of via-points, from 0
  bool exact = true;               // no order costs less
};

constexpr std::size_t kMostExact = 12;  // via-points

// Throws Stopped. Time: 2^n n^2 up to kMostExact, about n^4 beyond.
VisitingOrder bestVisitingOrder(const LegCosts& costs, const base::StopToken& stop);

// What bestVisitingOrder() does beyond kMostExact.
std::vector<std::size_t> improvedVisitingOrder(const LegCosts& costs, const base::StopToken& stop);

}  // namespace grid_path_planner::planning
