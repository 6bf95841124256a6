#include "ros/driving/drive_loop.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "base/current_error.h"
#include "following/footprint_clearance.h"
#include "following/speed_limit.h"
#include "grid_path_planner/following/path_clearance_check.h"
#include "grid_path_planner/ros/conversions.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/incoming/claimed_lengths.h"

namespace grid_path_planner::nodes {

using base::currentErrorText;

using base::BodyVelocity;
using following::firstFootprintContact;
using following::firstObstruction;
using following::FollowEvent;
using following::FollowInput;
using following::FollowState;
using following::Join;
using following::Obstruction;
using following::PathFollower;
using path::Path;
using vehicle::Footprint;

namespace {

constexpr std::chrono::seconds kRefusedPeriod(1);  // by the wall clock

std::string sentenceOf(const Obstruction& obstruction) {
  std::ostringstream text;
  switch (obstruction.kind) {
    case Obstruction::Kind::OCCUPIED:
      text << "projected_map is occupied ahead";
      break;
    case Obstruction::Kind::UNKNOWN:
      text << "projected_map is unknown ahead";
      break;
    case Obstruction::Kind::OUTSIDE:
      text << "projected_map ends ahead";
      break;
  }
  text << ", at x " << obstruction.at.x() << ", y " << obstruction.at.y() << " m";
  return text.str();
}

}  // namespace

DriveLoop::DriveLoop(const ros::NodeHandle& nh, const NavigatePathOptions& options,
                     FrameTransforms& transforms, Callbacks callbacks)
    : options_(options),
      footprint_(Footprint::fromText("check_footprint", options.check_footprint)),
      transforms_(transforms),
      callbacks_(std::move(callbacks)),
      follower_(options.follower, options.vehicle ? &*options.vehicle : nullptr),
      motions_(options.vehicle ? &*options.vehicle : nullptr),
      gate_(nh, owner()) {
  localization_subscriber_ = subscribeChecked<std_msgs::String>(
      gate_.handle(), "localization_status", 10,
      [this](const std_msgs::String& message) { onLocalization(message); },
      [this] { noteRefused(); });
  gate_.start({options_.control_rate, options_.realtime_priority});
}

DriveLoop::~DriveLoop() {
  finish();
  gate_.thread().stop();
}

CommandGate::Owner DriveLoop::owner() {
  CommandGate::Owner owner;
  owner.tick = [this] { tick(); };
  owner.give_up = [this] { follower_.abandon("the control loop failed: " + currentErrorText()); };
  owner.time_went_back = [this](double seconds) { timeWentBack(seconds); };
  owner.drives = [this] { return follower_.active(); };
  owner.on_handover = callbacks_.on_handover;
  owner.on_refused = [this] { noteRefused(); };
  return owner;
}

void DriveLoop::finish() {
  gate_.finish([this] {
    follower_.cancel("navigate_path ends");
    report(ros::Time::isValid() ? ros::Time::now() : ros::Time());
  });
}

unsigned DriveLoop::start(const Path& path, Join join, unsigned handovers) {
  return gate_.thread().ask([this, &path, join, handovers] {
    if (gate_.finished()) throw base::InputError("navigate_path ends");
    follower_.start(path, join);
    if (handovers != gate_.handovers()) follower_.abandon(kTakenOver);
    reported_waypoint_ = -1;
    return ++drive_;
  });
}

PathFollower::Answer DriveLoop::pause() {
  return gate_.thread().ask([this] { return follower_.pause(); });
}

PathFollower::Answer DriveLoop::resume() {
  return gate_.thread().ask([this] {
    if (gate_.isManual())
      return PathFollower::Answer{false, "the joystick commands: let it go first"};
    const bool granted = holds_.localization.grant(holds_.now().toSec(), options_.degraded);
    const PathFollower::Answer answer = follower_.resume();
    if (!granted || !follower_.active()) return answer;
    return PathFollower::Answer{true, "drives on for degraded_time with a pose that is degraded"};
  });
}

PathFollower::Answer DriveLoop::cancel(const std::string& reason) {
  return gate_.thread().ask([this, &reason] { return follower_.cancel(reason); });
}

void DriveLoop::abandon(const std::string& reason) {
  gate_.thread().ask([this, &reason] { follower_.abandon(reason); });
}

void DriveLoop::setOptions(const NavigatePathOptions& options) {
  gate_.thread().ask([this, &options] {
    follower_.setOptions(options.follower);
    options_ = options;
    gate_.setSchedule({options.control_rate, options.realtime_priority});
    footprint_ = Footprint::fromText("check_footprint", options.check_footprint);
  });
}

DriveStanding DriveLoop::standing() {
  return gate_.thread().ask([this] { return standingNow(); });
}

void DriveLoop::setMap(const MapLiveness& life) {
  gate_.thread().post([this, life] { holds_.setMap(life); });
}

void DriveLoop::setSpeedLimits(const SpeedLimits& limits) {
  gate_.thread().post([this, limits] { holds_.limits = limits; });
}

std::vector<DriveReport> DriveLoop::takeReports() {
  const std::lock_guard<std::mutex> lock(reports_mutex_);
  reports_told_ = false;
  return std::exchange(reports_, {});
}

void DriveLoop::tick() {
  if (!ros::Time::isValid()) {
    send({});
    report({});
    return;
  }
  const ros::Time now = ros::Time::now();
  holds_.tick(now);
  yieldToJoystick();
  follow(now);
  report(now);
}

// The end is reported before another drive begins.
void DriveLoop::timeWentBack(double seconds) {
  holds_.localization.timeWentBack();
  follower_.abandon("time went back by " + std::to_string(seconds) + " s");
  const ros::Time now = ros::Time::now();
  FollowInput without_pose;
  without_pose.time = now.toSec();
  send(follower_.update(without_pose));
  report(now);
}

void DriveLoop::follow(const ros::Time& now) {
  FollowInput input;
  input.time = now.toSec();
  input.hold = whyHeld();
  motions_.tick(input.time, 1.0 / options_.control_rate);
  if (!follower_.path().empty() && input.hold.empty()) findVehicle(input);
  if (motions_.checks() && options_.check_map && input.pose) checkMotions(input);
  if (options_.check_map || holds_.limits.grid)
    input.check = [this](const std::vector<Eigen::Vector3d>& ahead) { return whyNotFree(ahead); };
  if (holds_.limits.grid || holds_.localization.speedShare(options_.degraded) < 1.0)
    input.speed = [this](const std::vector<Eigen::Vector3d>& ahead) { return allowedSpeed(ahead); };
  send(follower_.update(input));
}

std::string DriveLoop::whyHeld() const {
  if (const auto why = gate_.problem(options_.master_timeout)) return *why;
  return holds_.problem(options_).value_or("");
}

void DriveLoop::findVehicle(FollowInput& input) const {
  try {
    const Placed placed = transforms_.placeVehicle({follower_.path().frame_id, options_.tf_timeout,
                                                    Moving::WITH_VEHICLE, options_.base_frame});
    input.pose = placed.level();
    input.pose_age = placed.age;
  } catch (const TransformError& error) {
    input.pose_problem = error.what();
  }
}

void DriveLoop::checkMotions(FollowInput& input) const {
  try {
    const Placed placed =
        transforms_.placeVehicle({frameInMap(holds_.map.map.frame_id, options_.map_frame),
                                  options_.tf_timeout, Moving::WITH_VEHICLE, options_.base_frame});
    input.motion =
        motions_.check(placed.level(), placed.age, *holds_.map.map.grid, options_.limits);
  } catch (const TransformError& error) {
    input.motion = [what = std::string(error.what())](const BodyVelocity&) { return what; };
  }
}

std::vector<Eigen::Vector3d> DriveLoop::inFrame(const std::string& frame,
                                                const std::vector<Eigen::Vector3d>& points) const {
  std_msgs::Header path;
  path.frame_id = follower_.path().frame_id;
  return transforms_.place(
      points, path, {frameInMap(frame, options_.map_frame), options_.tf_timeout, Moving::NO});
}

std::string DriveLoop::whyNotFree(const std::vector<Eigen::Vector3d>& ahead) const {
  try {
    if (holds_.limits.grid) inFrame(holds_.limits.frame_id, ahead);
    if (!options_.check_map) return "";
    const std::vector<Eigen::Vector3d> in_map = inFrame(holds_.map.map.frame_id, ahead);
    auto found = firstObstruction(*holds_.map.map.grid, options_.limits, in_map);
    if (!found && !footprint_.empty())
      found = firstFootprintContact(*holds_.map.map.grid, options_.limits, footprint_, in_map);
    return found ? sentenceOf(*found) : "";
  } catch (const TransformError& error) {
    return std::string("projected_map or speed_limit cannot be compared with the path: ") +
           error.what();
  }
}

double DriveLoop::allowedSpeed(const std::vector<Eigen::Vector3d>& ahead) const {
  const double most =
      options_.follower.max_speed * holds_.localization.speedShare(options_.degraded);
  if (!holds_.limits.grid) return most;
  try {
    return std::min(most, following::allowedSpeed(*holds_.limits.grid, options_.follower,
                                                  inFrame(holds_.limits.frame_id, ahead)));
  } catch (const TransformError&) {
    return 0.0;
  }
}

void DriveLoop::onLocalization(const std_msgs::String& message) {
  if (holds_.localization.hear(message.data, holds_.now().toSec())) return;
  DriveReport report;
  report.note = "A message on localization_status was refused: it begins with no status";
  hand({report});
}

// Seldom: whoever reads the notes may be slow.
void DriveLoop::noteRefused() {
  const auto now = Clock::now();
  if (refused_ && now - *refused_ < kRefusedPeriod) return;
  refused_ = now;
  DriveReport report;
  report.note =
      "A message on stop, manual_control or localization_status was refused: its bytes are none of "
      "it";
  hand({report});
}

// Also where a drive begins meanwhile; a pose that was held would be returned to.
void DriveLoop::yieldToJoystick() {
  if (!gate_.isManual()) return;
  if (follower_.active() && follower_.state() != FollowState::PAUSED) {
    follower_.pause();
    DriveReport report;
    report.note = "The joystick commands: the drive is paused until ~resume";
    hand({report});
  }
  if (follower_.state() == FollowState::ARRIVED) follower_.abandon(kTakenOver);
}

bool DriveLoop::isDriven() const {
  return follower_.active() && follower_.state() != FollowState::PAUSED;
}

void DriveLoop::send(const BodyVelocity& velocity) {
  const BodyVelocity sent = gate_.send(velocity, isDriven()).value_or(BodyVelocity{});
  motions_.sent(sent);
  if (!sent.isZero()) holds_.map.driven.note(holds_.now());
}

void DriveLoop::report(const ros::Time& now) {
  std::vector<DriveReport> reports;
  for (FollowEvent& event : follower_.takeEvents()) {
    reports.emplace_back();
    reports.back().drive = drive_;
    // A tick may pass thousands of waypoints, and the standing takes time for each that is left.
    if (event.kind == FollowEvent::Kind::ENDED) reports.back().standing = standingNow();
    reports.back().event = std::move(event);
  }
  const int current = follower_.currentWaypoint();
  if (follower_.active() && std::exchange(reported_waypoint_, current) != current) {
    geometry_msgs::PoseStamped message;
    message.header.stamp = now;
    message.header.frame_id = follower_.path().frame_id;
    message.pose = poseToMessage(follower_.path().poses[static_cast<std::size_t>(current)]);
    reports.emplace_back();
    reports.back().waypoint = message;
  }
  hand(std::move(reports));
}

void DriveLoop::hand(std::vector<DriveReport> reports) {
  if (reports.empty()) return;
  {
    const std::lock_guard<std::mutex> lock(reports_mutex_);
    for (DriveReport& report : reports) reports_.push_back(std::move(report));
    if (reports_told_) return;
  }
  callbacks_.on_report();  // which may throw: then the next report tells of this one, too
  const std::lock_guard<std::mutex> lock(reports_mutex_);
  reports_told_ = !reports_.empty();
}

DriveStanding DriveLoop::standingNow() const {
  return {follower_.state(),
          follower_.status(),
          follower_.message(),
          follower_.currentWaypoint(),
          follower_.path().poses.size(),
          follower_.distanceRemaining(),
          follower_.timeRemaining(),
          follower_.obstructed(),
          follower_.holdingEnded(),
          follower_.missedWaypoints(),
          follower_.positionError(),
          follower_.yawError()};
}

}  // namespace grid_path_planner::nodes
