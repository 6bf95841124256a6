// One step of the filter: from a snapshot, over the time to a measurement, with that measurement.
//
//   FilterStep step(options, Start::AT_FIX);
//   const Outcome outcome = step.apply(snapshot, measurement, next_imu);
//
// The result depends on the arguments alone, so that a snapshot can be taken up again when an earlier
// measurement comes late.
//
// A filter that starts AT_FIX begins where a set pose says, or where two fixes in a row agree; the
// attitude is that of the fix, or of the IMU at the same time (within imu_timeout). One that starts
// AT_ORIGIN begins with the first measurement of the IMU, at position 0, and takes no fix but depth,
// relative to the first.
//
// An IMU that comes back when nobody knows any more how the vehicle is tilted begins the estimate anew: errors of such
// angles are not linear, and a filter that goes on may settle upside down. AT_FIX it begins with the next two fixes
// that agree, by the IMU's heading less what it was off before (not known any more where that contradicts the vehicle's of
// before, as that of an IMU which was started again), AT_ORIGIN with the tilt of the IMU at the position and heading of before.
#pragma once

#include <array>
#include <optional>

#include "localization/contradiction.h"
#include "localization/filter_options.h"
#include "localization/kalman_update.h"
#include "localization/measurement.h"
#include "localization/mounted_pose.h"
#include "localization/rejections.h"
#include "localization/state.h"

namespace grid_path_planner::localization {

enum class Start { AT_FIX, AT_ORIGIN };

struct TimedImu {
  Stamp stamp = 0;
  ImuMeasurement measurement;
};

struct Outcome {
  Verdict verdict = Verdict::UNUSED;
  int degrees_of_freedom = 0;
  double nis = 0.0;  // normalised innovation squared
};

// Rejected measurements that agree began anew what they measure.
struct NewBegin {
  Source source;
  Stamp stamp;
};

struct FilterSnapshot {
  Stamp stamp = 0;
  bool started = false;
  Estimate estimate;
  std::optional<TimedImu> imu;
  // That the next fix is compared with while the filter has not started.
  std::optional<MountedPose> first_fix;
  std::optional<Stamp> first_fix_stamp;
  std::optional<KnownHeading> heading;          // of the IMU, when AT_FIX was started last
  std::optional<double> depth_offset;           // m, of a filter that starts at the origin
  std::optional<Stamp> dvl_used, command_used;  // a command that was gated, too
  std::array<Rejections, kSources> rejections;
  std::array<Contradiction, kSources> contradictions;
  // The last one that no fix of another kind has confirmed, and no pose that was set.
  std::optional<NewBegin> begun_anew;
};

// Of the body, with its variance by the noise of the gyro.
struct BodyRate {
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();  // rad/s, as the gyro measures it
  double variance = 0.0;                           // rad^2/s^2
};

class FilterStep {
 public:
  FilterStep(const FilterOptions& options, Start start);

  // `next_imu`: the first measurement of the IMU at or after this measurement, null where there is none.
  Outcome apply(FilterSnapshot& snapshot, const Measurement& measurement,
                const TimedImu* next_imu) const;

  // Moves the estimate on to `stamp`, which is not before the snapshot's.
  void advance(FilterSnapshot& snapshot, Stamp stamp, const TimedImu* next_imu) const;

  // At the stamp of the snapshot.
  BodyRate rateAt(const FilterSnapshot& snapshot, const TimedImu* next_imu) const;

 private:
  struct Context {
    FilterSnapshot& snapshot;
    Source source;
    BodyRate rate;
  };

  bool isBridged(const TimedImu& from, const TimedImu* next_imu) const;
  // The motion at `stamp`, which lies between the two.
  Inertial inertialAt(double stamp, const TimedImu& from, const TimedImu& to) const;
  Outcome take(Context& context, const ImuMeasurement& imu) const;
  Outcome take(Context& context, const DvlVelocity& dvl) const;
  Outcome take(Context& context, const CommandedVelocity& command) const;
  Outcome take(Context& context, const DepthFix& depth) const;
  Outcome take(Context& context, const HeadingFix& heading) const;
  Outcome take(Context& context, const PositionFix& fix) const;
  Outcome take(Context& context, const PoseFix& fix) const;
  Outcome fuseVelocity(Context& context, const DvlVelocity& dvl) const;
  Outcome fixed(Context& context, const Outcome& outcome) const;
  Outcome begin(FilterSnapshot& snapshot, const MountedPose& pose) const;
  void beginAnew(FilterSnapshot& snapshot, const ImuMeasurement& imu) const;
  void doubtHeading(FilterSnapshot& snapshot, const ImuMeasurement& imu) const;
  void adoptVelocity(Context& context, const DvlVelocity& dvl) const;
  Outcome setPose(FilterSnapshot& snapshot, const PoseFix& fix) const;
  bool passes(const Innovation& innovation) const;
  Outcome fuse(Context& context, Innovation innovation, const Deviation& deviation,
               void (FilterStep::*forget)(Estimate&) const) const;
  void forgetPosition(Estimate& estimate) const;
  void forgetDepth(Estimate& estimate) const;
  void forgetVelocity(Estimate& estimate) const;
  void forgetHeading(Estimate& estimate) const;
  void forgetPose(Estimate& estimate) const;

  FilterOptions options_;
  Start start_;
  std::array<double, 7> gates_{};  // by dimension
};

}  // namespace grid_path_planner::localization
