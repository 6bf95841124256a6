// Where questions about ways are handed in, from any thread, and answered in the worker's.
//
//   PlanDesk desk(nh, options, [] {});  // nothing to do where ROS time jumps back
//   auto inquiry = desk.ask(question, PlanDesk::Announce::YES);
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

#include "grid_path_planner/ros/clock.h"
#include "grid_path_planner/ros/map_receiver.h"
#include "grid_path_planner/ros/plan_engine.h"
#include "grid_path_planner/ros/plan_publisher.h"
#include "grid_path_planner/ros/plan_worker.h"

namespace grid_path_planner {

// A question on its way.
class Inquiry {
 public:
  void cancel() { task_->cancel(); }
  void wait() const { task_->wait(); }
  // Whether the answer is there before `limit` passed (steady clock).
  bool waitFor(std::chrono::duration<double> limit) const { return task_->waitFor(limit); }
  // Precondition: the wait is over.
  const PlanAnswer& answer() const { return answer_; }
  // "waiting", "preparing" or "searching".
  const char* phase() const { return phase_; }

 private:
  friend class PlanDesk;
  std::atomic<const char*> phase_{"waiting"};
  PlanAnswer answer_;
  std::shared_ptr<PlanWorker::Task> task_;
};

class PlanDesk {
 public:
  enum class Announce { NO, YES };

  // Options and how often they were changed.
  struct Settings {
    PathPlannerNodeOptions options;
    unsigned revision = 0;
  };
  struct Outcome {
    Status status;
    std::string message;
  };

  // `on_time_jump` is called, from any thread, whenever ROS time went back.
  PlanDesk(ros::NodeHandle nh, const PathPlannerNodeOptions& options,
           std::function<void()> on_time_jump);

  Settings settings() const;
  // For the questions whose turn comes after this. Precondition: the options are checked.
  void setOptions(const PathPlannerNodeOptions& options);

  std::shared_ptr<Inquiry> ask(const PlanQuestion& question, Announce announce);

  // Ends everything that is under way and takes nothing more.
  void stop();

  // Forgets the transforms where ROS time went back since the last call. Called before every
  // answer, and as often as a node likes.
  void checkClock();

  // What was announced last, and the last found path among it.
  std::optional<Outcome> lastOutcome() const;
  std::optional<Path> lastPath() const;

  PlanWorker& worker() { return worker_; }
  MapReceiver& maps() { return maps_; }
  PlanPublisher& publisher() { return publisher_; }

  // In the worker's thread only:
  PlanEngine& engine() { return engine_; }
  PlanAnswer answer(const PlanQuestion& question, const PathPlannerNodeOptions& options,
                    const StopSource& stop, const PlanEngine::PhaseListener& on_phase = {});
  void announce(const PlanAnswer& answer, const geometry_msgs::PoseStamped& goal);

 private:
  void writeWaypoints(const Path& path);

  std::function<void()> on_time_jump_;
  ClockWatch clock_;
  mutable std::mutex mutex_;
  Settings settings_;
  std::optional<Outcome> outcome_;
  std::optional<Path> last_path_;

  FrameTransforms transforms_;
  PlanPublisher publisher_;
  MapReceiver maps_;
  PlanEngine engine_;
  PlanWorker worker_;
};

}  // namespace grid_path_planner
