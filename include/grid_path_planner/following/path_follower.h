// Follows a path: from where the vehicle is and the time to the velocity that it should have.
//
//   PathFollower follower(options);
//   follower.start(path, Join::NEAREST);                   // throws InputError
//   // at any rate:
//   BodyVelocity velocity = follower.update({time, pose, check});
//   for (const FollowEvent& event : follower.takeEvents()) use(event.message);
//
//             start               pose lost, path occupied, held
//   any state ------> DRIVING <---------------------------> BLOCKED ----> FAILED (blocked_timeout)
//                      |  ^ |                                 |
//                pause |  | +--> ARRIVED, FAILED              | pause
//                      v  | resume                            v
//                     PAUSED <--------------------------------+        cancel: CANCELLED
//
// Guaranteed: the velocity is zero in every state but DRIVING, and ARRIVED while a vehicle that
// drifted off is brought back (hold_pose), which is checked like the path. A pause outlives a new
// path: only `resume` ends it. The speeds of the options are never exceeded. Every waypoint is either reached (the vehicle came
// within acceptance_radius), or reported as missed, or lies before the point where the path was
// joined, which is reported too. Time that goes back cancels. Velocities are finite: a pose or a
// time that cannot be used ends the drive with INVALID_POSE. The same calls give the same
// velocities. Not guaranteed: that the vehicle stays on the path whatever pushes it. Farther off
// than acceptance_radius it comes straight back to it before it goes on; this return is checked
// like the path.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grid_path_planner/base/body_velocity.h"
#include "grid_path_planner/following/follower_options.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::vehicle {
struct Description;
}  // namespace grid_path_planner::vehicle

namespace grid_path_planner::following {

class FollowEvents;
class RouteProgress;
class VelocityController;
struct DriveEnd;

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
  MISSED_WAYPOINT,
  INVALID_POSE,
  INVALID_REQUEST,  // of a drive that was refused before it began
  POSE_JUMP,        // the pose changed faster than the vehicle can move
  WRONG_DRIVE       // the vehicle does not go sideways as it is commanded
};
// The enumerator's own name.
const char* toString(DriveStatus status);
// None for any other name.
std::optional<DriveStatus> driveStatusFromName(std::string_view name);

// Where a path is begun: at its first waypoint, or at its point nearest to the vehicle.
enum class Join { FIRST, NEAREST };

struct FollowEvent {
  enum class Kind {
    STARTED,
    JOINED,
    REACHED,
    MISSED,
    RETRY,
    LAP,
    HALFWAY,
    BLOCKED,
    UNBLOCKED,
    ENDED
  };
  Kind kind;
  int waypoint;         // index in the path; -1 where the event has none
  std::string message;  // counts waypoints from 1
};

// Why the path ahead (points in the path's frame: the vehicle's own, the nearest of the path, and the
// path from there on) cannot be driven, in a sentence; empty where it can.
using PathClearanceCheck = std::function<std::string(const std::vector<Eigen::Vector3d>& ahead)>;

// Why the motion that a command begins, and the braking after it, is not free, in a sentence; empty where it is.
using MotionCheck = std::function<std::string(const base::BodyVelocity& command)>;

// The largest speed (m/s) in the plane that the path ahead allows where the vehicle is now; the polyline is as above.
using SpeedLimitCheck = std::function<double(const std::vector<Eigen::Vector3d>& ahead)>;

struct FollowInput {
  double time = 0.0;               // s
  std::optional<path::Pose> pose;  // in the path's frame; none where it is not known now
  PathClearanceCheck check = {};   // none: every path is free
  SpeedLimitCheck speed = {};      // none: only the options limit it
  MotionCheck motion = {};         // none: every motion is free
  std::string pose_problem =
      {};                 // why there is no pose, in a sentence; empty: nothing more is known
  std::string hold = {};  // why the vehicle must not move now, in a sentence; empty: it may
  double pose_age = 0.0;  // s, of the pose; the next pose that is no older than this one is not new
};

class PathFollower {
 public:
  // Throws InputError for options that checkFollowerOptions refuses. A vehicle whose description (checked) is given is
  // steered as its drive can, and heights do not count where it cannot change its own; none: it can go in every direction.
  explicit PathFollower(const FollowerOptions& options = {},
                        const vehicle::Description* vehicle = nullptr);
  ~PathFollower();

  // From the next update on. Throws InputError, then nothing has changed.
  void setOptions(const FollowerOptions& options);
  const FollowerOptions& options() const { return options_; }

  // Drives `path` instead of what was driven before; a paused follower stays paused. Throws
  // InputError for a path that checkWaypoints refuses, then the drive before goes on.
  void start(const path::Path& path, Join join);

  // Whether the state is now the one asked for, and a sentence about it. Pausing and cancelling are always
  // possible: without a drive a pause is one of the next path, and a pose that is held is given up. Resuming needs a
  // pause.
  struct Answer {
    bool done;
    std::string message;
  };
  Answer pause();
  Answer resume();
  // By hand: a pause ends, too. `reason` goes into the message of the drive.
  Answer cancel(const std::string& reason);
  // Cancels, but a pause holds: the next path begins paused, unless resume() or cancel() comes before.
  void abandon(const std::string& reason);

  // The velocity from now on. Times must not decrease; one that does cancels the drive.
  base::BodyVelocity update(const FollowInput& input);

  FollowState state() const { return state_; }
  // DRIVING, PAUSED or BLOCKED.
  bool active() const;
  // Whether it is BLOCKED by what the check says of the path ahead, and by nothing else.
  bool obstructed() const { return state_ == FollowState::BLOCKED && obstructed_; }
  // Whether a vehicle that has arrived is not held where it should be, though hold_pose is set; message() says why.
  bool holdingEnded() const;
  // Of the drive that ended last; NONE while one goes on.
  DriveStatus status() const { return status_; }
  // One sentence about how that was, or why the vehicle is blocked.
  const std::string& message() const { return message_; }

  const path::Path& path() const;
  // Index of the waypoint that is driven to, or was last; 0 before the first update.
  int currentWaypoint() const;
  // Metres along the path to its end, of this lap in a loop; infinity before the first update.
  double distanceRemaining() const;
  // Seconds to there, by the limits of speed of the options; what obstacles add is not in it.
  double timeRemaining() const;
  const std::vector<int>& missedWaypoints() const;
  // From the last pose to the current waypoint's; NaN before there is one.
  double positionError() const;
  double yawError() const;

  // What happened since the last call, in order.
  std::vector<FollowEvent> takeEvents();

 private:
  Answer pauseTheNext();
  base::BodyVelocity velocityFor(const FollowInput& input);
  base::BodyVelocity holdEnd(const FollowInput& input, double seconds);
  void limitSpeed(const FollowInput& input, const std::vector<Eigen::Vector3d>& ahead);
  std::string whyNot(const FollowInput& input) const;
  void block(double time, DriveStatus cause, const std::string& why);
  FollowInput levelled(FollowInput input) const;
  base::BodyVelocity drive(const FollowInput& input, double seconds);
  base::BodyVelocity steer(const FollowInput& input, double seconds);
  void unblock();
  bool jumped(const FollowInput& input);
  bool holds(const FollowInput& input);
  void giveUpHolding(const std::string& why);
  void reportHalfway();
  void end(const DriveEnd& ending);
  void standStill();

  // What holds and watches a drive beside its progress.
  struct Watch;

  FollowerOptions options_;
  const std::unique_ptr<const vehicle::Description> vehicle_;  // null: not described
  FollowState state_ = FollowState::IDLE;
  bool starts_paused_ = false;  // the next path
  DriveStatus status_ = DriveStatus::NONE;
  std::string message_ = "nothing was driven yet";
  const std::unique_ptr<FollowEvents> events_;
  std::unique_ptr<RouteProgress> progress_;  // of the present path, or of the last
  const std::unique_ptr<VelocityController> controller_;

  std::optional<double> time_;
  std::optional<path::Pose> pose_;
  std::optional<double> blocked_since_;
  bool obstructed_ = false;       // when it was blocked last: by the path ahead
  std::optional<double> length_;  // m that were left when driving began; 0 once half are driven
  const std::unique_ptr<Watch> watch_;
};

}  // namespace grid_path_planner::following
