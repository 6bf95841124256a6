// What the filter is given: one measurement of one source at one time.
//
//   filter.add({stamp, Source::DVL, DvlVelocity{velocity, covariance, dvl_in_body}});
//
// Stamps are nanoseconds of one clock. A source has at most one measurement at a time.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "localization/imu_propagation.h"
#include "localization/state.h"

namespace grid_path_planner::localization {

using Stamp = std::int64_t;  // ns

inline double secondsBetween(Stamp from, Stamp to) {
  return 1e-9 * static_cast<double>(to - from);
}

// In the order in which measurements of the same stamp are applied.
enum class Source { SET_POSE, IMU, DVL, COMMAND, DEPTH, HEADING, USBL, MARKER };
constexpr int kSources = 8;

struct ImuMeasurement {
  Inertial inertial;
  // Attitude of the body as the IMU itself estimates it; its heading is used at the start only, unless a
  // HeadingFix says it too.
  std::optional<Eigen::Quaterniond> attitude = {};
};

// Velocity of the vehicle over ground as seen by a sensor, in the sensor's frame, m/s.
struct DvlVelocity {
  Eigen::Vector3d velocity;
  Eigen::Matrix3d covariance;
  Mounting sensor;  // in the body frame
};

// The same as commanded: used while there is no DVL.
struct CommandedVelocity {
  Eigen::Vector3d velocity;
  Mounting base;
};

struct DepthFix {
  double z;         // m, world, of the sensor
  double variance;  // m^2
  Eigen::Vector3d sensor;
};

struct HeadingFix {
  double yaw;       // rad, of the body
  double variance;  // rad^2
};

struct PositionFix {
  Eigen::Vector3d position;  // m, world, of the sensor
  Eigen::Matrix3d covariance;
  Eigen::Vector3d sensor;
};

// The pose of something mounted on the vehicle.
struct PoseFix {
  Eigen::Vector3d position;  // m, world
  Eigen::Quaterniond attitude;
  // Position (world), then attitude (right error, in the frame of what is mounted).
  Eigen::Matrix<double, 6, 6> covariance;
  Mounting mounting;  // in the body frame
};

// How far the heading of the IMU was off at some time: that of a plain one drifts.
struct KnownHeading {
  Stamp stamp = 0;
  double offset = 0.0;    // rad, of the IMU's yaw less the true one
  double variance = 0.0;  // rad^2
};

struct Measurement {
  Stamp stamp;
  Source source;
  std::variant<ImuMeasurement, DvlVelocity, CommandedVelocity, DepthFix, HeadingFix, PositionFix,
               PoseFix>
      data;
};

// What became of a measurement.
enum class Verdict {
  TAKEN,
  GATED,      // too far from what was expected
  RESET,      // taken, after several like it were gated: what it measures began anew
  UNUSED,     // nothing to do with it yet, or now
  DUPLICATE,  // refused: its source has one of that stamp
  TOO_OLD,    // refused: older than the history
};

const char* nameOf(Source source);
const char* nameOf(Verdict verdict);

}  // namespace grid_path_planner::localization
