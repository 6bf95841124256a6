#include "grid_path_planner/mapping/octree_options.h"

#include <octomap/octomap_utils.h>

#include <cmath>
#include <string>

#include "base/available_memory.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/options.h"

namespace grid_path_planner::mapping {

using base::checkOptionLimits;
using base::decimalText;
using base::halfOfAvailableMemory;
using base::InputError;

namespace {

// OctoMap computes with log odds of single precision: a probability that is 0, 0.5 or 1 there
// cannot be used.
void require(bool holds, const char* name, const char* expected, double value) {
  if (!holds)
    throw InputError(std::string(name) + " must be " + expected + ", got " + decimalText(value));
}

bool isFinite(double probability) {
  return std::isfinite(octomap::logodds(probability));
}

}  // namespace

std::size_t memoryLimitOf(const OctreeOptions& options) {
  if (options.memory_limit == 0) return halfOfAvailableMemory();
  return static_cast<std::size_t>(options.memory_limit) * 1000000;
}

void checkOctreeOptions(const OctreeOptions& o) {
  checkOptionLimits(o);
  const auto logodds = octomap::logodds;
  require(o.max_range != 0.0, "sensor_model/max_range", "positive, or negative for no limit",
          o.max_range);
  require(isFinite(o.hit) && logodds(o.hit) > 0.0f, "sensor_model/hit", "above 0.5 and below 1",
          o.hit);
  require(isFinite(o.miss) && logodds(o.miss) < 0.0f, "sensor_model/miss", "above 0 and below 0.5",
          o.miss);
  require(isFinite(o.min) && logodds(o.min) < logodds(o.occupancy_threshold), "sensor_model/min",
          "above 0 and below occupancy_threshold", o.min);
  require(isFinite(o.max) && logodds(o.max) >= logodds(o.occupancy_threshold), "sensor_model/max",
          "below 1 and not below occupancy_threshold", o.max);
}

}  // namespace grid_path_planner::mapping
