// Plans again what was recorded, and says whether the path is the same to the bit.
//
//   PlanReplay replay(records, maps);        // all plans of a recording, in their order
//   const ReplayedPlan again = replay.again(2);
//   std::cout << again.text;                 // "identical: FOUND, 57 poses, by weighted_jump_point"
//
// A record says who answered, but not how much of its preparation was done: the answer of a planner may be
// another of several paths of the same cost then. So a plan is tried with all that the planner
// prepares, with nothing of it, by the planner that answered in place of the one that was asked, and
// last with all recorded plans before it, whose results incremental planners repair. The first whose
// path, cost and status are those of the record is the answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "ros/planning/record/plan_record.h"

namespace grid_path_planner::nodes {

using MapsByChecksum = std::map<std::uint64_t, std::shared_ptr<const grid::OccupancyGrid>>;

struct ReplayedPlan {
  bool identical = false;
  std::string text;  // in a sentence
  planning::Plan
      plan;  // the one that is identical, else the one planned first; NO_MAP where none was
};

class PlanReplay {
 public:
  // Both outlive this. `maps`: as far as there are any.
  PlanReplay(const std::vector<PlanRecord>& records, const MapsByChecksum& maps)
      : records_(records), maps_(maps) {}

  // Of records[index]. No record is an error: why it cannot be repeated is in the text.
  ReplayedPlan again(std::size_t index);

 private:
  // A planner that has answered the recorded plans up to one.
  struct History {
    std::unique_ptr<planning::PathPlanner> planner;
    std::size_t next = 0;
  };

  std::string reasonAgainst(const PlanRecord& record) const;
  ReplayedPlan plannedAgain(std::size_t index, const PlanQuestion& question);
  planning::Plan withHistory(std::size_t index);

  const std::vector<PlanRecord>& records_;
  const MapsByChecksum& maps_;
  History of_goals_, of_questions_;
};

}  // namespace grid_path_planner::nodes
