// Takes requests for paths from any thread and answers them, one after the other, on the newest map
// with the node's options. It has two lanes (planning_lane.h): ask() puts questions into one of them;
// the other is for the node that follows the map and plans for the vehicle.
//
//   PlanningServer server(nh, options, files);
//   auto ticket = server.ask(request, PlanningServer::Publish::YES);
//   ticket->wait();
//   use(ticket->plan());
//
// Whatever goes wrong with a request is a status with a sentence. Publish::YES publishes statistics
// and markers, writes ~waypoints_file and remembers the plan for lastAnswer().
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "base/committed.h"
#include "grid_path_planner/base/task_queue.h"
#include "grid_path_planner/planning/path_planner.h"
#include "ros/guard/node_files.h"
#include "ros/guard/node_time.h"
#include "ros/input/frame_lookup.h"
#include "ros/input/map_receiver.h"
#include "ros/planning/plan_publisher.h"
#include "ros/planning/planning_lane.h"
#include "ros/planning/planning_request.h"
#include "ros/planning/record/plan_recorder.h"
#include "ros/planning/shown/explanation_publisher.h"

namespace grid_path_planner::nodes {

// A request that was handed in, and its answer once there is one.
class PlanTicket {
 public:
  void cancel() { task_->cancel(); }
  void wait() const { task_->wait(); }
  // Whether the answer is there before `limit` passed (steady clock).
  bool waitFor(std::chrono::duration<double> limit) const { return task_->waitFor(limit); }
  // Whether poses() is there before `limit` passed: before what else is told of the plan is measured.
  bool waitForPoses(std::chrono::duration<double> limit) const;
  // Precondition of these: the wait is over. The path's frame is that of the map; the statistics
  // have no stamp. CANCELLED where the server ended before.
  const planning::Plan& plan() const { return plan_; }
  // What is told of its via-points; its `plan` is above.
  const planning::ViaPlan& via() const { return via_; }
  // Its path, with poses as pose_spacing asks for them.
  const path::Path& poses() const { return poses_; }
  const PlanStatistics& statistics() const { return statistics_; }
  // Why there is no path, where that was asked for.
  const planning::Explanation& explanation() const { return explanation_; }
  // "waiting", "preparing" or "searching".
  const char* phase() const { return phase_; }

 private:
  friend class PlanningServer;
  void tellPoses();

  std::atomic<const char*> phase_{"waiting"};
  planning::Plan plan_ = planning::failedPlan(base::Status::CANCELLED, "planning was cancelled");
  planning::ViaPlan via_;
  path::Path poses_;
  PlanStatistics statistics_ = statisticsMessage(plan_);
  std::uint64_t map_ = 0;  // the revision of the newest when it was handed in
  planning::Explanation explanation_;
  std::shared_ptr<base::TaskQueue::Task> task_;
  mutable std::mutex mutex_;
  mutable std::condition_variable told_;
  bool has_poses_ = false;
};

class PlanningServer {
 public:
  enum class Publish { NO, YES };
  enum class Explain { NO, YES };
  // Options and how often they were changed.
  struct Settings {
    PathPlannerNodeOptions options;
    unsigned revision = 0;
  };
  struct Outcome {
    base::Status status;
    std::string message;
  };
  // The outcome that was published last, and what a file holds of the last found path among those.
  struct Answered {
    std::optional<Outcome> outcome;
    std::optional<path::Path> waypoints;
  };

  PlanningServer(ros::NodeHandle nh, const PathPlannerNodeOptions& options, const NodeFiles& files);

  Settings settings() const { return *settings_.get(); }
  // For the requests that are answered after this. Precondition: the options are checked.
  void setOptions(const PathPlannerNodeOptions& options);

  std::shared_ptr<PlanTicket> ask(const PlanningRequest& request, Publish publish,
                                  Explain explain = Explain::NO);

  // Logs and shows why `plan`, made for the vehicle, found no path: in the lane of questions, so that
  // the vehicle does not wait for it. What a plan showed before is removed.
  void explainLater(const PlanningRequest& request, const planning::Plan& plan);

  // Takes the maps that come and calls `on_map` after each, in the subscriber's thread.
  void startMaps(ros::NodeHandle nh, std::function<void()> on_map);
  // A map has come: what questions on it would wait for is begun, before the first question and where
  // there was one since the last call.
  void prepareForQuestions();

  // Cancels all requests and accepts no more.
  void stop();

  // Clears the transforms where ROS time went back: for the threads of the lanes, before they ask tf.
  void tellJumps() { time_of_lanes_.tellJumps(); }

  std::shared_ptr<const Answered> lastAnswer() const { return answered_.get(); }

  PlanningLane& vehicleLane() { return vehicle_lane_; }
  const MapReceiver& maps() const { return maps_; }
  const NodeFiles& files() const { return files_; }
  PlanPublisher& publisher() { return publisher_; }
  // The options for a plan that is published: a search is recorded only where someone wants to see it.
  PathPlannerNodeOptions recordingOptions(PathPlannerNodeOptions options) const;

  // For whoever records: a plan just made in `lane`, whose thread calls.
  void record(const PlanningLane& lane, const planning::Plan& plan,
              const PathPlannerNodeOptions& options) const;

  // For lastAnswer(), before the plan is published.
  void remember(const planning::Plan& plan);

  // Publishes what is told of a plan just made in `lane`, whose thread calls. A failure `as_before` is not logged.
  void publish(const PlanningLane& lane, const planning::Plan& plan,
               const PlanStatistics& statistics, bool as_before = false);

  // The vehicle's position in this frame from tf, without waiting; none where tf has none.
  std::optional<Eigen::Vector2d> vehicle(const std::string& frame,
                                         const PathPlannerNodeOptions& options) const;
  // Whether tf has what a plan in this frame from the vehicle to a pose needs, without waiting.
  bool placed(const std::string& frame, const geometry_msgs::PoseStamped& goal) const;

 private:
  void answer(PlanTicket& ticket, const PlanningRequest& request, Publish publish, Explain explain,
              const base::StopSource& stop);
  void storeMap(const MapChange& change);
  void explain(const PlanningRequest& request, const planning::Plan& plan, unsigned number,
               const base::StopSource& stop);
  void writeWaypoints();

  NodeFiles files_;
  base::Committed<Settings> settings_;
  base::Committed<Answered> answered_;
  std::atomic<bool> asked_{true};  // since the last prepareForQuestions()

  FrameTransforms transforms_;
  NodeTime time_of_lanes_;
  const std::shared_ptr<void> on_jump_back_ =
      time_of_lanes_.onJumpBack([this](double) { transforms_.clear(); });
  PlanPublisher publisher_;
  PlanRecorder recorder_;
  std::mutex writing_mutex_;      // of the waypoints' file
  std::mutex explanation_mutex_;  // of the two below
  unsigned explanation_number_ = 0;
  ExplanationPublisher explanations_;
  MapReceiver maps_;
  const std::shared_ptr<planning::MapStore> store_;
  bool store_is_behind_ = true;  // it lacks a change; the subscriber's thread's
  PlanningLane vehicle_lane_{maps_, store_, transforms_, nullptr};
  PlanningLane question_lane_{maps_, store_, transforms_, &vehicle_lane_};
};

}  // namespace grid_path_planner::nodes
