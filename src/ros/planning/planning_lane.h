// Answers requests on the newest map in a thread of its own, with a planner and costmaps of its own.
//
//   PlanningLane lane(maps, reader, transforms, nullptr);
//   lane.post([&](const StopSource& stop) { use(lane.plan(request, options, stop)); });
//
// path_planner has two: in one it follows the map and plans for the vehicle, in the other it answers
// questions of services and actions, so that no question delays the vehicle. Whatever goes wrong
// with a request is a status with a sentence, memory that is not there included: the lane then
// begins anew with the newest map.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "grid_path_planner/PlanStatistics.h"
#include "grid_path_planner/base/task_queue.h"
#include "grid_path_planner/planning/path_planner.h"
#include "planning/explanation.h"
#include "ros/common/frame_transforms.h"
#include "ros/common/map_receiver.h"
#include "ros/planning/planning_request.h"

namespace grid_path_planner::nodes {

class PlanningLane {
 public:
  using PhaseListener = std::function<void(const char* phase)>;

  // `reader` is the lane's number among those of `maps`. Both outlive this, or its worker's stop().
  // What `other` holds (null: none) is not there for this one: they share memory_limit.
  PlanningLane(MapReceiver& maps, std::size_t reader, const FrameTransforms& transforms,
               const PlanningLane* other);

  // A task for the lane's thread, as TaskQueue::post(). It interrupts finishLater().
  std::shared_ptr<base::TaskQueue::Task> post(
      base::TaskQueue::Work work, const std::string& slot = "",
      base::TaskQueue::Turn turn = base::TaskQueue::Turn::LAST);
  base::TaskQueue& worker() { return worker_; }

  // In the worker's thread only:

  // What a plan on the newest map would do first, outside its time limit.
  void prepare(const PathPlannerNodeOptions& options, const base::StopToken& stop);
  // Computes whatever makes plans faster on the newest map while the thread has nothing else to do;
  // what is done when a task comes stays. Nothing for maps of more than kMostFinished cells.
  void finishLater(const PathPlannerNodeOptions& options);

  planning::Plan plan(const PlanningRequest& request, const PathPlannerNodeOptions& options,
                      const base::StopSource& stop, const PhaseListener& on_phase = {});
  // Why a request was answered with `status`, as far as there is more to say within a second;
  // nothing where it cannot be said.
  planning::Explanation explain(const PlanningRequest& request, base::Status status,
                                const PathPlannerNodeOptions& options,
                                const base::StopSource& stop);
  // Of a plan just made for this request; no stamp yet.
  PlanStatistics statistics(const planning::Plan& plan, const PlanningRequest& request,
                            const PathPlannerNodeOptions& options) const;
  // Of the map that this plan was searched on, in metres.
  double cellSize(const planning::Plan& plan) const;

  // The costmaps of the newest map; null before the first. Throw Stopped.
  std::shared_ptr<const costmap::CostGrid> downsampledCosts(const PathPlannerNodeOptions& options,
                                                            const base::StopToken& stop);
  std::shared_ptr<const costmap::CostGrid> fullResolutionCosts(
      const PathPlannerNodeOptions& options, const base::StopToken& stop);

  // Of the newest map; map_frame where there is none or it names none.
  std::string frame(const PathPlannerNodeOptions& options) const;

 private:
  static constexpr std::size_t kMostFinished = std::size_t{1} << 22;

  planning::Plan tryToPlan(const PlanningRequest& request, const PathPlannerNodeOptions& options,
                           const base::StopSource& stop, const PhaseListener& on_phase);
  planning::PoseRequest posesOf(const PlanningRequest& request,
                                const PathPlannerNodeOptions& options,
                                const base::StopToken& stop) const;
  void updateMap();
  void useMap(const MapChange& change);
  void beginAnew();
  // Of the options, and the memory that the other lane leaves.
  void setOptions(const planning::PlannerOptions& options);

  MapReceiver& maps_;
  const std::size_t reader_;
  const FrameTransforms& transforms_;
  const PlanningLane* const other_;
  std::atomic<std::size_t> bytes_{0};  // that the planner holds
  // The worker's, as are the next two; null before updateMap().
  std::unique_ptr<planning::PathPlanner> planner_;
  std::string map_frame_id_;
  bool anew_ = false;  // the newest map is taken whole
  std::mutex finishing_mutex_;
  std::shared_ptr<base::TaskQueue::Task> finishing_;  // posted by finishLater()
  base::TaskQueue worker_;
};

}  // namespace grid_path_planner::nodes
