#include "localization/filter_step.h"

#include <algorithm>
#include <cmath>

#include "localization/chi_squared.h"
#include "localization/coasting.h"
#include "localization/filter_start.h"
#include "localization/imu_propagation.h"

namespace grid_path_planner::localization {

namespace {

// Variances of what is forgotten: so large that a measurement alone determines it.
constexpr double kAnyPosition = 1e6;  // m^2
constexpr double kAnyVelocity = 1e2;  // m^2/s^2
constexpr double kAnyAngle = 10.0;    // rad^2

// An IMU that was silent for so long, when roll or pitch are known no better (standard deviation): after 1.6 s without
// anything; after 25 s where it tells no attitude, so that only set_pose or markers can begin anew.
constexpr double kSilence = 1.0;                                          // s
constexpr double kUnknownTilt = 0.25, kUnknownTiltWithoutAttitude = 1.0;  // rad

// Standard deviations by which the heading of an IMU that is back may be off the one that the vehicle kept meanwhile. An
// IMU that was started again has a heading of its own, and what was known of it says nothing.
constexpr double kSameImu = 2.0;

// For so long that what is measured lies where the pose lets expect it says little, after a part of that began anew by
// measurements that contradicted the others.
constexpr double kNewPose = 60.0;  // s

using Scalar = Eigen::Matrix<double, 1, 1>;

Inertial between(const TimedImu& from, const TimedImu& to, double stamp) {
  const double share =
      (stamp - static_cast<double>(from.stamp)) / static_cast<double>(to.stamp - from.stamp);
  const Inertial &a = from.measurement.inertial, &b = to.measurement.inertial;
  return {a.rate + share * (b.rate - a.rate),
          a.acceleration + share * (b.acceleration - a.acceleration)};
}

bool isTiltUnknown(const Estimate& estimate, const ImuMeasurement& imu) {
  const Eigen::Matrix<double, 2, 3> level = estimate.state.attitude.toRotationMatrix().topRows<2>();
  const Eigen::Matrix2d tilt =
      level * estimate.covariance.block<3, 3>(kAttitude, kAttitude) * level.transpose();
  const double limit = imu.attitude ? kUnknownTilt : kUnknownTiltWithoutAttitude;
  return !(tilt.diagonal().maxCoeff() <= square(limit));
}

double middle(Stamp from, Stamp to) {
  return static_cast<double>(from) + 0.5 * static_cast<double>(to - from);
}

}  // namespace

FilterStep::FilterStep(const FilterOptions& options, Start start)
    : options_(options), start_(start) {
  for (const int dimension : {1, 3, 6})
    gates_[static_cast<std::size_t>(dimension)] =
        chiSquaredQuantile(dimension, options.gate_probability);
}

bool FilterStep::isBridged(const TimedImu& from, const TimedImu* next_imu) const {
  return next_imu && next_imu->stamp > from.stamp &&
         secondsBetween(from.stamp, next_imu->stamp) <= options_.imu_timeout;
}

Inertial FilterStep::inertialAt(double stamp, const TimedImu& from, const TimedImu& to) const {
  return options_.imu_averages ? to.measurement.inertial : between(from, to, stamp);
}

void FilterStep::advance(FilterSnapshot& snapshot, Stamp stamp, const TimedImu* next_imu) const {
  const Stamp from = snapshot.stamp;
  snapshot.stamp = stamp;
  if (!snapshot.started || stamp == from) return;
  Stamp coasts_from = from;
  if (snapshot.imu) {
    const TimedImu& imu = *snapshot.imu;
    const bool bridged = isBridged(imu, next_imu);
    const Stamp timeout = static_cast<Stamp>(1e9 * options_.imu_timeout);
    coasts_from = bridged ? stamp : std::clamp(imu.stamp + timeout, from, stamp);
    const ImuNoise noise{options_.gyro_noise, options_.gyro_walk, options_.accelerometer_noise,
                         options_.accelerometer_walk, options_.gravity};
    if (coasts_from > from)
      propagate(
          snapshot.estimate,
          bridged ? inertialAt(middle(from, stamp), imu, *next_imu) : imu.measurement.inertial,
          secondsBetween(from, coasts_from), noise);
  }
  if (stamp > coasts_from)
    coast(snapshot.estimate, secondsBetween(coasts_from, stamp),
          {options_.coast_acceleration, options_.coast_turn, options_.gyro_walk,
           options_.accelerometer_walk});
}

BodyRate FilterStep::rateAt(const FilterSnapshot& snapshot, const TimedImu* next_imu) const {
  // Without an IMU the vehicle is assumed not to turn, but for the bias, which is taken off again.
  const BodyRate unknown{snapshot.estimate.state.gyro_bias, square(options_.coast_turn)};
  if (!snapshot.imu) return unknown;
  const TimedImu& imu = *snapshot.imu;
  const double age = secondsBetween(imu.stamp, snapshot.stamp);
  const bool bridged = isBridged(imu, next_imu);
  if (!bridged && age > options_.imu_timeout) return unknown;
  const double period = bridged ? secondsBetween(imu.stamp, next_imu->stamp) : 0.01;
  const double variance = square(options_.gyro_noise) / std::max(period, 1e-4);
  if (!bridged) return {imu.measurement.inertial.rate, variance};
  return {inertialAt(static_cast<double>(snapshot.stamp), imu, *next_imu).rate, variance};
}

Outcome FilterStep::apply(FilterSnapshot& snapshot, const Measurement& measurement,
                          const TimedImu* next_imu) const {
  advance(snapshot, measurement.stamp, next_imu);
  Context context{snapshot, measurement.source, rateAt(snapshot, next_imu)};
  return std::visit([&](const auto& data) { return take(context, data); }, measurement.data);
}

bool FilterStep::passes(const Innovation& innovation) const {
  if (options_.gate == Gate::CHI_SQUARED)
    return innovation.nis() <= gates_[static_cast<std::size_t>(innovation.size())];
  if (options_.gate == Gate::NONE || innovation.size() != 6) return true;
  const bool near = innovation.residual().head<3>().norm() <= options_.gate_distance;
  const bool turned = innovation.residual().tail<3>().norm() <= options_.gate_angle * M_PI / 180.0;
  return options_.gate == Gate::EITHER ? near && turned : near || turned;
}

Outcome FilterStep::fuse(Context& context, Innovation innovation, const Deviation& deviation,
                         void (FilterStep::*forget)(Estimate&) const) const {
  FilterSnapshot& snapshot = context.snapshot;
  Outcome outcome{Verdict::TAKEN, innovation.size(), innovation.nis()};
  if (!std::isfinite(outcome.nis)) return outcome.verdict = Verdict::GATED, outcome;
  Rejections& rejections = snapshot.rejections[static_cast<std::size_t>(context.source)];
  Contradiction& contradiction = snapshot.contradictions[static_cast<std::size_t>(context.source)];
  if (passes(innovation)) {
    const auto& begun = snapshot.begun_anew;
    const bool is_new = begun && secondsBetween(begun->stamp, snapshot.stamp) < kNewPose;
    contradiction.add(snapshot.stamp, is_new ? Agreement::CONFIRMS_NEW : Agreement::CONFIRMS);
  } else {
    const double drift = square(options_.start_velocity);
    const int agreeing = rejections.add(snapshot.stamp, deviation, drift, gates_[6]);
    const bool resets = agreeing >= options_.reset_after && context.source != Source::COMMAND;
    contradiction.add(snapshot.stamp, resets                 ? Agreement::BEGINS_ANEW
                                      : rejections.isAlike() ? Agreement::CONTRADICTS_AGAIN
                                                             : Agreement::CONTRADICTS);
    // A vehicle that does not do as it is told is no sign that its velocity is wrong.
    if (!resets) return outcome.verdict = Verdict::GATED, outcome;
    (this->*forget)(snapshot.estimate);
    innovation.project(snapshot.estimate.covariance);
    outcome.verdict = Verdict::RESET;
    snapshot.begun_anew = NewBegin{context.source, snapshot.stamp};
  }
  innovation.apply(snapshot.estimate);
  rejections.clear();
  return outcome;
}

Outcome FilterStep::take(Context& context, const ImuMeasurement& imu) const {
  FilterSnapshot& snapshot = context.snapshot;
  const bool was_silent =
      snapshot.imu && secondsBetween(snapshot.imu->stamp, snapshot.stamp) > kSilence;
  if (snapshot.started && was_silent && isTiltUnknown(snapshot.estimate, imu))
    beginAnew(snapshot, imu);
  snapshot.imu = TimedImu{snapshot.stamp, imu};
  if (snapshot.started && start_ == Start::AT_FIX && imu.attitude)
    snapshot.heading = knownHeading(snapshot.stamp, *imu.attitude, snapshot.estimate);
  if (!snapshot.started && start_ == Start::AT_ORIGIN) {
    snapshot.estimate = estimateAt(poseAtOrigin(imu, options_), options_);
    snapshot.started = true;
  }
  return {Verdict::TAKEN, 0, 0.0};
}

Outcome FilterStep::fuseVelocity(Context& context, const DvlVelocity& dvl) const {
  const Eigen::Matrix3d lever =
      dvl.sensor.rotation.toRotationMatrix().transpose() * cross(dvl.sensor.position);
  const Eigen::Matrix3d noise = dvl.covariance + context.rate.variance * lever * lever.transpose();
  const Estimate& estimate = context.snapshot.estimate;
  const State& state = estimate.state;
  const Eigen::Vector3d residual =
      dvl.velocity - predictedVelocity<double>(state, context.rate.rate, dvl.sensor);
  Deviation deviation;
  deviation.offset.head<3>() = state.attitude * (dvl.sensor.rotation * residual);
  deviation.variance.head<3>().setConstant(noise.diagonal().maxCoeff());
  return fuse(context, {estimate, residual, velocityJacobian(state, dvl.sensor), noise}, deviation,
              &FilterStep::forgetVelocity);
}

// How the velocity in the world hangs on the attitude is known at the right velocity only: about 0 it
// would not, and the filter would believe its attitude too much.
void FilterStep::adoptVelocity(Context& context, const DvlVelocity& dvl) const {
  State& state = context.snapshot.estimate.state;
  const Eigen::Vector3d turning = context.rate.rate - state.gyro_bias;
  state.velocity =
      state.attitude * (dvl.sensor.rotation * dvl.velocity - turning.cross(dvl.sensor.position));
  forgetVelocity(context.snapshot.estimate);
}

Outcome FilterStep::take(Context& context, const DvlVelocity& dvl) const {
  if (!context.snapshot.started) return {};
  if (!context.snapshot.dvl_used) adoptVelocity(context, dvl);
  const Outcome outcome = fuseVelocity(context, dvl);
  if (outcome.verdict == Verdict::GATED) return outcome;
  context.snapshot.dvl_used = context.snapshot.stamp;
  context.snapshot.rejections[static_cast<std::size_t>(Source::COMMAND)].clear();
  return outcome;
}

Outcome FilterStep::take(Context& context, const CommandedVelocity& command) const {
  FilterSnapshot& snapshot = context.snapshot;
  const auto recent = [&](const std::optional<Stamp>& used, double period) {
    return used && secondsBetween(*used, snapshot.stamp) < period;
  };
  if (!snapshot.started || recent(snapshot.dvl_used, options_.dvl_timeout) ||
      recent(snapshot.command_used, options_.command_period))
    return {};
  const Eigen::Matrix3d covariance =
      square(options_.command_deviation) * Eigen::Matrix3d::Identity();
  const Outcome outcome = fuseVelocity(context, {command.velocity, covariance, command.base});
  snapshot.command_used = snapshot.stamp;
  return outcome;
}

Outcome FilterStep::take(Context& context, const DepthFix& depth) const {
  FilterSnapshot& snapshot = context.snapshot;
  if (!snapshot.started) return {};
  if (start_ == Start::AT_ORIGIN && !snapshot.depth_offset) {
    snapshot.depth_offset =
        predictedPosition<double>(snapshot.estimate.state, depth.sensor).z() - depth.z;
    // The frame's z is that of the first depth: the vehicle is known in it as well as that was measured.
    snapshot.estimate.covariance(kPosition + 2, kPosition + 2) += depth.variance;
    return {Verdict::TAKEN, 0, 0.0};
  }
  const double z = depth.z + snapshot.depth_offset.value_or(0.0);
  const Estimate& estimate = snapshot.estimate;
  const Scalar residual(z - predictedPosition<double>(estimate.state, depth.sensor).z());
  const Jacobian<1> jacobian = positionJacobian(estimate.state, depth.sensor).row(2);
  Deviation deviation;
  deviation.offset.z() = residual.value();
  deviation.variance.z() = depth.variance;
  return fuse(context, {estimate, residual, jacobian, Scalar(depth.variance)}, deviation,
              &FilterStep::forgetDepth);
}

Outcome FilterStep::take(Context& context, const HeadingFix& heading) const {
  FilterSnapshot& snapshot = context.snapshot;
  if (!snapshot.started) return {};
  const Estimate& estimate = snapshot.estimate;
  const Scalar residual(
      std::remainder(heading.yaw - predictedYaw<double>(estimate.state), 2.0 * M_PI));
  Deviation deviation;
  deviation.offset[5] = residual.value();
  deviation.variance[5] = heading.variance;
  return fuse(context, {estimate, residual, yawJacobian(estimate.state), Scalar(heading.variance)},
              deviation, &FilterStep::forgetHeading);
}

Outcome FilterStep::take(Context& context, const PositionFix& fix) const {
  FilterSnapshot& snapshot = context.snapshot;
  if (!snapshot.started) {
    if (snapshot.imu && snapshot.imu->measurement.attitude &&
        secondsBetween(snapshot.imu->stamp, snapshot.stamp) <= options_.imu_timeout)
      return begin(snapshot,
                   poseAtFix(fix, startAttitude(*snapshot.imu->measurement.attitude,
                                                snapshot.imu->stamp, snapshot.heading, options_)));
    return {};
  }
  const Estimate& estimate = snapshot.estimate;
  const Eigen::Vector3d residual =
      fix.position - predictedPosition<double>(estimate.state, fix.sensor);
  Deviation deviation;
  deviation.offset.head<3>() = residual;
  deviation.variance.head<3>() = fix.covariance.diagonal();
  return fixed(context, fuse(context,
                             {estimate, residual, positionJacobian(estimate.state, fix.sensor),
                              fix.covariance},
                             deviation, &FilterStep::forgetPosition));
}

Outcome FilterStep::take(Context& context, const PoseFix& fix) const {
  FilterSnapshot& snapshot = context.snapshot;
  if (context.source == Source::SET_POSE) return setPose(snapshot, fix);
  if (!snapshot.started) return begin(snapshot, poseAtFix(fix));
  const Estimate& estimate = snapshot.estimate;
  const Eigen::Matrix<double, 6, 1> residual = poseResidual<double>(estimate.state, fix);
  const Eigen::Quaterniond expected = estimate.state.attitude * fix.mounting.rotation;
  Deviation deviation;
  deviation.offset << residual.head<3>(), expected * Eigen::Vector3d(residual.tail<3>());
  deviation.variance.head<3>() = fix.covariance.diagonal().head<3>();
  deviation.variance.tail<3>().setConstant(fix.covariance.diagonal().tail<3>().maxCoeff());
  return fixed(
      context,
      fuse(context, {estimate, residual, poseJacobian(estimate.state, fix), fix.covariance},
           deviation, &FilterStep::forgetPose));
}

// A fix that was used shows that the filter is not astray, whatever others say, and that one of another
// kind which began the position anew was right.
Outcome FilterStep::fixed(Context& context, const Outcome& outcome) const {
  if (outcome.verdict == Verdict::GATED) return outcome;
  for (const Source source : {Source::USBL, Source::MARKER})
    context.snapshot.rejections[static_cast<std::size_t>(source)].clear();
  std::optional<NewBegin>& begun = context.snapshot.begun_anew;
  const bool of_position =
      begun && (begun->source == Source::USBL || begun->source == Source::MARKER);
  if (of_position && begun->source != context.source) begun.reset();
  return outcome;
}

Outcome FilterStep::begin(FilterSnapshot& snapshot, const MountedPose& pose) const {
  const bool agrees =
      snapshot.first_fix &&
      agree(*snapshot.first_fix, pose, secondsBetween(*snapshot.first_fix_stamp, snapshot.stamp),
            options_, gates_[6]);
  snapshot.first_fix = pose;
  snapshot.first_fix_stamp = snapshot.stamp;
  if (!agrees) return {};
  snapshot.estimate = estimateAt(pose, options_);
  snapshot.started = true;
  snapshot.first_fix.reset();
  return {Verdict::TAKEN, 0, 0.0};
}

// The estimate is that of before, moved on without an IMU.
void FilterStep::doubtHeading(FilterSnapshot& snapshot, const ImuMeasurement& imu) const {
  if (!snapshot.heading || !imu.attitude) return;
  const StartAttitude back =
      startAttitude(*imu.attitude, snapshot.stamp, snapshot.heading, options_);
  const KnownHeading off = knownHeading(snapshot.stamp, back.attitude, snapshot.estimate);
  if (square(off.offset) > square(kSameImu) * (off.variance + back.yaw))
    snapshot.heading->variance = kUnknownHeading;
}

void FilterStep::beginAnew(FilterSnapshot& snapshot, const ImuMeasurement& imu) const {
  doubtHeading(snapshot, imu);
  snapshot.dvl_used.reset();
  snapshot.rejections = {};
  snapshot.contradictions = {};
  snapshot.begun_anew.reset();
  snapshot.first_fix.reset();
  snapshot.started = start_ == Start::AT_ORIGIN;
  if (!snapshot.started) return;
  const Estimate& before = snapshot.estimate;
  MountedPose pose = poseAtOrigin(imu, options_);
  pose.position = before.state.position;
  pose.attitude = Eigen::AngleAxisd(yawOf(before.state.attitude) - yawOf(pose.attitude),
                                    Eigen::Vector3d::UnitZ()) *
                  pose.attitude;
  pose.covariance.topLeftCorner<3, 3>() = before.covariance.topLeftCorner<3, 3>();
  snapshot.estimate = estimateAt(pose, options_);
}

Outcome FilterStep::setPose(FilterSnapshot& snapshot, const PoseFix& fix) const {
  Estimate next = estimateAt(poseAtFix(fix), options_);
  if (snapshot.started) {
    const State& old = snapshot.estimate.state;
    next.state.velocity = next.state.attitude * (old.attitude.conjugate() * old.velocity);
    next.state.gyro_bias = old.gyro_bias;
    next.state.accelerometer_bias = old.accelerometer_bias;
    next.covariance.bottomRightCorner<6, 6>() =
        snapshot.estimate.covariance.bottomRightCorner<6, 6>();
  }
  snapshot.estimate = next;
  snapshot.started = true;
  snapshot.rejections = {};
  snapshot.contradictions = {};
  snapshot.begun_anew.reset();
  return {Verdict::TAKEN, 0, 0.0};
}

void FilterStep::forgetPosition(Estimate& estimate) const {
  forget(estimate.covariance, kPosition, 3, kAnyPosition);
}

void FilterStep::forgetDepth(Estimate& estimate) const {
  forget(estimate.covariance, kPosition + 2, 1, kAnyPosition);
}

void FilterStep::forgetVelocity(Estimate& estimate) const {
  forget(estimate.covariance, kVelocity, 3, kAnyVelocity);
}

// The velocity was one with respect to the attitude.
void FilterStep::forgetHeading(Estimate& estimate) const {
  forgetAttitude(estimate, square(options_.start_tilt), kAnyAngle);
  forgetVelocity(estimate);
}

void FilterStep::forgetPose(Estimate& estimate) const {
  forgetAttitude(estimate, kAnyAngle, kAnyAngle);
  forgetVelocity(estimate);
  forgetPosition(estimate);
}

}  // namespace grid_path_planner::localization
