#include "trials/panel_drive.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grid_path_planner::trials {

using simulation::VehicleState;

namespace {

constexpr double kStep = 1e-4;  // s, of central differences

double wave(double amplitude, double period, double t) {
  return amplitude * std::sin(2.0 * M_PI * t / period);
}

// From 0 to 1 with no velocity and no acceleration at both ends.
double smoothStep(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

}  // namespace

PanelDrive::PanelDrive(DriveOptions options, const Eigen::Isometry3d& map_from_panel)
    : options_(std::move(options)),
      map_from_panel_(map_from_panel),
      panel_yaw_(std::atan2(map_from_panel.linear()(1, 0), map_from_panel.linear()(0, 0))) {}

double PanelDrive::turnedAway(double t) const {
  double turn = 0.0;
  for (const TimeWindow& window : options_.away)
    turn += smoothStep((t - window.from) / options_.away_ramp) -
            smoothStep((t - window.to + options_.away_ramp) / options_.away_ramp);
  return options_.away_turn * turn;
}

bool PanelDrive::looksAway(double t) const {
  return std::any_of(options_.away.begin(), options_.away.end(),
                     [t](const TimeWindow& window) { return window.holds(t); });
}

// The panel is looked at along its y axis.
PanelDrive::Place PanelDrive::placeAt(double t) const {
  const DriveOptions& o = options_;
  const double side = wave(o.arc, o.arc_period, t);
  const double range =
      0.5 * (o.nearest + o.farthest) + wave(0.5 * (o.farthest - o.nearest), o.range_period, t);
  const Eigen::Vector3d in_panel(range * std::sin(side), -range * std::cos(side),
                                 wave(o.rise, o.rise_period, t));
  return {map_from_panel_ * in_panel, panel_yaw_ + 0.5 * M_PI + side + turnedAway(t)};
}

VehicleState PanelDrive::stateAt(double t) const {
  const Place now = placeAt(t), before = placeAt(t - kStep), after = placeAt(t + kStep);
  const double period = options_.rock_period, rate = 2.0 * M_PI / period;
  const double quarter = 0.25 * period;  // turns a sine into a cosine
  VehicleState state;
  state.position = now.position;
  state.yaw = std::remainder(now.yaw, 2.0 * M_PI);
  state.velocity = base::inBody((after.position - before.position) / (2.0 * kStep), now.yaw,
                                (after.yaw - before.yaw) / (2.0 * kStep));
  state.roll = wave(options_.rock, period, t);
  state.roll_rate = rate * wave(options_.rock, period, t + quarter);
  state.pitch = wave(0.5 * options_.rock, 1.4 * period, t);
  state.pitch_rate = rate / 1.4 * wave(0.5 * options_.rock, 1.4 * period, t + 1.4 * quarter);
  return state;
}

}  // namespace grid_path_planner::trials
