// Files that say what a study flies and a trial drives.
#include "flights/flight_study.h"
#include "fuzz/fuzz_target.h"
#include "grid_path_planner/base/option_text.h"
#include "ros/localization/vehicle_localizer_options.h"
#include "trials/recorded_trial.h"
#include "trials/trial_study.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfFlightStudies() {
  const std::string begin =
      "title: Smoke\nworlds: [{pattern: \"course_%d.sdf\", seeds: [200, 202]}, a.sdf]\n"
      "start: [0, 0, 1.5, 0]\nroute: [[30, 10, 1.5]]\nfence: [0.6, 4]\nshortest: {a: 3.5}\n";
  return {begin +
              "vehicle: fuzz_vehicle.yaml\npilot: {max_speed: 2.0, z_max: 3.85}\n"
              "rules: [published, safe]\nconfigurations:\n"
              "  - {name: best, rules: [safe], flights: 2, first_seed: 7}\n"
              "  - {name: other, pilot: {program: [./fly, -v]}}\n",
          begin +
              "bodies:\n  - {name: b, shape: box, half_size: [1, 1, 1], "
              "track: [[0, 1, 2, 3], [5, 1, 2, 4]]}\nconfigurations: [{name: x}, {name: y}]\n"
              "published:\n  source: s\n  figures: {x: [1, 2, 3]}\n  pairs: [{pair: [x, y], p: [0, "
              "0.5]}]\n"
              "  conclusions: [{claim: c, pairs: [[x, y]]}]\n",
          "title: T\nworlds: [{pattern: \"%d.sdf\", seeds: [3e9, 3e9]}]\nstart: [0, 0, 1.5, 0]\n"
          "route: [[30, 10, 1.5]]\nconfigurations: [{name: a}]\n",
          begin + "configurations: [{name: x}]\npublished: {source: s, pairs: [{p: [0, 0.5]}]}\n",
          "title: T\nworlds: [{seeds: [1, 2]}]\n"};
}

FUZZ_TARGET(flight_study, seedsOfFlightStudies) {
  static const std::string vehicle =
      fileOf("fuzz_vehicle.yaml", "camera_width: 32\nvehicle_radius: 0.4\n");
  mayRefuse([&] {
    const flights::FlightStudy study = flights::readFlightFile(fileOf("fuzz_flights.yaml", input));
    mustHold(!study.worlds.empty() && !study.variants.empty() && !study.route.empty(),
             "there is something to fly");
  });
}

std::vector<std::string> seedsOfTrials() {
  return {
      "title: Smoke\nworld: a.sdf\nlayout: l.yaml\npanel: [4.05, -0.55, 2.9, 0.42]\n"
      "drive: {seconds: 60, arc: 0.8, range: [1.7, 3.3], away: [[20, 32]]}\nseeds: 2\nsettle: 5\n"
      "fault: [35, 45]\ncamera: {rate: 0.5, width: 320}\nsensors: {imu_enabled: true}\n"
      "error_sets:\n  - name: nominal\n"
      "  - {name: field, sensors: {imu_heading_error: 0.14}, camera_offset: 0.02}\n",
      "{title: T, world: a, layout: b, panel: [1, 2, 3, 4], outliers: 0.3, flips: 0.1, current: "
      "0.05,\n"
      "start_deviation: 0.05, default_covariance: [0.02, 0.01], filter: {gate: either}, markers: "
      "{},\n"
      "error_sets: [{name: a, focal_error: 0.01, corner_noise: 1}],\n"
      "published: {source: s, rows: {L2: [2, 0.9, 15, 7, 0.9]}, figures: {a: 1}}}\n"};
}

FUZZ_TARGET(trial_file, seedsOfTrials) {
  mayRefuse([&] {
    const trials::TrialStudy study = trials::readTrialFile(fileOf("fuzz_trial.yaml", input));
    mustHold(!study.sets.empty() && study.seeds >= 2, "there is something to drive");
    mustHold(study.fault.to <= study.drive.seconds, "what is lost is lost within the drive");
  });
}

std::vector<std::string> seedsOfRecordedTrials() {
  return {
      "title: Dive\nbag: dive.bag\ntopics: {imu: rexrov/imu, dvl: dvl, truth: /pose_gt}\n"
      "frames:\n  dvl_link: [0.1, 0, -0.3, 0, 0, 1.57]\nlocalizer: {use_heading: true}\n"
      "settle: 20\nstart_deviation: 0.1\npublished: {source: s, rows: {L2: [2, 0.9, 15, 7, "
      "0.9]}}\n",
      "{title: D, bag: b, truth_frame: truth, localizer: {gate: either, map_frame: world}}\n"};
}

// As `grid_path localization` does it.
FUZZ_TARGET(recorded_trial, seedsOfRecordedTrials) {
  mayRefuse([&] {
    const std::string file = fileOf("fuzz_recorded.yaml", input);
    if (!trials::isRecordedTrial(file)) return;
    nodes::VehicleLocalizerOptions options;
    const auto trial =
        trials::readRecordedTrialFile(file, [&](const std::string& name, const std::string& text) {
          return base::setOption(options, name, text);
        });
    checkVehicleLocalizerOptions(options);
    for (const auto& [name, place] : trial.frames)
      mustHold(place.position.allFinite(), "a frame is somewhere");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
