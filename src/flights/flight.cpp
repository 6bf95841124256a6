#include "flights/flight.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "flights/flight_pilot.h"
#include "flights/flight_steps.h"
#include "flights/sight_audit.h"
#include "grid_path_planner/simulation/vehicle.h"
#include "study/fingerprint.h"

namespace grid_path_planner::flights {

using avoidance::Frame, avoidance::PilotAnswer, avoidance::PilotInput, avoidance::PilotStatus,
    avoidance::Pinhole, avoidance::VehiclePose;
using base::InputError;
using Eigen::Isometry3d, Eigen::Vector3d;
using simulation::DeadReckoning, simulation::DeadReckoningOptions, simulation::Vehicle,
    simulation::VehicleState;

namespace {

constexpr double kDriftSlack = 0.5;    // m: how far the truth may lie from where odometry arrived
constexpr double kFarClearance = 3.0;  // m, and more
constexpr double kPathEvery = 0.2;     // s

double cpuMs() {
  timespec now;
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

VehicleState startOf(const FlightStudy& study, int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  const auto even = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  const double radius = study.start_shift * std::sqrt(even()), angle = 2.0 * M_PI * even();
  VehicleState state;
  state.position = study.start + radius * Vector3d(std::cos(angle), std::sin(angle), 0.0);
  state.yaw = study.start_yaw + study.yaw_shift * (2.0 * even() - 1.0);
  return state;
}

DeadReckoningOptions odometryOf(const FlightStudy& study, int seed) {
  DeadReckoningOptions options = study.odometry;
  options.odometry_seed = seed;
  return options;
}

bool gaveUp(PilotStatus status) {
  return status == PilotStatus::STUCK || status == PilotStatus::GOAL_OCCUPIED ||
         status == PilotStatus::CANCELLED || status == PilotStatus::TRANSFORM_ERROR;
}

class Flight {
 public:
  Flight(const FlightSetup& setup, std::size_t variant, int seed, const std::string& log,
         const FlightWatch& watch)
      : setup_(setup),
        study_(setup.study()),
        variant_(study_.variants[variant]),
        start_(startOf(study_, seed)),
        vehicle_(study_.vehicle, start_),
        odometry_(odometryOf(study_, seed)),
        audit_(*setup.world(), study_.camera, study_.vehicle.vehicle_radius, start_.position,
               variant_.pilot.start_clear),
        pilot_(makeFlightPilot(study_, variant_, setup.camera().intrinsics(), log)),
        steps_(flightSteps(study_)),
        first_frame_(static_cast<std::uint64_t>(seed) << 32),
        watch_(watch) {
    vehicle_.setWorld(setup.world());
    vehicle_.setBodies(setup.bodies());
    odometry_.reset(start_);
    record_.variant = variant;
    record_.world = setup.worldNumber();
    record_.seed = seed;
    record_.clearance_m = kFarClearance;
  }

  FlightRecord fly() {
    const auto steps = static_cast<long>(std::lround(study_.time_limit / study_.vehicle.time_step));
    for (long step = 0; step < steps && !ended_; ++step) {
      if (step % steps_.command == 0) command(step);
      if (!ended_) advance();
    }
    if (!ended_) end(FlightEnd::TIMEOUT, "the limit of time");
    finish();
    return record_;
  }

 private:
  void end(FlightEnd how, const std::string& sentence) {
    ended_ = true;
    record_.end = how;
    record_.sentence = sentence;
  }

  // A frame at the measured pose of this moment, rendered from the true one.
  const Frame& takeFrame(long step, const VehicleState& measured) {
    const Isometry3d base_from_optical = setup_.camera().baseFromOptical();
    const VehicleState& truth = vehicle_.state();
    const Isometry3d seen_from = mapFromBase(truth) * base_from_optical;
    frame_.time = vehicle_.time();
    frame_.map_from_sensor = mapFromBase(measured) * base_from_optical;
    frame_.width = study_.camera.width;
    frame_.height = study_.camera.height;
    const simulation::CameraIntrinsics pinhole = setup_.camera().intrinsics();
    frame_.pinhole = Pinhole{pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy};
    const double before = cpuMs();
    setup_.camera().render(seen_from, first_frame_ + static_cast<std::uint64_t>(step),
                           frame_.points, setup_.bodies()->at(vehicle_.time()));
    camera_ms_ += cpuMs() - before;
    audit_.see(seen_from);
    return frame_;
  }

  void command(long step) {
    const VehicleState measured = odometry_.measured();
    const bool with_frame = step % steps_.frame == 0;
    PilotInput input;
    input.time = vehicle_.time();
    input.pose = VehiclePose{measured.position, measured.yaw};
    input.velocity = measured.velocity;
    if (with_frame) input.frame = &takeFrame(step, measured);
    ask(input);
    if (!audit_.seen(vehicle_.state().position)) ++record_.unseen;
    measureClearance();
  }

  void ask(const PilotInput& input) {
    try {
      const double before = cpuMs();
      const PilotAnswer answer = pilot_->update(input);
      if (input.frame != nullptr) update_ms_.push_back(cpuMs() - before);
      ++record_.updates;
      if (watch_) watch_(input, answer);
      vehicle_.command(answer.velocity);
      judge(answer);
      hash(answer.velocity);
    } catch (const InputError& error) {
      end(FlightEnd::FAILED, error.what());
    }
  }

  void hash(const base::BodyVelocity& velocity) {
    for (const double number : {velocity.surge, velocity.sway, velocity.heave, velocity.yaw_rate})
      bits_.addNumber(number);
    const VehicleState& truth = vehicle_.state();
    for (int axis = 0; axis < 3; ++axis) bits_.addNumber(truth.position[axis]);
    bits_.addNumber(truth.yaw);
  }

  void judge(const PilotAnswer& answer) {
    if (answer.status == PilotStatus::ARRIVED) {
      const double offset = (vehicle_.state().position - study_.route.back()).norm();
      const bool home = record_.waypoints == static_cast<int>(study_.route.size()) &&
                        offset <= variant_.pilot.home_radius + kDriftSlack;
      end(home ? FlightEnd::HOME : FlightEnd::LOST, answer.sentence);
    } else if (gaveUp(answer.status)) {
      end(FlightEnd::STUCK, answer.sentence);
    }
  }

  void measureClearance() {
    const Vector3d& at = vehicle_.state().position;
    if (const auto surface = setup_.world()->nearest(at, record_.clearance_m))
      record_.clearance_m = surface->distance;
    if (const auto body = setup_.bodies()->at(vehicle_.time()).nearest(at, record_.clearance_m))
      record_.clearance_m = body->distance;
  }

  void advance() {
    const Vector3d before = vehicle_.state().position;
    const double speed = speedNow();
    vehicle_.step();
    const Vector3d& now = vehicle_.state().position;
    odometry_.advance(vehicle_.state());
    record_.length_m += (now - before).norm();
    record_.max_speed = std::max(record_.max_speed, speed);
    if (vehicle_.time() >= next_place_) {
      record_.path.push_back(now.cast<float>());
      next_place_ += kPathEvery;
    }
    passWaypoints();
    record_.speed = speed;
    if (vehicle_.contacts() > 0)
      end(FlightEnd::CONTACT, vehicle_.touched());
    else if (now.z() < study_.fence_low || now.z() > study_.fence_high)
      end(FlightEnd::FENCE, now.z() < study_.fence_low ? "below the fence" : "above the fence");
  }

  double speedNow() const {
    const base::BodyVelocity& v = vehicle_.state().velocity;
    return std::sqrt(v.surge * v.surge + v.sway * v.sway + v.heave * v.heave);
  }

  void passWaypoints() {
    const auto next = static_cast<std::size_t>(record_.waypoints);
    if (next < study_.route.size() && (vehicle_.state().position - study_.route[next]).norm() <=
                                          variant_.pilot.arrival_radius + kDriftSlack)
      ++record_.waypoints;
  }

  void finish() {
    record_.at = vehicle_.state().position;
    record_.path.push_back(record_.at.cast<float>());
    record_.time_s = vehicle_.time();
    record_.home_offset_m = (record_.at - study_.route.back()).norm();
    record_.bits = bits_.value();
    if (record_.end == FlightEnd::STUCK && record_.sentence.empty())
      record_.sentence = pilot_->explain();
    if (update_ms_.empty()) return;
    std::sort(update_ms_.begin(), update_ms_.end());
    double sum = 0.0;
    for (const double ms : update_ms_) sum += ms;
    const auto frames = static_cast<double>(update_ms_.size());
    record_.cost = {sum / frames, update_ms_[update_ms_.size() * 99 / 100], update_ms_.back(),
                    camera_ms_ / frames};
  }

  const FlightSetup& setup_;
  const FlightStudy& study_;
  const FlightVariant& variant_;
  VehicleState start_;
  Vehicle vehicle_;
  DeadReckoning odometry_;
  SightAudit audit_;
  std::unique_ptr<FlightPilot> pilot_;
  FlightSteps steps_;
  std::uint64_t first_frame_;
  const FlightWatch& watch_;
  Frame frame_;
  FlightRecord record_;
  study::Fingerprint bits_;  // of what the vehicle did
  std::vector<double> update_ms_;
  double camera_ms_ = 0.0;
  double next_place_ = 0.0;  // s
  bool ended_ = false;
};

}  // namespace

FlightSetup::FlightSetup(const FlightStudy& study, std::size_t world)
    : study_(study),
      number_(world),
      world_(std::make_shared<const simulation::World>(
          simulation::readWorld(study.worlds[world].file, base::ReadLimits::ofProcessorTime()))),
      bodies_(std::make_shared<const simulation::MovingBodies>(study.bodies)),
      camera_(*world_, study.camera) {}

FlightRecord fly(const FlightSetup& setup, std::size_t variant, int seed, const std::string& log,
                 const FlightWatch& watch) {
  return Flight(setup, variant, seed, log, watch).fly();
}

}  // namespace grid_path_planner::flights
