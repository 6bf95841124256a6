// One suite over every planner of the factory, with every heuristic and tie-break: what the Planner
// contract promises. conformance_test.cpp instantiates it; a subject is the planner and its options.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "grid_path_planner/planners/planner_factory.h"
#include "planners/astar/heuristic.h"

namespace grid_path_planner::test {

struct Subject {
  std::string planner;
  planners::SearchOptions options;
};

inline std::ostream& operator<<(std::ostream& out, const Subject& subject) {
  return out << subject.planner << ' ' << base::choiceName(subject.options.heuristic) << " scale "
             << subject.options.heuristic_scale << " epsilon " << subject.options.epsilon << ' '
             << base::choiceName(subject.options.tie_break);
}

// Larger ones would need tables for every pair of their cells.
inline int sideFor(const Subject& subject, int side) {
  return subject.options.heuristic == planners::Heuristic::EXACT ? side / 4 : side;
}

inline std::vector<Subject> subjects() {
  std::vector<Subject> all;
  for (const std::string& planner : planners::plannerNames()) {
    all.push_back({planner, {}});
    if (planner == "dijkstra") {
      planners::SearchOptions ordered;
      ordered.tie_break = planners::TieBreak::LARGER_G;
      all.push_back({planner, ordered});
    }
    if (planner != "a_star" && planner != "weighted_jump_point") continue;
    for (const auto& heuristic : choicesOf(planners::Heuristic{}))
      for (const auto& tie_break : choicesOf(planners::TieBreak{})) {
        planners::SearchOptions options;
        if (planners::prepared(heuristic.second) && tie_break.second != options.tie_break) continue;
        options.heuristic = heuristic.second;
        options.tie_break = tie_break.second;
        all.push_back({planner, options});
      }
    planners::SearchOptions scaled;
    scaled.heuristic_scale = "1";
    all.push_back({planner, scaled});
    scaled.heuristic_scale = "30";
    all.push_back({planner, scaled});
    planners::SearchOptions weighted;
    weighted.epsilon = 2.5;
    all.push_back({planner, weighted});
  }
  return all;
}

class Conformance : public ::testing::TestWithParam<Subject> {
 protected:
  std::unique_ptr<planners::Planner> make() const {
    return planners::makePlanner(GetParam().planner, GetParam().options);
  }
};

}  // namespace grid_path_planner::test
