// A bag that `rosbag record` made of the topics that `record:=` of the launch files names.
//
//   const Recording recording = readRecording("plans.bag");
//   PlanReplay replay(recording.plans, recording.maps);
//
// Only maps on which a plan was searched are kept.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/base/read_limits.h"
#include "ros/planning/record/plan_replay.h"

namespace grid_path_planner::nodes {

// Memory as for every file, and ten minutes.
base::ReadLimits longReading();

struct Recording {
  std::vector<PlanRecord> plans;  // in the order of the file; at least one
  MapsByChecksum maps;
  std::vector<std::string> refusals;  // a sentence for topics with messages that were refused
};

// Throws InputError naming the file where it is no such bag or damaged, has no plans, names a type of
// another version, or needs more than `limits`.
Recording readRecording(const std::string& file, const base::ReadLimits& limits = longReading());

}  // namespace grid_path_planner::nodes
