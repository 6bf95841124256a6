// Where questions about ways are handed in, from any thread, and answered in the worker's.
//
//   PlanningServer desk(nh, options, [] {});  // nothing to do where ROS time jumps back
//   auto inquiry = desk.ask(question, PlanningServer::Publish::YES);
//   inquiry->wait();
//   use(inquiry->answer());
//
// What is announced is seen by everyone: statistics, markers, ~waypoints_file, the last found path.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "grid_path_planner/base/task_queue.h"
#include "ros/common/clock.h"
#include "ros/common/map_receiver.h"
#include "ros/planning/plan_publisher.h"
#include "ros/planning/planning_backend.h"

namespace grid_path_planner::nodes {

// A question on its way.
class PlanTicket {
 public:
  void cancel() { task_->cancel(); }
  void wait() const { task_->wait(); }
  // Whether the answer is there before `limit` passed (steady clock).
  bool waitFor(std::chrono::duration<double> limit) const { return task_->waitFor(limit); }
  // Precondition: the wait is over.
  const PlanningResult& answer() const { return answer_; }
  // "waiting", "preparing" or "searching".
  const char* phase() const { return phase_; }

 private:
  friend class PlanningServer;
  std::atomic<const char*> phase_{"waiting"};
  PlanningResult answer_;
  std::shared_ptr<base::TaskQueue::Task> task_;
};

class PlanningServer {
 public:
  enum class Publish { NO, YES };

  // Options and how often they were changed.
  struct Settings {
    PathPlannerNodeOptions options;
    unsigned revision = 0;
  };
  struct Outcome {
    base::Status status;
    std::string message;
  };

  // `on_time_jump` is called, from any thread, whenever ROS time went back.
  PlanningServer(ros::NodeHandle nh, const PathPlannerNodeOptions& options,
                 std::function<void()> on_time_jump);

  Settings settings() const;
  // For the questions whose turn comes after this. Precondition: the options are checked.
  void setOptions(const PathPlannerNodeOptions& options);

  std::shared_ptr<PlanTicket> ask(const PlanningRequest& question, Publish announce);

  // Ends everything that is under way and takes nothing more.
  void stop();

  // Forgets the transforms where ROS time went back since the last call. Called before every
  // answer, and as often as a node likes.
  void checkClock();

  // What was announced last, and the last found path among it.
  std::optional<Outcome> lastOutcome() const;
  std::optional<path::Path> lastPath() const;

  base::TaskQueue& worker() { return worker_; }
  MapReceiver& maps() { return maps_; }
  PlanPublisher& publisher() { return publisher_; }

  // In the worker's thread only:
  PlanningBackend& engine() { return engine_; }
  PlanningResult answer(const PlanningRequest& question, const PathPlannerNodeOptions& options,
                        const base::StopSource& stop,
                        const PlanningBackend::PhaseListener& on_phase = {});
  void publish(const PlanningResult& answer, const geometry_msgs::PoseStamped& goal);

 private:
  void writeWaypoints(const path::Path& path);

  std::function<void()> on_time_jump_;
  ClockWatch clock_;
  mutable std::mutex mutex_;
  Settings settings_;
  std::optional<Outcome> outcome_;
  std::optional<path::Path> last_path_;

  FrameTransforms transforms_;
  PlanPublisher publisher_;
  MapReceiver maps_;
  PlanningBackend engine_;
  base::TaskQueue worker_;
};

}  // namespace grid_path_planner::nodes
