// Gets a vehicle to a goal: plans, drives, plans again while it drives, and tries what may help where it cannot go on.
//
//   Navigator navigator(options);
//   navigator.start(now);
//   navigator.planned({base::Status::FOUND, "a path of 7 m", path}, now);  // what the planner and the driver answer
//   navigator.drove({NavigatorDrive::State::DRIVING, 4.2}, now);
//   navigator.tick(now);                                               // at any rate
//   for (const NavigatorOrder& order : navigator.takeOrders()) carryOut(order);
//
//            start             FOUND            ARRIVED
//     IDLE --------> PLANNING --------> DRIVING --------> SUCCEED
//                     ^    |   no path    |
//          step done  |    v              v  blocked, failed, goal not reachable any more
//                     RECOVERING <--------+
//                          |  no step is left: ABORT with the sentence of the failure
//     any state: cancel, abort -> STOPPING until the driver has stopped -> PREEMPT, ABORT
//
// Guaranteed: every start ends by exactly one of SUCCEED, ABORT and PREEMPT, unless drop() or another start comes first. It
// ends after the driver has said that it stopped, or kStopTimeout later. A step of recovery is tried again only after the
// vehicle has come kProgress nearer to the goal than at any recovery before, so that recoveries end. The same calls give
// the same orders; no clock is asked. Not guaranteed: that the vehicle stands while a new path is planned; the
// driver watches the map by itself.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "following/go_to/driven_track.h"
#include "following/go_to/navigator_options.h"
#include "following/go_to/recovery_steps.h"
#include "grid_path_planner/base/status.h"
#include "grid_path_planner/following/path_follower.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::following {

enum class NavigatorState { IDLE, PLANNING, DRIVING, RECOVERING, STOPPING };
// The enumerator's own name.
const char* toString(NavigatorState state);

// What somebody has to do. A later PLAN replaces one that is not answered, a later DRIVE the drive before.
struct NavigatorOrder {
  enum class Kind {
    PLAN,
    FORGET_PLAN,
    DRIVE,
    STOP,
    CLEAR_SCAN,
    TELL,
    WARN,
    SUCCEED,
    ABORT,
    PREEMPT
  };
  Kind kind;
  std::string sentence = {};  // TELL, WARN and the ends
  double tolerance = 0.0;     // m, of PLAN; 0: the planner's own
  path::Path path = {};       // DRIVE
};

// The planner's answer with its sentence. No status: it is gone, or has answered what is none.
struct NavigatorPlan {
  std::optional<base::Status> status;
  std::string message;
  path::Path path = {};
};

// How the drive goes on.
struct NavigatorDrive {
  enum class State { DRIVING, PAUSED, HELD, OBSTRUCTED };  // HELD: by anything but the map ahead
  State state;
  double distance_remaining;  // m
  std::string message = {};
};

class Navigator {
 public:
  static constexpr double kProgress = 0.5;     // m
  static constexpr double kStopTimeout = 2.0;  // s
  static constexpr double kClearing = 1.0;     // s, in which the map comes without what was cleared

  // Throws InputError for options that checkNavigatorOptions refuses.
  explicit Navigator(const NavigatorOptions& options = {});
  void setOptions(const NavigatorOptions& options);

  // All times in seconds; they do not decrease.
  void start(double now);
  // Ends the goal as preempted, or as aborted for a reason of others. Nothing without a goal.
  void cancel(const std::string& reason, double now);
  void abort(const std::string& reason, double now);
  // Forgets the goal, which its owner has ended, and stops the vehicle.
  void drop();

  void moved(const path::Pose& pose);
  void planned(const NavigatorPlan& plan, double now);
  void drove(const NavigatorDrive& drive, double now);
  // No status: the driver is gone, or has answered what is none.
  void driveEnded(std::optional<DriveStatus> status, const std::string& message, double now);
  void tick(double now);

  std::vector<NavigatorOrder> takeOrders();

  NavigatorState state() const { return state_; }
  // The step of recovery that is tried; "" in other states.
  std::string step() const;
  // What goes on, or how the last goal ended.
  const std::string& sentence() const { return sentence_; }

 private:
  using Kind = NavigatorOrder::Kind;

  void plan(double tolerance, double now);
  void planFailed(const NavigatorPlan& plan, double now);
  void replanned(const NavigatorPlan& plan, double now);
  void drivePlan(const NavigatorPlan& plan, const std::string& why);
  bool isWorthIt(const path::Path& path) const;
  void notePathAhead(const NavigatorDrive& drive, double now);
  bool isReplanDue(double now) const;

  void planFromHere(const std::string& reason, double now);
  void recover(const std::string& reason, double now);
  bool beginStep(RecoveryStep step, double now);
  bool backOff();
  bool turn();
  void recoveryDriveEnded(std::optional<DriveStatus> status, const std::string& message,
                          double now);
  bool leaveOut(const std::string& why);

  void drive(path::Path path);
  void stopDrive();
  void forgetPlan();
  void finish(Kind kind, const std::string& sentence, double now);
  void end(Kind kind, std::string sentence);
  void tell(Kind kind, const std::string& sentence);

  NavigatorOptions options_;
  std::vector<RecoveryStep> steps_;
  std::vector<NavigatorOrder> orders_;
  DrivenTrack track_;
  std::optional<path::Pose> pose_;

  NavigatorState state_ = NavigatorState::IDLE;
  std::string sentence_;
  bool plan_pending_ = false;
  bool drive_active_ = false;
  double tolerance_ = 0.0;               // m, of the path that is driven or planned
  double planned_at_ = 0.0;              // when the last planning was asked for
  std::optional<double> plan_again_at_;  // PLANNING: another's request took the planner's place
  int replaced_ = 0;                     // how often in a row that happened
  int jumps_ = 0;                        // of the vehicle's pose, so far
  std::string arrival_note_;             // what a plan with tolerance said

  std::optional<path::Pose> remaining_from_;  // where the vehicle was when it was told
  double remaining_ = std::numeric_limits<double>::infinity();  // m, of the path that is driven
  std::optional<NavigatorDrive::State> drive_state_;
  std::optional<double> blocked_since_;
  std::optional<double> free_since_;  // since when the path ahead is free, after it was not
  int alternatives_ = 0;              // while it was not
  bool told_held_ = false;

  std::size_t next_step_ = 0;
  std::optional<RecoveryStep> step_;
  double nearest_ = std::numeric_limits<double>::infinity();  // m to the goal, ever
  double recovered_at_ =
      std::numeric_limits<double>::infinity();  // m to the goal, at the last recovery
  std::optional<double> wait_until_;
  int turns_left_ = 0;

  std::optional<NavigatorOrder> ending_;  // STOPPING
  double stop_deadline_ = 0.0;
};

}  // namespace grid_path_planner::following
