// Questions about ways, answered on the newest map with the node's options: what the topics, the
// services and the action of path_planner have in common.
//
//   PlanningBackend engine(maps, transforms);
//   PlanningResult answer = engine.answer(question, options, source);
//
// For one thread at a time. Whatever goes wrong with a question is a status with a sentence.
#pragma once

#include <geometry_msgs/PoseStamped.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "grid_path_planner/planning/path_planner.h"
#include "ros/common/frame_transforms.h"
#include "ros/common/map_receiver.h"
#include "ros/planning/path_planner_options.h"

namespace grid_path_planner::nodes {

struct PlanningRequest {
  std::optional<geometry_msgs::PoseStamped> start;  // none: where tf has the vehicle
  geometry_msgs::PoseStamped goal;
  std::string planner;              // empty: the node's
  std::string heuristic;            // empty: the node's
  std::optional<double> tolerance;  // m; none: the node's
};

struct PlanningResult {
  planning::Plan report;  // its path's frame is that of the map
  std::string planner;    // that was asked
  std::string heuristic;  // that it used; empty: none
  double turning_rad = 0.0;
  double clearance_m = 0.0;  // 0 without a path

  bool found() const { return report.status == base::Status::FOUND; }
};

// Whether there is a planner of this name and it is guided by a heuristic.
bool usesHeuristic(const std::string& planner);

class PlanningBackend {
 public:
  enum class Phase { PREPARING, SEARCHING };
  using PhaseListener = std::function<void(Phase)>;

  // Both outlive the engine.
  PlanningBackend(MapReceiver& maps, const FrameTransforms& transforms)
      : maps_(maps), transforms_(transforms) {}

  PlanningResult answer(const PlanningRequest& question, const PathPlannerNodeOptions& options,
                        const base::StopSource& stop, const PhaseListener& on_phase = {});

  // The maps as searched and at full resolution, of the newest map; null before the first. Throws
  // Stopped.
  std::shared_ptr<const costmap::CostGrid> searchedCosts(const PathPlannerNodeOptions& options,
                                                         const base::StopToken& stop);
  std::shared_ptr<const costmap::CostGrid> fineCosts(const PathPlannerNodeOptions& options,
                                                     const base::StopToken& stop);

  // Of the newest map; map_frame where there is none or it names none.
  std::string frame(const PathPlannerNodeOptions& options) const;

  // Of the newest map, in metres. Precondition: a map has come.
  double resolution() const { return planner_.map()->geometry().resolution(); }
  bool hasMap() const { return planner_.hasMap(); }

  // Where tf has the vehicle, without waiting; none where it has not.
  std::optional<Eigen::Vector2d> vehicle(const PathPlannerNodeOptions& options) const;

 private:
  void takeMap();
  planning::PoseRequest resolve(const PlanningRequest& question,
                                const PathPlannerNodeOptions& options,
                                const base::StopToken& stop) const;
  planning::Plan report(const PlanningRequest& question, const PathPlannerNodeOptions& options,
                        const base::StopSource& stop, const PhaseListener& on_phase);

  MapReceiver& maps_;
  const FrameTransforms& transforms_;
  planning::PathPlanner planner_;
  std::string map_frame_id_;
};

}  // namespace grid_path_planner::nodes
