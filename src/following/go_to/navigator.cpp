#include "following/go_to/navigator.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/metrics.h"

namespace grid_path_planner::following {

using base::decimalText;
using base::Status;
using path::lengthOf;
using path::Path;
using path::Pose;

namespace {

constexpr double kBlockedReplanPeriod = 1.0;  // s
constexpr double kFreeAgain = 2.0;      // s of driving, after which the path ahead counts as free
constexpr double kSlack = 0.5;          // m that lengths of paths may differ by for nothing
constexpr double kReplacedPause = 0.2;  // s
constexpr int kMostReplaced = 25;
constexpr int kMostJumps = 20;        // of the pose, before one goal is reached
constexpr int kTurns = 4;             // quarters
constexpr int kMostAlternatives = 2;  // of about the same length, while the path ahead is occupied
constexpr double kUnknown = std::numeric_limits<double>::infinity();

std::string lengthText(double length) {
  return decimalText(std::round(100.0 * length) / 100.0) + " m";
}

template <class Status>
bool isOneOf(const std::optional<Status>& status, std::initializer_list<Status> all) {
  return status && std::find(all.begin(), all.end(), *status) != all.end();
}

template <class Status>
std::string answerText(const std::optional<Status>& status, const std::string& message) {
  return (status ? std::string(toString(*status)) : "NO_ANSWER") + ": " + message;
}

// After these no other drive is tried.
bool endsTheGoal(const std::optional<DriveStatus>& status) {
  return isOneOf(status, {DriveStatus::CANCELLED, DriveStatus::INVALID_POSE,
                          DriveStatus::INVALID_REQUEST, DriveStatus::WRONG_DRIVE});
}

}  // namespace

void checkNavigatorOptions(const NavigatorOptions& options) {
  base::checkOptionLimits(options);
  recoverySteps(options.recovery_steps);
}

const char* toString(NavigatorState state) {
  switch (state) {
    case NavigatorState::IDLE:
      return "IDLE";
    case NavigatorState::PLANNING:
      return "PLANNING";
    case NavigatorState::DRIVING:
      return "DRIVING";
    case NavigatorState::RECOVERING:
      return "RECOVERING";
    case NavigatorState::STOPPING:
      return "STOPPING";
  }
  return "?";
}

Navigator::Navigator(const NavigatorOptions& options) {
  setOptions(options);
}

void Navigator::setOptions(const NavigatorOptions& options) {
  checkNavigatorOptions(options);
  options_ = options;
  steps_ = recoverySteps(options.recovery_steps);
}

void Navigator::start(double now) {
  drop();
  nearest_ = recovered_at_ = kUnknown;
  next_step_ = 0;
  replaced_ = jumps_ = 0;
  sentence_ = "plans";
  plan(0.0, now);
}

void Navigator::cancel(const std::string& reason, double now) {
  if (state_ != NavigatorState::IDLE) finish(Kind::PREEMPT, reason, now);
}

void Navigator::abort(const std::string& reason, double now) {
  if (state_ != NavigatorState::IDLE) finish(Kind::ABORT, reason, now);
}

void Navigator::drop() {
  forgetPlan();
  stopDrive();
  ending_.reset();
  step_.reset();
  wait_until_.reset();
  state_ = NavigatorState::IDLE;
}

void Navigator::moved(const Pose& pose) {
  pose_ = pose;
  track_.add(pose);
}

std::string Navigator::step() const {
  return state_ == NavigatorState::RECOVERING && step_ ? toString(*step_) : "";
}

std::vector<NavigatorOrder> Navigator::takeOrders() {
  return std::exchange(orders_, {});
}

// Planning

void Navigator::plan(double tolerance, double now) {
  if (state_ != NavigatorState::DRIVING) state_ = NavigatorState::PLANNING;
  plan_pending_ = true;
  plan_again_at_.reset();
  planned_at_ = now;
  tolerance_ = tolerance;
  orders_.push_back({Kind::PLAN, "", tolerance});
}

void Navigator::planned(const NavigatorPlan& plan, double now) {
  if (!std::exchange(plan_pending_, false)) return;
  if (state_ == NavigatorState::DRIVING) {
    replanned(plan, now);
  } else if (state_ == NavigatorState::PLANNING) {
    if (plan.status == Status::FOUND && !plan.path.empty())
      drivePlan(plan, "drives");
    else
      planFailed(plan, now);
  }
}

void Navigator::planFailed(const NavigatorPlan& plan, double now) {
  const std::string reason = answerText(plan.status, plan.message);
  if (plan.status == Status::CANCELLED && ++replaced_ <= kMostReplaced)
    plan_again_at_ = now + kReplacedPause;
  else if (!plan.status || isOneOf(plan.status, {Status::INVALID_REQUEST, Status::GOAL_OUTSIDE_MAP,
                                                 Status::CANCELLED}))
    finish(Kind::ABORT, reason, now);
  else
    recover(reason, now);
}

void Navigator::drivePlan(const NavigatorPlan& plan, const std::string& why) {
  replaced_ = 0;
  if (tolerance_ > 0.0) arrival_note_ = plan.message;
  if (state_ != NavigatorState::DRIVING) blocked_since_.reset();
  state_ = NavigatorState::DRIVING;
  step_.reset();
  remaining_ = lengthOf(plan.path);
  remaining_from_ = plan.path.poses.front();
  nearest_ = std::min(nearest_, remaining_);
  drive(plan.path);
  sentence_ = why + " a path of " + lengthText(remaining_);
  tell(Kind::TELL, sentence_);
}

// The path that is driven goes on, where the answer is no verdict on the goal. Where what is ahead is occupied, paths that
// are as long as what is left may still be others, but hardly for the third time.
void Navigator::replanned(const NavigatorPlan& plan, double now) {
  if (plan.status == Status::FOUND && !plan.path.empty()) {
    if (isWorthIt(plan.path) || (blocked_since_ && ++alternatives_ <= kMostAlternatives))
      drivePlan(plan, "instead of " + lengthText(remaining_) + ", drives");
  } else if (drive_state_ == NavigatorDrive::State::PAUSED) {
    tell(Kind::TELL, "planned in vain while paused: " + answerText(plan.status, plan.message));
  } else if (isOneOf(plan.status,
                     {Status::UNREACHABLE, Status::GOAL_OCCUPIED, Status::GOAL_OUTSIDE_MAP})) {
    stopDrive();
    planFailed(plan, now);
  } else if (plan.status != Status::CANCELLED) {
    tell(Kind::WARN, "planned in vain while driving: " + answerText(plan.status, plan.message));
  }
}

// A path that is much longer than what is left is driven too: there would be none such, if what is left were free and as
// cheap as it was.
// What was driven since the driver said how much that is counts with the new path.
bool Navigator::isWorthIt(const Path& path) const {
  const double driven =
      remaining_from_ ? (path.poses.front().position - remaining_from_->position).norm() : 0.0;
  const double difference = std::abs(driven + lengthOf(path) - remaining_);
  return difference > kSlack + options_.replan_hysteresis * remaining_;
}

// Driving

void Navigator::drove(const NavigatorDrive& drive, double now) {
  if (!drive_active_) return;
  drive_state_ = drive.state;
  if (state_ == NavigatorState::DRIVING && std::isfinite(drive.distance_remaining)) {
    remaining_ = drive.distance_remaining;
    remaining_from_ = pose_;
    nearest_ = std::min(nearest_, remaining_);
  }
  notePathAhead(drive, now);
  const bool held = drive.state == NavigatorDrive::State::HELD;
  if (held && !told_held_) tell(Kind::WARN, "the driver stands: " + drive.message);
  told_held_ = held;
}

// A new path resets the driver, which then says that it drives until it has looked: that alone is no progress.
void Navigator::notePathAhead(const NavigatorDrive& drive, double now) {
  if (drive.state == NavigatorDrive::State::OBSTRUCTED) {
    free_since_.reset();
    if (!blocked_since_) {
      blocked_since_ = now;
      alternatives_ = 0;
      planned_at_ = -kUnknown;
    }
    sentence_ = "stands: " + drive.message;
  } else if (drive.state == NavigatorDrive::State::DRIVING && blocked_since_) {
    if (!free_since_) free_since_ = now;
    if (now - *free_since_ >= kFreeAgain) blocked_since_.reset();
  }
  if (drive.state == NavigatorDrive::State::PAUSED || drive.state == NavigatorDrive::State::HELD)
    blocked_since_.reset();
}

void Navigator::driveEnded(std::optional<DriveStatus> status, const std::string& message,
                           double now) {
  drive_active_ = false;
  const std::string reason = answerText(status, message);
  if (state_ == NavigatorState::STOPPING) {
    end(ending_->kind, ending_->sentence);
  } else if (state_ == NavigatorState::RECOVERING && !wait_until_) {
    recoveryDriveEnded(status, message, now);
  } else if (state_ == NavigatorState::DRIVING) {
    if (status == DriveStatus::ARRIVED)
      finish(Kind::SUCCEED, arrival_note_.empty() ? reason : reason + "; " + arrival_note_, now);
    else if (endsTheGoal(status))
      finish(Kind::ABORT, reason, now);
    else if (status == DriveStatus::POSE_JUMP && ++jumps_ <= kMostJumps)
      planFromHere(reason, now);
    else
      recover(reason, now);
  }
}

// The vehicle is elsewhere than where the path was planned from, and nothing else is wrong.
void Navigator::planFromHere(const std::string& reason, double now) {
  tell(Kind::WARN, reason + "; plans anew");
  forgetPlan();
  blocked_since_.reset();
  state_ = NavigatorState::PLANNING;
  plan(tolerance_, now);
}

void Navigator::tick(double now) {
  if (state_ == NavigatorState::STOPPING && now >= stop_deadline_) {
    end(ending_->kind, ending_->sentence + "; the driver has not said that it stopped");
  } else if (state_ == NavigatorState::PLANNING && plan_again_at_ && now >= *plan_again_at_) {
    plan(tolerance_, now);
  } else if (state_ == NavigatorState::RECOVERING && wait_until_ && now >= *wait_until_) {
    wait_until_.reset();
    plan(0.0, now);
  } else if (drive_active_ && blocked_since_ && now - *blocked_since_ >= options_.blocked_timeout) {
    if (state_ == NavigatorState::RECOVERING)
      recoveryDriveEnded(DriveStatus::BLOCKED, sentence_, now);
    else
      recover(answerText<DriveStatus>(DriveStatus::BLOCKED, sentence_), now);
  } else if (state_ == NavigatorState::DRIVING && !plan_pending_ && isReplanDue(now)) {
    plan(tolerance_, now);
  }
}

bool Navigator::isReplanDue(double now) const {
  if (drive_state_ == NavigatorDrive::State::OBSTRUCTED)
    return now - planned_at_ >= kBlockedReplanPeriod;
  return drive_state_ == NavigatorDrive::State::DRIVING && options_.replan_period > 0.0 &&
         remaining_ > kSlack && now - planned_at_ >= options_.replan_period;
}

// Recovery

void Navigator::recover(const std::string& reason, double now) {
  forgetPlan();
  stopDrive();
  if (nearest_ < recovered_at_ - kProgress) next_step_ = 0;
  recovered_at_ = nearest_;
  sentence_ = reason;
  while (next_step_ < steps_.size()) {
    step_ = steps_[next_step_++];
    state_ = NavigatorState::RECOVERING;
    tell(Kind::WARN, reason + "; recovery " + std::to_string(next_step_) + " of " +
                         std::to_string(steps_.size()) + ": " + toString(*step_));
    if (beginStep(*step_, now)) return;
  }
  finish(Kind::ABORT, reason, now);
}

bool Navigator::beginStep(RecoveryStep step, double now) {
  switch (step) {
    case RecoveryStep::WAIT:
      wait_until_ = now + options_.recovery_wait;
      return true;
    case RecoveryStep::BACK_OFF:
      return backOff();
    case RecoveryStep::TURN_AND_LOOK:
      turns_left_ = kTurns;
      return turn();
    case RecoveryStep::PLAN_WITH_TOLERANCE:
      plan(options_.recovery_tolerance, now);
      return true;
    case RecoveryStep::CLEAR_SCAN:
      orders_.push_back({Kind::CLEAR_SCAN});
      wait_until_ = now + kClearing;
      return true;
  }
  return false;
}

bool Navigator::backOff() {
  const Path back = pose_ ? track_.back(*pose_, options_.back_off_distance) : Path();
  if (back.empty()) return leaveOut("nothing was driven that it could drive back");
  drive(back);
  return true;
}

bool Navigator::turn() {
  if (!pose_) return leaveOut("the vehicle's pose is not known");
  --turns_left_;
  Path path;
  path.poses = {{pose_->position, pose_->yaw + 2.0 * M_PI / kTurns}};
  drive(path);
  return true;
}

bool Navigator::leaveOut(const std::string& why) {
  tell(Kind::TELL, std::string(toString(*step_)) + " is left out: " + why);
  return false;
}

// However it ended, it may have helped.
void Navigator::recoveryDriveEnded(std::optional<DriveStatus> status, const std::string& message,
                                   double now) {
  if (endsTheGoal(status)) {
    finish(Kind::ABORT, answerText(status, message), now);
    return;
  }
  const bool arrived = status == DriveStatus::ARRIVED;
  if (!arrived) {
    stopDrive();
    tell(Kind::WARN, std::string(toString(*step_)) + ": " + answerText(status, message));
  }
  if (arrived && *step_ == RecoveryStep::TURN_AND_LOOK && turns_left_ > 0 && turn()) return;
  plan(0.0, now);
}

// Orders: given before they are noted, so that without memory the next call finds what is still to do.

void Navigator::drive(Path path) {
  orders_.push_back({Kind::DRIVE, "", 0.0, std::move(path)});
  drive_active_ = true;
  drive_state_.reset();
  if (state_ != NavigatorState::DRIVING) blocked_since_.reset();
  free_since_.reset();
}

void Navigator::stopDrive() {
  blocked_since_.reset();
  if (!drive_active_) return;
  orders_.push_back({Kind::STOP});
  drive_active_ = false;
}

void Navigator::forgetPlan() {
  plan_again_at_.reset();
  arrival_note_.clear();
  if (!plan_pending_) return;
  orders_.push_back({Kind::FORGET_PLAN});
  plan_pending_ = false;
}

void Navigator::finish(Kind kind, const std::string& sentence, double now) {
  if (state_ == NavigatorState::STOPPING) return;
  forgetPlan();
  wait_until_.reset();
  step_.reset();
  if (!drive_active_) {
    end(kind, sentence);
    return;
  }
  stopDrive();
  state_ = NavigatorState::STOPPING;
  sentence_ = "stops: " + sentence;
  ending_ = NavigatorOrder{kind, sentence};
  stop_deadline_ = now + kStopTimeout;
}

// A copy of the sentence: it may be that of ending_.
void Navigator::end(Kind kind, std::string sentence) {
  state_ = NavigatorState::IDLE;
  sentence_ = sentence;
  ending_.reset();
  orders_.push_back({kind, std::move(sentence)});
}

void Navigator::tell(Kind kind, const std::string& sentence) {
  orders_.push_back({kind, sentence});
}

}  // namespace grid_path_planner::following
