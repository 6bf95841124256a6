#include "following/free_steering.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace grid_path_planner::following {

using path::Pose;

namespace {

constexpr double kPursuits[] = {1.0, 0.5, 0.25};
constexpr double kReturn =
    0.02;  // the pursuit of one that goes back to the route before it goes on
constexpr double kSlower[] = {0.4, 0.15};
constexpr double kHardly = 2e-3;  // m/s and rad/s

bool hardlyMoves(const base::BodyVelocity& v) {
  const double fastest = std::max({std::abs(v.surge), std::abs(v.sway), std::abs(v.heave)});
  return fastest < kHardly && std::abs(v.yaw_rate) < kHardly;
}

class Choice {
 public:
  explicit Choice(const MotionCheck& check) : check_(check) {}

  // Whether it is free, and so chosen. One instead of another that is refused has to move.
  bool takes(const Steering& steering) {
    if (!found_.problem.empty() && hardlyMoves(steering.command)) return false;
    const std::string problem = check_ ? check_(steering.command) : std::string();
    if (problem.empty())
      found_.steering = steering;
    else if (found_.problem.empty())
      found_.problem = problem;
    return problem.empty();
  }

  bool takesSlower(const Steering& steering) {
    for (const double factor : kSlower)
      if (takes(steering.slowed(factor))) return true;
    return false;
  }

  FreeSteering found() const { return found_; }

 private:
  const MotionCheck& check_;
  FreeSteering found_;
};

}  // namespace

FreeSteering freeSteering(const VelocityController& controller, const RoutePosition& position,
                          const Pose& vehicle, double seconds, const MotionCheck& check) {
  Choice choice(check);
  const auto steeringWith = [&](double pursuit) {
    return controller.follow(position, vehicle, seconds, pursuit);
  };
  for (const double pursuit : kPursuits)
    if (choice.takes(steeringWith(pursuit))) return choice.found();
  const Steering exact = steeringWith(*std::rbegin(kPursuits)), back = steeringWith(kReturn);
  const bool found = choice.takesSlower(exact) || choice.takes(back) || choice.takesSlower(back) ||
                     choice.takes(exact.turnAlone()) || choice.takes(exact.withoutTurn());
  if (!found) choice.takesSlower(exact.withoutTurn());
  return choice.found();
}

FreeSteering freeSteering(const Steering& steering, const MotionCheck& check) {
  Choice choice(check);
  if (!choice.takes(steering)) choice.takesSlower(steering);
  return choice.found();
}

}  // namespace grid_path_planner::following
