// Answers requests on the newest map in a thread of its own, with a planner of its own.
//
//   PlanningLane lane(maps, store, transforms, nullptr);
//   lane.worker().post([&](const StopSource& stop) { use(lane.plan(request, options, stop)); });
//
// path_planner has two: in one it follows the map and plans for the vehicle, in the other it answers
// questions of services and actions, so that no question delays the vehicle: both share the map and
// its costmaps (planning/map_store.h), and neither waits for what the other plans. Whatever goes
// wrong with a request is a status with a sentence, memory that is not there included.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "grid_path_planner/PlanStatistics.h"
#include "grid_path_planner/base/task_queue.h"
#include "grid_path_planner/planning/path_planner.h"
#include "path/clearance_meter.h"
#include "planning/explanation.h"
#include "planning/via/via_plan.h"
#include "ros/input/frame_lookup.h"
#include "ros/input/map_receiver.h"
#include "ros/planning/planning_request.h"
#include "ros/planning/record/plan_record.h"

namespace grid_path_planner::nodes {

class PlanningLane {
 public:
  using PhaseListener = std::function<void(const char* phase)>;

  // `store` gets what `maps` receives, which outlives this, or its worker's stop(). What `other`
  // searches with (null: none) is not there for this one: they share memory_limit.
  PlanningLane(const MapReceiver& maps, std::shared_ptr<planning::MapStore> store,
               const FrameTransforms& transforms, const PlanningLane* other);

  // Tasks for the lane's thread. They interrupt finishLater().
  base::TaskQueue& worker() { return worker_; }

  // In the worker's thread only:

  // What a plan on the newest map would do first, outside its time limit.
  void prepare(const PathPlannerNodeOptions& options, const base::StopToken& stop);
  // Computes whatever makes plans faster on the newest map, and after its changes, while the thread has
  // nothing else to do; what is done when a task comes stays, but for a copy that is not finished.
  // Of maps of more than kMostFinished cells only the copies, of more than kMostCopied not these.
  void finishLater(const PathPlannerNodeOptions& options);

  // `at_least`: as PathPlanner::takeMap() has it.
  planning::ViaPlan plan(const PlanningRequest& request, const PathPlannerNodeOptions& options,
                         const base::StopSource& stop, const PhaseListener& on_phase = {},
                         std::uint64_t at_least = std::numeric_limits<std::uint64_t>::max());
  // Why a request was answered with `status`, as far as there is more to say within `limit`; nothing
  // where it cannot be said, and of via-points.
  planning::Explanation explain(const PlanningRequest& request, base::Status status,
                                const PathPlannerNodeOptions& options, const base::StopSource& stop,
                                std::chrono::duration<double> limit);
  // Of a plan just made for this request; no stamp yet.
  PlanStatistics statistics(const planning::Plan& plan, const PlanningRequest& request,
                            const PathPlannerNodeOptions& options);
  // The path of a plan just made, with poses as pose_spacing asks for them.
  path::Path posesAlong(const planning::Plan& plan, const PathPlannerNodeOptions& options) const;
  // All that repeats a plan just made; none where nothing was searched for it, or it was cancelled.
  std::optional<PlanRecord> record(const planning::Plan& plan,
                                   const PathPlannerNodeOptions& options) const;
  // Of the map that this plan was searched on, in metres.
  double cellSize(const planning::Plan& plan) const;
  // The longer side of its map, 0 without one, in metres.
  double mapSide() const;

  // Takes the newest map, and lets go of one of another geometry or frame.
  void takeMap(std::uint64_t at_least = std::numeric_limits<std::uint64_t>::max());

  // The costmaps of the newest map; null before the first. Throw Stopped.
  std::shared_ptr<const costmap::CostGrid> downsampledCosts(const PathPlannerNodeOptions& options,
                                                            const base::StopToken& stop);
  // What changed up to the one that downsampledCosts() gave last. Precondition: there is one.
  const costmap::CostChanges& downsampledChanges() const { return planner_->downsampledChanges(); }
  std::shared_ptr<const costmap::CostGrid> fullResolutionCosts(
      const PathPlannerNodeOptions& options, const base::StopToken& stop);

  // Where the footprint meets an obstacle on what remains of a path for a vehicle at `position`, as
  // PathPlanner::footprintContact() says it. Throws Stopped.
  std::string footprintContact(const path::Path& path,
                               const std::optional<Eigen::Vector2d>& position,
                               const PathPlannerNodeOptions& options, const base::StopToken& stop);

  // Where the request wants to go, in the map's frame, metres. Throws InputError, TransformError and
  // Stopped.
  Eigen::Vector2d goalOf(const PlanningRequest& request, const PathPlannerNodeOptions& options,
                         const base::StopToken& stop) const;

  // The goal of the request that was planned last, in the map's frame, where it is in one that moves with the vehicle: it
  // stands where that was.
  std::optional<geometry_msgs::PoseStamped> placedGoal(const PlanningRequest& request,
                                                       const PathPlannerNodeOptions& options) const;

  // Of the map that was used last; map_frame where there is none or it names none.
  std::string frame(const PathPlannerNodeOptions& options) const;

 private:
  static constexpr std::size_t kMostFinished = std::size_t{1} << 22;
  static constexpr std::size_t kMostCopied = std::size_t{1} << 26;

  planning::ViaPlan tryToPlan(const PlanningRequest& request, const PathPlannerNodeOptions& options,
                              const base::StopSource& stop, const PhaseListener& on_phase,
                              std::uint64_t at_least);
  double clearanceOf(const path::Path& path, const grid::OccupancyThresholds& thresholds);
  // Of the options, and the memory that the other lane leaves.
  void setOptions(const planning::PlannerOptions& options);

  const MapReceiver& maps_;
  const std::shared_ptr<planning::MapStore> store_;
  const FrameTransforms& transforms_;
  const PlanningLane* const other_;
  std::atomic<std::size_t> bytes_{0};                 // that the planner does not share
  std::unique_ptr<planning::PathPlanner> planner_;    // the worker's; null before takeMap()
  std::unique_ptr<path::ClearanceMeter> clearances_;  // over the planner's map, at most as long
  std::optional<PlanQuestion> question_;              // of the plan just made
  base::TaskQueue worker_;
};

}  // namespace grid_path_planner::nodes
