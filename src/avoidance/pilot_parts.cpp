#include "avoidance/pilot_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "avoidance/sentence.h"

namespace grid_path_planner::avoidance {

using base::BodyVelocity;
using Eigen::Vector3d;

namespace {

constexpr double kFarthestPose = 1e6;    // m
constexpr double kFastest = 1e3;         // m/s
constexpr double kMostClearance = 12.0;  // m
constexpr double kHovers = 0.02;         // m/s
constexpr int kFramesBetween = 5;        // of searches while there is no path
constexpr double kStraightOn = 4.0;      // m

Motion motionOf(const VehiclePose& pose, const BodyVelocity& v) {
  return {pose.position, base::inMap(v, pose.yaw), pose.yaw, v.yaw_rate};
}

// Why the vehicle's state cannot be used; empty: it can.
std::string stateProblem(const PilotInput& input) {
  if (!input.pose)
    return input.pose_problem.empty() ? "the vehicle's pose is not known" : input.pose_problem;
  const VehiclePose& pose = *input.pose;
  if (!pose.position.allFinite() || !std::isfinite(pose.yaw))
    return "the vehicle's pose is not finite";
  if (pose.position.cwiseAbs().maxCoeff() > kFarthestPose)
    return "the vehicle's pose is beyond 1e6 m";
  if (!input.velocity.isFinite()) return "the vehicle's velocity is not finite";
  return base::inMap(input.velocity, 0.0).norm() > kFastest
             ? "the vehicle's velocity is beyond 1000 m/s"
             : "";
}

}  // namespace

void Pilot::Parts::start() {
  flown.clear();
  plan = Route();
  unseen.forget();
  ended_ = false;
  restarts_ = true;
  frames_without_ = 0;
  status_ = PilotStatus::BLOCKED;
  sentence_ = "the flight begins";
}

void Pilot::Parts::end(PilotStatus status, const std::string& sentence) {
  ended_ = true;
  flown.clear();
  hover(status, sentence);
}

void Pilot::Parts::hover(PilotStatus status, const std::string& sentence) {
  status_ = status;
  sentence_ = sentence;
  command_ = {};
  clear_path_ = 0.0;
}

// Stands for a reason that lies not in the path: that is no lack of progress.
void Pilot::Parts::hold(PilotStatus status, const std::string& sentence) {
  recovery.hold(elapsed_);
  hover(status, sentence);
}

PilotAnswer Pilot::Parts::answer() const {
  PilotAnswer answer;
  answer.velocity = command_;
  answer.status = status_;
  answer.sentence = sentence_;
  answer.clearance = surroundings.space().nearest(motion_.position, kMostClearance);
  answer.clear_path = clear_path_;
  const std::optional<double>& seen = surroundings.frameTime();
  answer.frame_age = seen ? time_ - *seen : std::numeric_limits<double>::infinity();
  answer.waypoint = route.empty() ? 0 : route.index();
  answer.new_path = flown.revision() != told_path_;
  return answer;
}

void Pilot::Parts::setTime(double time) {
  if (has_time_ && !(time >= time_)) {
    surroundings.forget();
    end(PilotStatus::CANCELLED,
        "time went back from " + shortNumber(time_) + " to " + shortNumber(time) + " s");
  }
  elapsed_ = has_time_ && time > time_ ? time - time_ : 0.0;
  time_ = time;
  has_time_ = true;
  surroundings.forgetTheFuture(time);
}

void Pilot::Parts::see(const Frame& frame) {
  surroundings.see(frame, has_time_ ? time_ : frame.time, options);
}

PilotAnswer Pilot::Parts::update(const PilotInput& input) {
  setTime(input.time);
  if (input.frame != nullptr) see(*input.frame);
  if (!cannotFly(input)) {
    motion_ = motionOf(*input.pose, input.velocity);
    fresh_ = surroundings.refresh(motion_.position, options);
    command_ = {};
    if (!ended_ && !route.empty()) followRoute();
    if (!ended_ && !route.empty()) fly(input);
  }
  const PilotAnswer answered = answer();
  told_path_ = flown.revision();
  return answered;
}

// Says why, and stands.
bool Pilot::Parts::cannotFly(const PilotInput& input) {
  const std::string problem = stateProblem(input);
  if (ended_ || route.empty()) {
    command_ = {};
    return !problem.empty();
  }
  if (problem.empty()) return !hasFrame(input.cloud_problem);
  hold(PilotStatus::TRANSFORM_ERROR, problem);
  return true;
}

// One that is new enough; says otherwise why not, and stands.
bool Pilot::Parts::hasFrame(const std::string& cloud_problem) {
  const std::optional<double>& seen = surroundings.frameTime();
  if (!cloud_problem.empty()) {
    hold(PilotStatus::NO_CLOUD, cloud_problem);
    return false;
  }
  if (seen && time_ - *seen <= options.cloud_timeout) return true;
  const std::string why = surroundings.problem().empty() ? "" : " (" + surroundings.problem() + ")";
  hold(PilotStatus::NO_CLOUD,
       seen ? "the newest cloud is " + shortNumber(time_ - *seen) + " s old" + why
            : "no cloud has come yet" + why);
  return false;
}

Vector3d Pilot::Parts::target() const {
  const OpenSpace& space = surroundings.space();
  return plan.empty() || plan.done() ? route.target(motion_.position, space, options.d_safe)
                                     : plan.target(motion_.position, space, options.d_safe);
}

double Pilot::Parts::targetRadius() const {
  return plan.empty() || plan.done() ? route.radius(options) : options.home_radius;
}

void Pilot::Parts::followRoute() {
  const int before = route.index();
  route.advance(motion_.position, options);
  if (!plan.empty()) plan.advance(motion_.position, options);
  if (route.done()) return end(PilotStatus::ARRIVED, "arrived at " + placeText(route.goal()));
  if (route.index() == before && !restarts_) return;
  restarts_ = kept_ = false;
  plan = Route();
  unseen.forget();
  recovery.restart(time_, motion_.position, route.goal());
}

// No place within reach of the goal is free of remembered points, of its middle and some about it.
bool Pilot::Parts::goalIsOccupied() const {
  const OpenSpace& space = surroundings.space();
  const Vector3d goal = target();
  if (!space.inside(goal)) return false;
  const double radius = std::max(0.0, targetRadius() - 0.1);
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) {
        const Vector3d off = 0.5 * radius * Vector3d(x, y, options.elevation ? z : 0);
        if (off.norm() <= radius && space.nearest(goal + off, options.d_safe) >= options.d_safe)
          return false;
      }
  return true;
}

// With every frame; for a route that has just begun by what is remembered, since to wait for the next frame is to hover.
void Pilot::Parts::findPath() {
  const bool begins = flown.empty() && !kept_;
  if ((!fresh_ && !begins) || unseen.looks()) return;
  if (flown.empty() && frames_without_ > 0 && frames_without_ < kFramesBetween) {
    ++frames_without_;
    return;
  }
  const PathQuery query{motion_.position, target(), targetRadius(), time_};
  auto found =
      finder.find(surroundings.space(), query, kept_ ? flown.points() : Points(), unseen.closed());
  kept_ = true;
  if (!found) return;
  frames_without_ = found->size() < 2 ? 1 : 0;
  if (found->size() < 2) return flown.clear();
  const std::optional<Vector3d> onwards = beyond(*found);
  flown.set(std::move(*found), onwards);
}

// Where the flight goes on from the end of a path: past the goal to the next waypoint; a single direction
// straight on.
std::optional<Vector3d> Pilot::Parts::beyond(const Points& path) const {
  if (!plan.empty()) return std::nullopt;
  if ((path.back() - target()).norm() <= targetRadius()) return route.after();
  if (options.search != Search::DIRECTION) return std::nullopt;
  return path.back() + kStraightOn * (path.back() - path.front()).normalized();
}

void Pilot::Parts::fly(const PilotInput& input) {
  flown.advance(motion_.position);
  if (!input.hold.empty()) return hold(PilotStatus::BLOCKED, input.hold);
  if (options.rules == Rules::SAFE && goalIsOccupied()) {
    flown.clear();
    unseen.forget();
    return hold(PilotStatus::GOAL_OCCUPIED, "the goal " + placeText(target()) + " is nearer than " +
                                                shortNumber(options.d_safe) +
                                                " m to something that was seen");
  }
  findPath();
  if (recovers()) return;
  if (flown.empty())
    return hover(PilotStatus::BLOCKED, "no path to " + placeText(target()) + " is free");
  const Steering steering = steer();
  command_ = steering.velocity;
  clear_path_ = steering.clear_path;
  if (options.rules == Rules::SAFE) lookAtUnseen(steering);
  describe(steering);
}

Steering Pilot::Parts::steer() const {
  if (options.rules != Rules::SAFE) return steerAtFullSpeed(motion_, flown, options);
  const OpenSpace& space = surroundings.space();
  return steerSafely(motion_, flown, space, space.appeared(), options, unseen.lookAt());
}

// What cannot be seen from here is looked at from elsewhere; in vain, it closes paths.
void Pilot::Parts::lookAtUnseen(const Steering& steering) {
  const KeptRoom room(surroundings.space(), options.d_safe, motion_.position);
  if (!unseen.update(time_, motion_, steering, surroundings.space(), room, options.d_safe)) return;
  if (unseen.looks())
    flown.set(unseen.path(), std::nullopt);
  else
    flown.clear();
}

void Pilot::Parts::describe(const Steering& steering) {
  const BodyVelocity& v = command_;
  const double speed = std::sqrt(v.surge * v.surge + v.sway * v.sway + v.heave * v.heave);
  status_ = speed > kHovers ? PilotStatus::FLYING : PilotStatus::BLOCKED;
  if (status_ == PilotStatus::FLYING) {
    sentence_ = "flying to " + placeText(target()) + ", " +
                shortNumber((target() - motion_.position).norm()) + " m off";
    return;
  }
  if (unseen.lookAt())
    sentence_ = "looking at " + placeText(*unseen.lookAt()) + ", which was not seen";
  else
    sentence_ = steering.closed ? closedText(*steering.closed) : "waiting for room to brake";
}

std::string Pilot::Parts::closedText(const Vector3d& at) const {
  const bool seen = surroundings.space().seen(at);
  return (seen ? "something closes the path at " : "nothing seen free at ") + placeText(at) + ", " +
         shortNumber((at - motion_.position).norm()) + " m off; " +
         (std::abs(command_.yaw_rate) > 0.01 ? "turning" : "looking");
}

// Whether something else is done than to fly.
bool Pilot::Parts::recovers() {
  const bool exhausted = flown.empty() && finder.exhausted();
  const RecoveryStep step =
      recovery.update({time_, motion_.position, motion_.yaw, route.goal(), exhausted}, options);
  if (step != step_ && (step == RecoveryStep::LOOK || step == RecoveryStep::STUCK)) noteNarrow();
  step_ = step;
  switch (step) {
    case RecoveryStep::FLY:
      return false;
    case RecoveryStep::LOOK:
      hover(PilotStatus::BLOCKED,
            "no progress towards " + placeText(target()) + narrow_ + "; looking around");
      command_.yaw_rate = brakes(motion_) ? 0.0 : options.max_yaw_rate;
      return true;
    case RecoveryStep::PLAN:
      askForPlan();
      return true;
    case RecoveryStep::STUCK:
      break;
  }
  end(PilotStatus::STUCK, "came as near as " + shortNumber(recovery.nearest()) + " m to " +
                              placeText(route.goal()) + narrow_ + "; tried: " + recovery.tried());
  return true;
}

// What is too narrow between here and the goal, for the sentences.
void Pilot::Parts::noteNarrow() {
  const auto place =
      finder.tooNarrow(surroundings.space(), {motion_.position, target(), targetRadius(), time_});
  narrow_ = place
                ? "; the passage at " + placeText(place->at) + " is " + shortNumber(place->width) +
                      " m wide, " + shortNumber(finder.neededWidth()) + " m are needed"
                : "";
}

void Pilot::Parts::askForPlan() {
  if (!map_plan) {
    recovery.planned(MapAnswer::NO_MAP, time_);
    return hover(PilotStatus::BLOCKED, "there is no map to plan on");
  }
  const std::optional<Points> path = map_plan(motion_.position, route.goal());
  if (!path)
    return hover(PilotStatus::BLOCKED, "a path to " + placeText(route.goal()) +
                                           " is planned on the map of what was seen");
  const bool found = path->size() >= 2;
  recovery.planned(found ? MapAnswer::PATH : MapAnswer::NO_PATH, time_);
  unseen.forget();
  flown.clear();
  if (found) plan.setPath(*path);
  hover(PilotStatus::BLOCKED,
        found ? "follows a plan on the map" : "the map has no path to " + placeText(route.goal()));
}

}  // namespace grid_path_planner::avoidance
