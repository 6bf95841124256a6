// A smooth motion of which everything is known in closed form.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "localization/imu_propagation.h"
#include "localization/so3.h"
#include "localization/state.h"

namespace grid_path_planner::localization {

// amplitude * sin(frequency * t + phase) and its derivatives.
struct Wave {
  double amplitude, frequency, phase;
  double at(double t) const { return amplitude * std::sin(frequency * t + phase); }
  double rate(double t) const { return amplitude * frequency * std::cos(frequency * t + phase); }
  double acceleration(double t) const { return -frequency * frequency * at(t); }
};

// A vehicle that flies loops of some metres, turns and sways; seen from a world that is shifted and
// turned about z.
struct Trajectory {
  Wave x{4.0, 0.15, 0.0}, y{3.0, 0.21, 1.0}, z{1.0, 0.12, 0.5};
  Wave roll{0.08, 0.9, 0.3}, pitch{0.06, 0.7, 1.1}, yaw{1.5, 0.11, 0.4};
  Eigen::Vector3d shift{0.0, 0.0, -20.0};
  double turn = 0.0;  // rad

  Eigen::Quaterniond worldTurn() const {
    return Eigen::Quaterniond(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
  }

  State stateAt(double t) const {
    State state;
    state.position = worldTurn() * Eigen::Vector3d(x.at(t), y.at(t), z.at(t)) + shift;
    state.velocity = worldTurn() * Eigen::Vector3d(x.rate(t), y.rate(t), z.rate(t));
    state.attitude = worldTurn() * Eigen::AngleAxisd(yaw.at(t), Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(pitch.at(t), Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(roll.at(t), Eigen::Vector3d::UnitX());
    return state;
  }

  // What an IMU without errors measures.
  Inertial inertialAt(double t, double gravity) const {
    const double phi = roll.at(t), theta = pitch.at(t);
    Inertial inertial;
    inertial.rate = {
        roll.rate(t) - yaw.rate(t) * std::sin(theta),
        pitch.rate(t) * std::cos(phi) + yaw.rate(t) * std::sin(phi) * std::cos(theta),
        -pitch.rate(t) * std::sin(phi) + yaw.rate(t) * std::cos(phi) * std::cos(theta)};
    const Eigen::Vector3d acceleration =
        worldTurn() * Eigen::Vector3d(x.acceleration(t), y.acceleration(t), z.acceleration(t));
    inertial.acceleration =
        stateAt(t).attitude.conjugate() * (acceleration + Eigen::Vector3d(0.0, 0.0, gravity));
    return inertial;
  }

  // What an IMU without errors measures that integrates turn and velocity inside.
  Inertial meanInertial(double from, double to, double gravity) const {
    const State before = stateAt(from), after = stateAt(to);
    const double seconds = to - from;
    const Eigen::Vector3d turn = logSO3<double>(before.attitude.conjugate() * after.attitude);
    const Eigen::Vector3d force =
        (after.velocity - before.velocity) / seconds + Eigen::Vector3d(0.0, 0.0, gravity);
    return {turn / seconds, (before.attitude * expSO3<double>(0.5 * turn)).conjugate() * force};
  }
};

}  // namespace grid_path_planner::localization
