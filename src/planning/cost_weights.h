// How costs of a byte a cell, as costmap_2d makes them, become weights and classes.
//
//  cost             weight                                                            class
//  0                free_weight                                                       free
//  1 … 252          free_weight + (inflation_weight - free_weight) cost / 252,        free
//                   rounded
//  253  inscribed   blocked                                                           free
//  254  lethal      blocked                                                           occupied
//  255  no          unknown_weight, blocked without allow_unknown                     unknown
//       information
//
// costmap_2d's inflation layer makes 252 e^(-cost_scaling_factor (d - inscribed_radius)) of a distance d
// to an obstacle, and CostmapOptions makes inflation_weight of it likewise: so a costmap_2d
// costs what a map costs with radius inscribed_radius and decay cost_scaling_factor, up to its
// inflation_radius.
//
// Guaranteed: of two costs up to 252 the higher has no lower weight.
#pragma once

#include <array>
#include <cstdint>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::planning {

using Cost = std::uint8_t;
constexpr Cost kInscribedCost = 253;  // a vehicle whose centre is here touches an obstacle
constexpr Cost kLethalCost = 254;     // an obstacle
constexpr Cost kUnknownCost = 255;

struct CostWeightOptions {
  int free_weight = 1;
  int inflation_weight = 40;
  int unknown_weight = 50;
  bool allow_unknown = true;
};

template <class Visitor>
void visitOptions(CostWeightOptions& o, Visitor&& visit) {
  visit("allow_unknown", o.allow_unknown,
        base::OptionInfo{"Whether paths may cross cells of cost 255; false: never", ""}.under(
            "What cells cost"));
  visit("free_weight", o.free_weight,
        base::OptionInfo{"Cost of a cell length through cells of cost 0", "", 1, 65535});
  visit("inflation_weight", o.inflation_weight,
        base::OptionInfo{
            "The same at cost 252, beside the inscribed radius, and in proportion between; "
            "higher: wider berth; at least free_weight",
            "", 1, 65535});
  visit("unknown_weight", o.unknown_weight,
        base::OptionInfo{"The same at cost 255; higher: longer paths around unknown cells", "", 1,
                         65535});
}

// Throws InputError naming the option: for one outside its limits, and an inflation_weight below
// free_weight.
void checkCostWeightOptions(const CostWeightOptions& options);

class CostWeights {
 public:
  // Precondition: checkCostWeightOptions() accepts the options.
  explicit CostWeights(const CostWeightOptions& options);

  costmap::CostGrid::Weight weight(Cost cost) const { return weights_[cost]; }
  static grid::Occupancy classOf(Cost cost) {
    if (cost == kUnknownCost) return grid::Occupancy::UNKNOWN;
    return cost == kLethalCost ? grid::Occupancy::OCCUPIED : grid::Occupancy::FREE;
  }

 private:
  std::array<costmap::CostGrid::Weight, 256> weights_;
};

}  // namespace grid_path_planner::planning
