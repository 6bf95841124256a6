#include "trials/sensor_tape.h"

#include <algorithm>
#include <cmath>

#include "localization/mounted_pose.h"
#include "simulation/camera/pinhole.h"
#include "simulation/sensors/dvl.h"
#include "simulation/sensors/imu.h"
#include "simulation/sensors/pressure_sensor.h"
#include "simulation/sensors/usbl.h"

namespace grid_path_planner::trials {

using Eigen::Isometry3d, Eigen::Quaterniond, Eigen::Vector3d;
using localization::CommandedVelocity, localization::DepthFix, localization::HeadingFix,
    localization::ImuMeasurement, localization::MountedPose, localization::Mounting,
    localization::PoseFix, localization::PositionFix, localization::Source, localization::Stamp,
    localization::State;
using simulation::NavigationSensorOptions, simulation::VehicleState, simulation::World;

namespace {

constexpr std::int64_t kStepNs = 10'000'000;
constexpr int kSlowSteps = 10;          // between two commands, and two headings
constexpr double kCommandNoise = 0.02;  // m/s
constexpr double kHeadingNoise = 0.01;  // rad
constexpr double kLeastFlip = 0.349;    // rad

Mounting mountingOf(const Isometry3d& pose) {
  return {pose.translation(), Quaterniond(pose.linear())};
}

std::int64_t stepsOf(const DriveOptions& drive) {
  return static_cast<std::int64_t>(drive.seconds * 1e9) / kStepNs;
}

// When an image is stamped, s, and in ns.
double stampedTime(const TrialStudy& study, const ErrorSet& set, int frame) {
  return frameTime(study, frame) + set.camera_clock;
}
Stamp stampOf(double time) {
  return std::llround(1e9 * time);
}

// All sensors on, with the run's noise.
NavigationSensorOptions sensorsOf(const ErrorSet& set, int seed) {
  NavigationSensorOptions options = set.sensors;
  options.imu.seed = options.dvl.seed = options.pressure.seed = options.usbl.seed = seed;
  return options;
}

simulation::UsblOptions withOutliers(simulation::UsblOptions options, double share) {
  options.outlier_share = share;
  return options;
}

// The other pose that the panel's corners nearly fit: seen from the other side of its normal.
Isometry3d flippedPose(const Isometry3d& panel_from_camera) {
  const Vector3d place = panel_from_camera.translation();
  const double side = std::atan2(place.x(), -place.y());
  const double turn = std::copysign(std::max(2.0 * std::abs(side), kLeastFlip), -side);
  return Eigen::AngleAxisd(turn, Vector3d::UnitZ()) * panel_from_camera;
}

class TapeRecorder {
 public:
  TapeRecorder(const TrialStudy& study, const World& world, std::size_t set, int seed,
               const MarkerErrors& errors, MarkerSource source)
      : study_(study),
        set_(study.sets[set]),
        set_number_(set),
        seed_(seed),
        options_(sensorsOf(set_, seed)),
        drive_(study.drive, study.map_from_panel),
        errors_(errors),
        source_(source),
        imu_(options_.imu),
        dvl_(world, options_.dvl),
        pressure_(options_.pressure),
        body_from_base_(options_.imu.mounting.pose().inverse()) {
    tape_.base = mountingOf(body_from_base_);
    const std::pair<UsblKind, double> kinds[] = {{UsblKind::CLEAN, 0.0},
                                                 {UsblKind::USUAL, options_.usbl.outlier_share},
                                                 {UsblKind::MANY_OUTLIERS, study.outliers}};
    for (const auto& [kind, share] : kinds)
      usbls_.emplace_back(kind, simulation::Usbl(withOutliers(options_.usbl, share)));
  }

  SensorTape record() {
    addImages();
    const std::int64_t steps = stepsOf(study_.drive);
    std::size_t instant = 0;
    for (std::int64_t step = 0; step <= steps; ++step) {
      measure(step);
      while (instant < tape_.instants.size() &&
             tape_.instants[instant].stamp < (step + 1) * kStepNs)
        addTruth(tape_.instants[instant++]);
    }
    tape_.instants.resize(instant);
    std::stable_sort(tape_.entries.begin(), tape_.entries.end(),
                     [](const TapeEntry& a, const TapeEntry& b) { return a.arrives < b.arrives; });
    return std::move(tape_);
  }

 private:
  template <class Data>
  void add(Stamp stamp, Source source, const Data& data) {
    tape_.entries.push_back({stamp, {stamp, source, data}});
  }

  Vector3d placeOf(const simulation::Mounting& mounting) const {
    return body_from_base_ * mounting.pose().translation();
  }

  void measure(std::int64_t step) {
    const Stamp now = step * kStepNs;
    const VehicleState state = drive_.stateAt(1e-9 * static_cast<double>(now));
    if (const auto reading = imu_.measure(state, now)) addImu(*reading, state);
    if (const auto reading = dvl_.measure(state, now); reading && reading->velocity)
      add(now, Source::DVL,
          localization::DvlVelocity{reading->velocity->velocity, reading->velocity->covariance,
                                    mountingOf(body_from_base_ * options_.dvl.mounting.pose())});
    if (const auto reading = pressure_.measure(state, now))
      add(now, Source::DEPTH,
          DepthFix{heightFromPressure(options_.pressure, reading->pressure),
                   heightVariance(options_.pressure, reading->variance),
                   placeOf(options_.pressure.mounting)});
    for (auto& [kind, usbl] : usbls_) addUsbl(kind, usbl.measure(state, now));
    if (step % kSlowSteps == 0) addSlow(state, now);
  }

  void addImu(const simulation::ImuReading& reading, const VehicleState& state) {
    if (!began_) addStart(state, reading.time_ns);
    ImuMeasurement imu;
    imu.inertial = {reading.angular_velocity, reading.specific_force};
    imu.attitude = reading.orientation;
    add(reading.time_ns, Source::IMU, imu);
  }

  // The pose that the filter is set to: with noise of what it is told, and with the error of the heading, of
  // which it is not.
  void addStart(const VehicleState& state, Stamp stamp) {
    began_ = true;
    const State truth = bodyState(state);
    Noise noise(seed_, Purpose::START);
    const double angle = study_.filter.start_yaw;
    const Vector3d shift = study_.start_deviation * noise.normals(), turn = angle * noise.normals();
    PoseFix fix{truth.position + shift,
                Eigen::AngleAxisd(options_.imu.heading_error, Vector3d::UnitZ()) * truth.attitude *
                    localization::expSO3<double>(turn),
                localization::PoseCovariance::Zero(),
                {}};
    fix.covariance.diagonal().head<3>().setConstant(study_.start_deviation *
                                                    study_.start_deviation);
    fix.covariance.diagonal().tail<3>().setConstant(angle * angle);
    add(stamp, Source::SET_POSE, fix);
  }

  void addUsbl(UsblKind kind, const std::vector<simulation::UsblFix>& fixes) {
    for (const simulation::UsblFix& fix : fixes)
      tape_.entries.push_back(
          {fix.arrives_ns,
           {fix.time_ns, Source::USBL,
            PositionFix{fix.position, fix.covariance, placeOf(options_.usbl.mounting)}},
           kind});
  }

  void addSlow(const VehicleState& state, Stamp now) {
    if (now == 0) current_ = study_.current * command_noise_.normals();
    const Vector3d through_water =
        bodyTwist(state).linear - mapFromBase(state).linear().transpose() * current_;
    add(now, Source::COMMAND,
        CommandedVelocity{through_water + kCommandNoise * command_noise_.normals(), tape_.base});
    const double yaw = localization::yawOf(bodyState(state).attitude) + options_.imu.heading_error +
                       kHeadingNoise * heading_noise_.normal();
    add(now, Source::HEADING,
        HeadingFix{std::remainder(yaw, 2.0 * M_PI),
                   study_.filter.start_yaw * study_.filter.start_yaw});
  }

  // Without the biases.
  State bodyState(const VehicleState& vehicle) const {
    const Isometry3d pose = mapFromBase(vehicle) * body_from_base_.inverse();
    const simulation::BodyTwist twist = bodyTwist(vehicle);
    State state;
    state.position = pose.translation();
    state.attitude = Quaterniond(pose.linear());
    state.velocity = mapFromBase(vehicle).linear() *
                     (twist.linear + twist.angular.cross(body_from_base_.inverse().translation()));
    return state;
  }

  void addTruth(TapeInstant& instant) const {
    State truth = bodyState(drive_.stateAt(instant.time));
    truth.gyro_bias = imu_.gyroscopeBias();
    truth.accelerometer_bias = imu_.accelerometerBias();
    instant.truth = truth;
  }

  // The poses of all images; those of the two methods of one image arrive at once.
  void addImages() {
    Noise draws(seed_, Purpose::MARKERS), flips(seed_, Purpose::FLIPS);
    for (int frame = 0; frame < frameCount(study_); ++frame) {
      const double time = stampedTime(study_, set_, frame);
      const Stamp stamp = stampOf(time);
      tape_.instants.push_back({time, stamp, {}});
      for (const Method method : {Method::MEAN, Method::JOINT}) {
        const auto error = source_ == MarkerSource::SHOWN
                               ? errors_.shown(set_number_, method, frame)
                               : errors_.drawn(set_number_, method, frame, draws);
        const bool flipped = flips.even() < study_.flips;
        if (!error) continue;
        TapeEntry entry{stamp, {stamp, Source::MARKER, poseFix(frame, *error, false)}};
        entry.method = method;
        if (flipped) entry.flipped = poseFix(frame, *error, true);
        tape_.entries.push_back(entry);
      }
    }
  }

  // Of base_link in the map, as a camera has it whose place on the vehicle is a little off.
  PoseFix poseFix(int frame, const CameraError& error, bool flipped) const {
    Isometry3d panel_from_camera = errors_.truth(frame);
    panel_from_camera.translate(Vector3d(error.error.head<3>()));
    const Vector3d turn = error.error.tail<3>();
    panel_from_camera.rotate(localization::expSO3<double>(turn));
    if (flipped) panel_from_camera = flippedPose(panel_from_camera);
    const Isometry3d pose = study_.map_from_panel * panel_from_camera;
    localization::PoseCovariance into_map = localization::PoseCovariance::Identity();
    into_map.topLeftCorner<3, 3>() = pose.linear();
    const MountedPose camera{pose.translation(), Quaterniond(pose.linear()),
                             into_map * error.covariance * into_map.transpose()};
    const MountedPose base = carried(camera, mountingOf(saidBaseFromCamera().inverse()));
    return {base.position, base.attitude, base.covariance, tape_.base};
  }

  Isometry3d saidBaseFromCamera() const {
    Noise noise(seed_, Purpose::CAMERA);
    const Vector3d shift = set_.camera_offset * noise.normals().normalized();
    const Vector3d turn = set_.camera_turn * noise.normals().normalized();
    Isometry3d pose = study_.camera.mounting.pose() * simulation::opticalFrame();
    pose.pretranslate(shift);
    return pose.rotate(localization::expSO3<double>(turn));
  }

  const TrialStudy& study_;
  const ErrorSet& set_;
  std::size_t set_number_;
  int seed_;
  NavigationSensorOptions options_;
  PanelDrive drive_;
  const MarkerErrors& errors_;
  MarkerSource source_;
  simulation::Imu imu_;
  simulation::Dvl dvl_;
  simulation::PressureSensor pressure_;
  std::vector<std::pair<UsblKind, simulation::Usbl>> usbls_;
  Isometry3d body_from_base_;
  Noise command_noise_{seed_, Purpose::CURRENT}, heading_noise_{seed_, Purpose::HEADING};
  Vector3d current_ = Vector3d::Zero();  // m/s, map
  bool began_ = false;
  SensorTape tape_;
};

}  // namespace

double lastLook(const TrialStudy& study, const ErrorSet& set) {
  const Stamp end = (stepsOf(study.drive) + 1) * kStepNs;
  int frame = frameCount(study) - 1;
  while (frame > 0 && stampOf(stampedTime(study, set, frame)) >= end) --frame;
  return stampedTime(study, set, frame);
}

SensorTape recorded(const TrialStudy& study, const World& world, std::size_t set, int seed,
                    const MarkerErrors& errors, MarkerSource source) {
  return TapeRecorder(study, world, set, seed, errors, source).record();
}

}  // namespace grid_path_planner::trials
