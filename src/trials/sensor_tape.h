// All measurements of one run, in the order in which they arrive, and the truth beside them.
//
//   const SensorTape tape = recorded(study, world, set, seed, errors, MarkerSource::DRAWN);
//   for (const TapeEntry& entry : tape.entries) if (wants(entry)) filter.add(entry.measurement);
//
// Every row of a run is played the same tape, and takes of it what it is given. The body frame is the IMU's.
// Guaranteed: the same study, set and seed give the same tape, bit for bit.
#pragma once

#include <optional>
#include <vector>

#include "grid_path_planner/simulation/world.h"
#include "localization/measurement.h"
#include "trials/marker_errors.h"
#include "trials/trial_rows.h"

namespace grid_path_planner::trials {

struct TapeEntry {
  localization::Stamp arrives = 0;
  localization::Measurement measurement;
  UsblKind usbl = UsblKind::NONE;                     // of a USBL fix: of which kind
  Method method = Method::MEAN;                       // of a marker pose
  std::optional<localization::PoseFix> flipped = {};  // what the rows with flips have instead
};

// When the estimate is looked at: as often as the camera looks, at the time at which its image arrives.
struct TapeInstant {
  double time = 0.0;  // s
  localization::Stamp stamp = 0;
  std::optional<localization::State> truth =
      {};  // of the body, biases included; none: nobody knows
};

struct SensorTape {
  std::vector<TapeEntry> entries;
  std::vector<TapeInstant> instants;
  localization::Mounting base;  // base_link in the body frame
};

// Poses that the images themselves showed, or drawn from their errors.
enum class MarkerSource { SHOWN, DRAWN };

// When a run of this error set is looked at last, s: its last image that comes before the drive is over.
double lastLook(const TrialStudy& study, const ErrorSet& set);

SensorTape recorded(const TrialStudy& study, const simulation::World& world, std::size_t set,
                    int seed, const MarkerErrors& errors, MarkerSource source);

}  // namespace grid_path_planner::trials
