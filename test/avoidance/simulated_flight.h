// A pilot in a simulated world: camera, odometry, vehicle and pilot in lock-step, without a clock.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/avoidance/pilot.h"
#include "grid_path_planner/simulation/dead_reckoning.h"
#include "grid_path_planner/simulation/depth_camera.h"
#include "grid_path_planner/simulation/moving_bodies.h"
#include "grid_path_planner/simulation/vehicle.h"
#include "grid_path_planner/simulation/world.h"

namespace grid_path_planner::avoidance {

using simulation::World;

struct FlightSetup {
  std::shared_ptr<const World> world;
  std::shared_ptr<const simulation::MovingBodies> bodies = {};
  PilotOptions options;
  Eigen::Vector3d start = Eigen::Vector3d(0.0, 0.0, 1.5);
  double yaw = 0.0;
  std::vector<Eigen::Vector3d> waypoints = {};
  int width = 80, height = 60;  // pixels
  double horizontal_fov = 1.3003;
  int seed = 1;
  double seconds = 120.0;    // longest
  double last_frame = 1e9;   // s, after which the camera is cut
  double focal_error = 1.0;  // of the intrinsics
  int false_points = 0;      // in each frame
  bool tracks = true;        // whether the result holds the track
  MapPlan map_plan = {};
  // Called before each update: what the pilot is told instead.
  std::function<void(PilotInput&)> alter = {};
  // Called after each update, with the truth.
  std::function<void(const PilotInput&, const PilotAnswer&, const simulation::VehicleState&,
                     const Pilot&)>
      each = {};
};

struct FlightResult {
  PilotStatus status = PilotStatus::IDLE;
  std::string sentence = {};
  double seconds = 0.0;
  double metres = 0.0;           // of the truth
  double least_clearance = 1e9;  // m, of the truth, to solid surfaces
  int contacts = 0;
  int contacts_moving = 0;  // that began while the vehicle moved
  double turned = 0.0;      // rad
  std::string touched = {};
  std::vector<Eigen::Vector3d> track = {};
};

// The vehicle of config/multirotor.yaml.
inline simulation::VehicleOptions multirotor() {
  simulation::VehicleOptions options;
  options.max_surge_speed = options.max_sway_speed = 2.0;
  options.max_heave_speed = 1.0;
  options.max_yaw_rate = 0.5236;
  options.max_acceleration = 2.0;
  options.response_time = 0.15;
  options.vehicle_radius = 0.3;
  return options;
}

inline PilotOptions flyingOptions() {
  PilotOptions options;
  options.no_return_clears = 10.0;
  options.z_min = 0.6;
  options.z_max = 4.0;
  return options;
}

class SimulatedFlight {
 public:
  explicit SimulatedFlight(FlightSetup setup)
      : setup_(std::move(setup)),
        camera_(*setup_.world, cameraOptions(setup_)),
        vehicle_(multirotor(), startState(setup_)),
        odometry_(odometryOptions(setup_)),
        pilot_(setup_.options) {
    vehicle_.setWorld(setup_.world);
    if (setup_.bodies) vehicle_.setBodies(setup_.bodies);
    odometry_.reset(vehicle_.state());
    pilot_.setMapPlan(setup_.map_plan);
    pilot_.setRoute(setup_.waypoints);
  }

  // What the pilot's updates with a frame will have taken by `clock`; for benchmarks.
  std::vector<double>& frameMilliseconds(double (*clock)()) {
    clock_ = clock;
    return milliseconds_;
  }

  FlightResult run() {
    const int updates = static_cast<int>(setup_.seconds / kUpdate);
    for (int i = 0; i < updates && !isOver(); ++i) {
      update(i % 2 == 0 && vehicle_.time() < setup_.last_frame);
      for (int k = 0; k < 5; ++k) step();
    }
    result_.seconds = vehicle_.time();
    result_.contacts = vehicle_.contacts();
    result_.touched = vehicle_.touched();
    return result_;
  }

 private:
  static constexpr double kUpdate = 0.05;  // s

  static simulation::DepthCameraOptions cameraOptions(const FlightSetup& setup) {
    simulation::DepthCameraOptions options;
    options.width = setup.width;
    options.height = setup.height;
    options.horizontal_fov = setup.horizontal_fov;
    options.seed = setup.seed;
    return options;
  }
  static simulation::DeadReckoningOptions odometryOptions(const FlightSetup& setup) {
    simulation::DeadReckoningOptions options;
    options.odometry_noise = 0.02;
    options.odometry_drift = 0.01;
    options.odometry_seed = setup.seed;
    return options;
  }
  static simulation::VehicleState startState(const FlightSetup& setup) {
    return {setup.start, setup.yaw, {}};
  }

  bool isOver() const {
    return result_.status == PilotStatus::ARRIVED || result_.status == PilotStatus::STUCK;
  }

  void update(bool with_frame) {
    const simulation::VehicleState measured = odometry_.measured();
    PilotInput input;
    input.time = vehicle_.time();
    input.pose = VehiclePose{measured.position, measured.yaw};
    input.velocity = measured.velocity;
    if (with_frame) input.frame = &see(measured);
    if (setup_.alter) setup_.alter(input);
    const double before = clock_ != nullptr ? clock_() : 0.0;
    const PilotAnswer answer = pilot_.update(input);
    if (clock_ != nullptr && with_frame) milliseconds_.push_back(clock_() - before);
    result_.status = answer.status;
    result_.sentence = answer.sentence;
    if (setup_.each) setup_.each(input, answer, vehicle_.state(), pilot_);
    vehicle_.command(answer.velocity);
  }

  static Eigen::Isometry3d poseOf(const simulation::VehicleState& state) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translate(state.position);
    pose.rotate(Eigen::AngleAxisd(state.yaw, Eigen::Vector3d::UnitZ()));
    return pose;
  }

  const Frame& see(const simulation::VehicleState& measured) {
    const auto intrinsics = camera_.intrinsics();
    const simulation::BodiesAt bodies =
        setup_.bodies ? setup_.bodies->at(vehicle_.time()) : simulation::BodiesAt();
    camera_.render(poseOf(vehicle_.state()) * camera_.baseFromOptical(), frames_++, frame_.points,
                   bodies);
    frame_.time = vehicle_.time();
    frame_.map_from_sensor = poseOf(measured) * camera_.baseFromOptical();
    frame_.width = setup_.width;
    frame_.height = setup_.height;
    frame_.pinhole = Pinhole{setup_.focal_error * intrinsics.fx, setup_.focal_error * intrinsics.fy,
                             intrinsics.cx, intrinsics.cy};
    addFalsePoints();
    return frame_;
  }

  // On the rays of their pixels, anywhere.
  void addFalsePoints() {
    std::uniform_real_distribution<float> depth(0.3F, 9.0F);
    std::uniform_int_distribution<int> pixels(0, static_cast<int>(frame_.pixels()) - 1);
    const auto intrinsics = camera_.intrinsics();
    for (int i = 0; i < setup_.false_points; ++i) {
      const int pixel = pixels(random_);
      const float z = depth(random_);
      float* point = &frame_.points[3 * static_cast<std::size_t>(pixel)];
      point[0] = z * static_cast<float>((pixel % frame_.width - intrinsics.cx) / intrinsics.fx);
      point[1] = z * static_cast<float>((pixel / frame_.width - intrinsics.cy) / intrinsics.fy);
      point[2] = z;
    }
  }

  void step() {
    const simulation::VehicleState before = vehicle_.state();
    const int contacts = vehicle_.contacts();
    vehicle_.step();
    odometry_.advance(vehicle_.state());
    const simulation::VehicleState& now = vehicle_.state();
    result_.metres += (now.position - before.position).norm();
    result_.turned += std::abs(std::remainder(now.yaw - before.yaw, 2.0 * M_PI));
    const Eigen::Vector3d speed(before.velocity.surge, before.velocity.sway, before.velocity.heave);
    if (vehicle_.contacts() > contacts && speed.norm() > 0.1) ++result_.contacts_moving;
    if (const auto surface = setup_.world->nearest(now.position, 3.0))
      result_.least_clearance = std::min(result_.least_clearance, surface->distance);
    if (setup_.tracks) result_.track.push_back(now.position);
  }

  FlightSetup setup_;
  simulation::DepthCamera camera_;
  simulation::Vehicle vehicle_;
  simulation::DeadReckoning odometry_;
  Pilot pilot_;
  Frame frame_;
  FlightResult result_;
  double (*clock_)() = nullptr;
  std::vector<double> milliseconds_;
  std::uint64_t frames_ = 0;
  std::mt19937 random_{7};
};

inline FlightResult fly(FlightSetup setup) {
  return SimulatedFlight(std::move(setup)).run();
}

}  // namespace grid_path_planner::avoidance
