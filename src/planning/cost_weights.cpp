#include "planning/cost_weights.h"

namespace grid_path_planner::planning {

using base::checkOptionLimits, base::InputError;
using costmap::CostGrid;

void checkCostWeightOptions(const CostWeightOptions& options) {
  checkOptionLimits(options);
  if (options.inflation_weight < options.free_weight)
    throw InputError("inflation_weight must be at least free_weight, got " +
                     std::to_string(options.inflation_weight) + " and " +
                     std::to_string(options.free_weight));
}

CostWeights::CostWeights(const CostWeightOptions& options) {
  constexpr int kMostCost = kInscribedCost - 1;
  const int rise = options.inflation_weight - options.free_weight;
  for (int cost = 0; cost <= kMostCost; ++cost)
    weights_[cost] = static_cast<CostGrid::Weight>(options.free_weight +
                                                   (rise * cost + kMostCost / 2) / kMostCost);
  weights_[kInscribedCost] = weights_[kLethalCost] = CostGrid::kBlocked;
  weights_[kUnknownCost] = options.allow_unknown
                               ? static_cast<CostGrid::Weight>(options.unknown_weight)
                               : CostGrid::kBlocked;
}

}  // namespace grid_path_planner::planning
