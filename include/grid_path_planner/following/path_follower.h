// Follows a path: from where the vehicle is and the time to the velocity that it should have.
//
//   PathFollower follower(options);
//   follower.start(path, Join::NEAREST);                   // throws InputError
//   // at any rate:
//   BodyVelocity velocity = follower.update({time, pose, check});
//   for (const FollowEvent& event : follower.takeEvents()) use(event.message);
//
//             start               pose lost, way occupied
//   any state ------> DRIVING <---------------------------> BLOCKED ----> FAILED (blocked_timeout)
//                      |  ^ |                                 |
//                pause |  | +--> ARRIVED, FAILED              | pause
//                      v  | resume                            v
//                     PAUSED <--------------------------------+        cancel: CANCELLED
//
// Guaranteed: the velocity is zero in every state but DRIVING, and ARRIVED while a vehicle that
// drifted off is brought back (hold_pose). A pause outlives a new path: only `resume` ends it. The
// speeds of the options are never exceeded. Every waypoint is either reached (the vehicle came
// within acceptance_radius), or reported as missed, or lies before the point where the path was
// joined, which is reported too. Time that goes back cancels. The same calls give the same
// velocities. Not guaranteed: that the vehicle stays on the path whatever pushes it. Farther off
// than acceptance_radius it comes straight back to it before it goes on.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/base/body_velocity.h"
#include "grid_path_planner/following/follower_options.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::following {

class DrivenRoute;

enum class FollowState { IDLE, DRIVING, PAUSED, BLOCKED, ARRIVED, CANCELLED, FAILED };
// In small letters, e.g. "driving".
const char* toString(FollowState state);

// How the last drive ended.
enum class DriveStatus {
  NONE,
  ARRIVED,
  CANCELLED,
  BLOCKED,
  TF_STALE,
  NO_PROGRESS,
  MISSED_WAYPOINT
};
// The enumerator's own name.
const char* toString(DriveStatus status);

// Where a path is begun: at its first waypoint, or at its point nearest to the vehicle.
enum class Join { FIRST, NEAREST };

struct FollowEvent {
  enum class Kind { STARTED, JOINED, REACHED, MISSED, RETRY, LAP, BLOCKED, UNBLOCKED, ENDED };
  Kind kind;
  int waypoint;         // index in the path; -1 where the event has none
  std::string message;  // counts waypoints from 1
};

// Says in a sentence why the way (points in the path's frame) cannot be driven; empty where it can.
using WayCheck = std::function<std::string(const std::vector<Eigen::Vector3d>& way)>;

struct FollowInput {
  double time = 0.0;               // s
  std::optional<path::Pose> pose;  // in the path's frame; none where it is not known now
  WayCheck check = {};             // none: every way is free
  std::string pose_problem =
      {};  // why there is no pose, in a sentence; empty: nothing more is known
};

class PathFollower {
 public:
  // Throws InputError for options that checkFollowerOptions refuses.
  explicit PathFollower(const FollowerOptions& options = {});
  ~PathFollower();

  // From the next update on. Throws InputError, then nothing has changed.
  void setOptions(const FollowerOptions& options);
  const FollowerOptions& options() const { return options_; }

  // Drives `path` instead of what was driven before; a paused follower stays paused. Throws
  // InputError for a path that checkWaypoints refuses, then the drive before goes on.
  void start(const path::Path& path, Join join);

  // Whether the state is now the one asked for, and a sentence about it. Pausing needs a drive,
  // resuming a drive; cancelling is always possible.
  struct Answer {
    bool done;
    std::string message;
  };
  Answer pause();
  Answer resume();
  // `reason` goes into the message of the drive.
  Answer cancel(const std::string& reason);

  // The velocity from now on. Times must not decrease; one that does cancels the drive.
  base::BodyVelocity update(const FollowInput& input);

  FollowState state() const { return state_; }
  // DRIVING, PAUSED or BLOCKED.
  bool active() const;
  // Of the drive that ended last; NONE while one goes on.
  DriveStatus status() const { return status_; }
  // One sentence about how that was, or why the vehicle is blocked.
  const std::string& message() const { return message_; }

  const path::Path& path() const { return path_; }
  // Index of the waypoint that is driven to, or was last; 0 before the first update.
  int currentWaypoint() const { return current_waypoint_; }
  // Metres along the path to its end, of this lap in a loop; infinity before the first update.
  double distanceRemaining() const;
  const std::vector<int>& missedWaypoints() const { return missed_; }
  // From the last pose to the current waypoint's; NaN before there is one.
  double positionError() const;
  double yawError() const;

  // What happened since the last call, in order.
  std::vector<FollowEvent> takeEvents();

 private:
  void join(const path::Pose& vehicle);
  bool isHindered(const FollowInput& input);
  void block(double time, DriveStatus cause, const std::string& why);
  base::BodyVelocity drive(const path::Pose& vehicle, double time, double seconds);
  void advance(const path::Pose& vehicle, double time);
  bool isSettled(const path::Pose& vehicle, double time);
  bool isPassed(const Eigen::Vector3d& position) const;
  bool isMissedButGoesOn(const path::Pose& vehicle);
  void reach(int waypoint);
  void beginSegment(std::size_t segment);
  void appendLap();
  void watchProgress(const path::Pose& vehicle, double time);
  double shareOf(const Eigen::Vector3d& position) const;
  Eigen::Vector3d wantedVelocity(const Eigen::Vector3d& position) const;
  double wantedYaw(const path::Pose& vehicle) const;
  base::BodyVelocity holdPose(const path::Pose& vehicle, double seconds);
  base::BodyVelocity limited(const path::Pose& vehicle, Eigen::Vector3d velocity, double yaw_error,
                             double seconds);
  void end(FollowState state, DriveStatus status, const std::string& message);
  void report(FollowEvent::Kind kind, int waypoint, const std::string& message);
  void standStill();
  std::string nameOf(int waypoint) const;

  FollowerOptions options_;
  FollowState state_ = FollowState::IDLE;
  DriveStatus status_ = DriveStatus::NONE;
  std::string message_ = "nothing was driven yet";
  std::vector<FollowEvent> events_;

  path::Path path_;
  Join join_ = Join::FIRST;
  bool loop_ = false;
  std::unique_ptr<DrivenRoute> route_;  // none until the path is joined
  std::size_t segment_ = 0;
  double closest_ = std::numeric_limits<double>::infinity();  // m, to the end of the segment so far
  bool at_stop_ = false;  // came near to the end of the segment, where it stops
  int current_waypoint_ = 0;
  std::vector<int> missed_;
  int retries_ = 0;

  std::optional<double> time_;
  std::optional<path::Pose> pose_;
  std::optional<double> settled_since_;
  std::optional<double> blocked_since_;
  std::optional<double> progress_since_;
  double least_left_ = std::numeric_limits<double>::infinity();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // commanded last, path frame
  double yaw_rate_ = 0.0;
  bool returns_ = false;  // to where it arrived
};

}  // namespace grid_path_planner::following
