// A study of flights: worlds x configurations of the pilot x seeds.
//
//   FlightStudy study = readFlightFile("config/flights_rescue.yaml");
//
// A *variant* is a configuration under rules (published, safe). A seed shifts the start and draws all noise,
// so flights of one seed differ in nothing but the variant.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "grid_path_planner/avoidance/pilot_options.h"
#include "grid_path_planner/simulation/dead_reckoning.h"
#include "grid_path_planner/simulation/depth_camera_options.h"
#include "grid_path_planner/simulation/moving_bodies.h"
#include "grid_path_planner/simulation/vehicle_options.h"

namespace grid_path_planner::flights {

struct FlightWorld {
  std::string name;
  std::string file;
};

struct FlightVariant {
  std::string name;  // "LHLM"
  avoidance::PilotOptions pilot;
  std::vector<std::string>
      program;  // with its arguments, flies instead of the pilot; empty: the pilot
  int first_seed = 1;
  int flights = 1;

  std::string rules() const { return base::choiceName(pilot.rules); }
  std::string label() const { return name + ' ' + rules(); }
};

// "LHLM safe on rescue_course", of which the name of a file is made.
inline std::string pictureTitle(const FlightVariant& variant, const FlightWorld& world) {
  return variant.label() + " on " + world.name;
}

// Of one configuration, as published.
struct PublishedFlights {
  double time_s = 0.0;
  double length_m = 0.0;
  double success_percent = 0.0;
};

// Two configurations, of which the second is said to be better.
struct ComparedPair {
  std::string worse;
  std::string better;

  bool operator==(const ComparedPair& other) const {
    return worse == other.worse && better == other.better;
  }
};

// With the p-values that were printed, 0 for "0".
struct PublishedPair {
  ComparedPair pair;
  double time_p = 1.0;
  double length_p = 1.0;
};

// What was concluded: every pair's second configuration is faster, shorter and safer.
struct PublishedConclusion {
  std::string claim;
  std::vector<ComparedPair> pairs;
};

struct FlightStudy {
  std::string file;
  std::string title;
  std::vector<FlightWorld> worlds;
  std::vector<FlightVariant> variants;
  std::vector<simulation::MovingBody> bodies;

  simulation::VehicleOptions vehicle;
  simulation::DepthCameraOptions camera;
  simulation::DeadReckoningOptions odometry;
  double command_rate = 20.0;  // Hz

  Eigen::Vector3d start = Eigen::Vector3d::Zero();  // m, map frame
  double start_yaw = 0.0;                           // rad
  double start_shift = 0.0;                         // m: the start lies within this of `start`
  double yaw_shift = 0.0;                           // rad
  std::vector<Eigen::Vector3d> route;               // m
  double fence_low = -1e4, fence_high = 1e4;        // m
  double time_limit = 300.0;                        // s
  std::map<std::string, double> shortest;           // L* of worlds, m

  std::string published_source;
  std::map<std::string, PublishedFlights> published;  // by configuration
  std::vector<PublishedPair> pairs;
  std::vector<PublishedConclusion> conclusions;
};

// File names in it are relative to its folder. Throws InputError naming file and line.
FlightStudy readFlightFile(const std::string& file);

}  // namespace grid_path_planner::flights
