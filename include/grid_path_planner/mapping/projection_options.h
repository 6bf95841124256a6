// Which part of the 3-D map becomes the 2-D map, and what its heights are measured from.
#pragma once

#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::mapping {

// What the heights of the band are measured from.
enum class ProjectionReference {
  FIXED,    // z = 0 of the map frame
  VEHICLE,  // the vehicle's z: its depth
  SEABED,   // the local seabed (seabed.h)
};
const std::vector<std::pair<const char*, ProjectionReference>>& choicesOf(ProjectionReference);

// The rectangle of the map frame that the 2-D map covers, m. All 0: it grows with the tree.
struct ProjectionBounds {
  double min_x = 0.0;
  double min_y = 0.0;
  double max_x = 0.0;
  double max_y = 0.0;

  bool given() const { return min_x != 0.0 || min_y != 0.0 || max_x != 0.0 || max_y != 0.0; }
};

struct ProjectionOptions {
  double min_z = -1e6;  // m, of the band, from the reference
  double max_z = 1e6;   // m
  ProjectionReference reference = ProjectionReference::FIXED;
  double seabed_radius = 1.0;     // m
  double seabed_max_slope = 0.5;  // metres up per metre along
  ProjectionBounds bounds;
  int max_cells = 25000000;
  double keep_around = 20.0;  // m
};

// All but the band, which has other names in each program.
template <class Visitor>
void visitOptions(ProjectionOptions& o, Visitor&& visit) {
  visit(
      "projection_reference", o.reference,
      base::OptionInfo{"What the heights of the band are measured from; fixed: z = 0; vehicle: its "
                       "depth (tf); seabed: the ground below",
                       ""});
  visit("seabed_radius", o.seabed_radius,
        base::OptionInfo{"How far around a cell the seabed is looked for", "m", 0.0, 100.0});
  visit("seabed_max_slope", o.seabed_max_slope,
        base::OptionInfo{"Steepest seabed that is no obstacle, metres up per metre along", "", 0.0,
                         100.0});
  visit("projection_bounds/min_x", o.bounds.min_x,
        base::OptionInfo{"Least x of the 2-D map; all four bounds 0: it grows with the tree", "m",
                         -1e5, 1e5});
  visit("projection_bounds/min_y", o.bounds.min_y,
        base::OptionInfo{"Least y of the 2-D map", "m", -1e5, 1e5});
  visit("projection_bounds/max_x", o.bounds.max_x,
        base::OptionInfo{"Largest x of the 2-D map", "m", -1e5, 1e5});
  visit("projection_bounds/max_y", o.bounds.max_y,
        base::OptionInfo{"Largest y of the 2-D map", "m", -1e5, 1e5});
  visit(
      "projection_max_cells", o.max_cells,
      base::OptionInfo{"Most cells of the 2-D map without bounds; of a tree that reaches farther, "
                       "as by a stray ray, it holds the densest part, and says what it leaves out",
                       "cells", 1024, 268435456});
  visit(
      "projection_keep_around", o.keep_around,
      base::OptionInfo{"What lies within this distance of the sensor is never left out of the 2-D "
                       "map, as far as projection_max_cells allows",
                       "m", 0.0, 10000.0});
}

// Throws InputError naming the option for a value outside its limits, a band or bounds that hold
// nothing.
void checkProjectionOptions(const ProjectionOptions& options);

}  // namespace grid_path_planner::mapping
