// The sensor model of an octree: octomap_server's parameters, by their names and with their
// defaults; and what it may take.
#pragma once

#include <cstddef>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::mapping {

struct OctreeOptions {
  double resolution = 0.05;          // m
  double max_range = -1.0;           // m, negative: none
  double hit = 0.7;                  // probabilities
  double miss = 0.4;                 //
  double min = 0.12;                 //
  double max = 0.97;                 //
  double occupancy_threshold = 0.5;  //
  double decay_time = 0.0;           // s, 0: never
  int memory_limit = 0;              // MB, 0: half of what is available
};

template <class Visitor>
void visitOptions(OctreeOptions& o, Visitor&& visit) {
  visit("resolution", o.resolution,
        base::OptionInfo{
            "Edge of a voxel and of a cell; an octree file has its own; read at the start", "m",
            0.001, 100.0}
            .under("The 3-D map"));
  visit("sensor_model/max_range", o.max_range,
        base::OptionInfo{
            "Points farther away only clear the ray up to this range; negative: no limit", "m",
            -1e6, 1e6});
  visit("sensor_model/hit", o.hit,
        base::OptionInfo{"Probability that a voxel seen occupied is; above 0.5", "", 0.0, 1.0});
  visit(
      "sensor_model/miss", o.miss,
      base::OptionInfo{"Probability that a voxel seen free is occupied; below 0.5", "", 0.0, 1.0});
  visit("sensor_model/min", o.min,
        base::OptionInfo{"A voxel seen free often stays at this probability", "", 0.0, 1.0});
  visit("sensor_model/max", o.max,
        base::OptionInfo{
            "A voxel seen occupied often stays at this probability; lower: it is freed sooner", "",
            0.0, 1.0});
  visit("occupancy_threshold", o.occupancy_threshold,
        base::OptionInfo{"A voxel is occupied from this probability on", "", 0.0, 1.0});
  visit("decay_time", o.decay_time,
        base::OptionInfo{
            "A voxel surely occupied is unknown again when it has not been seen for this long; a "
            "leap of the clock counts as 10 s, or as two periods of publish_rate; 0: never",
            "s", 0.0, 1e9});
  visit("memory_limit", o.memory_limit,
        base::OptionInfo{
            "What the 3-D map may take: voxels that were unknown stay so where a cloud would need "
            "more, which diagnostics and the log say, and what is known is kept up to date; 0: "
            "half of what is available at the start, of the machine, the control group and "
            "ulimit -v",
            "MB", 0, 1000000});
}

// memory_limit in bytes, of 0 too.
std::size_t memoryLimitOf(const OctreeOptions& options);

// Throws InputError naming the option for a value outside its limits, a max_range of 0, a hit that
// does not raise the probability or a miss that does not lower it, and for min, occupancy_threshold
// and max that are not in this order inside (0, 1).
void checkOctreeOptions(const OctreeOptions& options);

}  // namespace grid_path_planner::mapping
