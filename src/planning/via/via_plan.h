// A plan through via-points, in their order or in the one of least cost.
//
//   ViaRequest request;
//   request.start = start, request.goal = goal;
//   request.via = {{1.0, 2.0, 0.0}, {3.0, 4.0, 0.0}};
//   request.order = ViaOrder::BEST;
//   ViaPlan found = planThrough(planner, request);   // found.plan.path, found.order
//
// Every leg is a plan of its own, which begins where the one before ends, and the answer is the legs
// in a row: it keeps what PathPlanner promises of each. The headings are those of one path.
// Guaranteed: with ViaOrder::BEST and up to kMostExact via-points the legs of no other order cost less,
// and `order_exact` says so; beyond, the order is that of a heuristic (visiting_order.h). The via-points
// that no path leads to are named. options().timeout, times the number of legs, limits all of it, and each
// leg by itself; every leg asks the stop token.
// Not guaranteed: that all costs are equal in both directions; each is planned.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/path/path.h"
#include "grid_path_planner/planning/path_planner.h"
#include "grid_path_planner/planning/plan.h"

namespace grid_path_planner::planning {

enum class ViaOrder { GIVEN, BEST };
const std::vector<std::pair<const char*, ViaOrder>>& choicesOf(ViaOrder);

// In the map's frame. A round trip's goal is its start.
struct ViaRequest {
  path::Pose start;
  std::vector<Eigen::Vector3d> via;
  path::Pose goal;
  ViaOrder order = ViaOrder::GIVEN;
  bool record_expanded = false;
  bool any_goal_heading = false;  // the vehicle may look as it arrives
};

constexpr std::size_t kMostVia = 1000;    // that are visited as they are given
constexpr std::size_t kMostOrdered = 50;  // whose order is searched for: every pair is planned

struct ViaPlan {
  Plan plan;                             // of all legs; where one fails, its status
  std::vector<std::size_t> order;        // of `via`, indices from 0; empty unless the plan is found
  std::vector<std::size_t> unreachable;  // via-points that no path leads to, as far as was seen
  bool order_exact = false;              // no order costs less
  PoseRequest last_leg;                  // the one that was planned last: that failed, if one did
};

// Without via-points: planner.plan(). Every failure but a bug is a status, as there; more points than
// above: INVALID_REQUEST. The planner's options are as before afterwards.
ViaPlan planThrough(PathPlanner& planner, const ViaRequest& request,
                    const base::StopSource& stop = {});

}  // namespace grid_path_planner::planning
