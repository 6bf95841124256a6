#include "vehicle/motion_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vehicle/disc_sweep.h"

namespace grid_path_planner::vehicle {

using base::BodyVelocity, base::StopToken;
using grid::GridGeometry;

namespace {

constexpr double kStep = 0.01;           // s, of one piece of the motion
constexpr std::size_t kSweptSteps = 5;   // at most, that are swept as one
constexpr double kSweptTurn = 0.02;      // rad, the same: their chord is near enough to their arc
constexpr double kStands = 2e-3;         // m/s and rad/s
constexpr double kLongestMotion = 60.0;  // s
constexpr double kModelMargin =
    2e-3;  // m: arcs beside their chords, and what a velocity below kStands still drives
constexpr int kHalvings = 16;          // of the factor by which an outline is scaled down
constexpr double kLongestDrift = 5.0;  // s, in which a drift adds up
constexpr double kTouch = 1e-9;        // m

bool stands(const BodyVelocity& v) {
  return std::abs(v.surge) < kStands && std::abs(v.sway) < kStands &&
         std::abs(v.yaw_rate) < kStands;
}

// The last state up to which the motion from state `i` on is swept as one line.
std::size_t sweptTogether(const std::vector<PlanarState>& states, std::size_t i) {
  const std::size_t most = std::min(states.size() - 1, i + kSweptSteps);
  std::size_t last = i + 1;
  while (last < most && std::abs(states[last + 1].yaw - states[i].yaw) <= kSweptTurn) ++last;
  return last;
}

}  // namespace

MotionCheck::MotionCheck(const Description& vehicle, const GridGeometry& geometry,
                         FootprintObstacles obstacles, MovingVehicle now)
    : model_(vehicle),
      outline_(outlineOf(vehicle)),
      geometry_(geometry),
      obstacles_(std::move(obstacles)),
      now_(std::move(now)),
      room_(roomHere()) {}

std::vector<PlanarState> MotionCheck::motionOf(const BodyVelocity& command) const {
  std::vector<PlanarState> states{now_.state};
  const auto drive = [&](const BodyVelocity& followed, double seconds) {
    for (double left = seconds; left > 0.0; left -= kStep)
      states.push_back(model_.advanced(states.back(), followed, std::min(left, kStep)));
  };
  for (const TimedCommand& pending : now_.pending) drive(pending.command, pending.seconds);
  drive(command, now_.period);
  const auto most = states.size() + static_cast<std::size_t>(kLongestMotion / kStep);
  while (!stands(states.back().velocity) && states.size() < most) drive({}, kStep);
  return states;
}

std::optional<FootprintContact> MotionCheck::contactOf(const BodyVelocity& command) const {
  const std::vector<PlanarState> states = motionOf(command);
  if (room_.factor <= 0.0) return standing();
  for (std::size_t i = 0, next = 0; i + 1 < states.size(); i = next) {
    next = sweptTogether(states, i);
    const Outline outline = outlineAfter(kStep * static_cast<double>(next));
    if (auto contact = sweep(outline, states[i], states[next])) {
      contact->pose = i;
      return contact;
    }
  }
  return std::nullopt;
}

std::optional<FootprintContact> MotionCheck::sweep(const Outline& outline, const PlanarState& from,
                                                   const PlanarState& to) const {
  if (!outline.round()) {
    const Motion motion{from.position, to.position, from.yaw, to.yaw - from.yaw};
    return FootprintSweep(outline.polygon(), geometry_, obstacles_).first(motion, StopToken());
  }
  const auto cell = nearLine(geometry_, obstacles_, from.position, to.position,
                             outline.circumscribedRadius() - kTouch);
  if (!cell) return std::nullopt;
  return FootprintContact{to.position, to.yaw, *cell, 0, false};
}

FootprintContact MotionCheck::standing() const {
  const Eigen::Vector2d at = geometry_.gridFromWorld(now_.state.position);
  const grid::Cell cell{static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y()))};
  return {now_.state.position, now_.state.yaw, cell, 0, true};
}

// The longer a motion, the farther the vehicle may have drifted.
Outline MotionCheck::outlineAfter(double seconds) const {
  if (room_.factor < 1.0) return outline_.scaled(room_.factor);
  const double margin = kModelMargin + model_.vehicle().drift * std::min(seconds, kLongestDrift);
  return outline_.grown(std::min(margin, room_.margin));
}

// What is free about the outline where the vehicle stands.
MotionCheck::Room MotionCheck::roomHere() const {
  const double most = kModelMargin + model_.vehicle().drift * kLongestDrift;
  if (outline_.round()) {
    const double radius = outline_.circumscribedRadius();
    const double clearance = clearanceAt(geometry_, obstacles_, now_.state.position, radius + most);
    if (clearance <= kTouch) return {0.0, 0.0};
    return {clearance - radius, std::min(1.0, clearance / radius)};
  }
  if (standsFree(outline_.grown(most))) return {most, 1.0};
  if (standsFree(outline_))
    return {most * largestFree([&](double share) { return outline_.grown(share * most); }), 1.0};
  return {0.0, largestFree([&](double factor) { return outline_.scaled(factor); })};
}

bool MotionCheck::standsFree(const Outline& outline) const {
  const FootprintSweep sweep(outline.polygon(), geometry_, obstacles_);
  return !sweep.standing(now_.state.position, now_.state.yaw);
}

// The largest share for which `outlineOf` is free where the vehicle stands; 0 is taken to be.
template <class OutlineOf>
double MotionCheck::largestFree(OutlineOf&& outlineOf) const {
  double free = 0.0, touches = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (free + touches);
    (standsFree(outlineOf(middle)) ? free : touches) = middle;
  }
  return free;
}

}  // namespace grid_path_planner::vehicle
