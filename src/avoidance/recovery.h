// What is done when there is no progress: look around, then plan on the map, then give up.
//
//   FLYING --no progress--> LOOKING --turned once--> FLYING --no progress--> PLAN asked --> FLYING along it
//                                                                                |
//   a metre gained: from the beginning                                none, or no progress: STUCK
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "avoidance/progress_watch.h"
#include "grid_path_planner/avoidance/pilot_options.h"

namespace grid_path_planner::avoidance {

enum class RecoveryStep { FLY, LOOK, PLAN, STUCK };
enum class MapAnswer { PATH, NO_PATH, NO_MAP };

class Recovery {
 public:
  void restart(double time, const Eigen::Vector3d& position, const Eigen::Vector3d& goal);

  struct State {
    double time;
    Eigen::Vector3d position;
    double yaw;
    Eigen::Vector3d goal;
    bool exhausted;  // every direction was looked at, and there is none
  };
  // PLAN until the caller says by `planned` what came of it.
  RecoveryStep update(const State& state, const PilotOptions& options);
  void planned(MapAnswer answer, double time);
  // The last `seconds` were none in which progress could be made.
  void hold(double seconds);

  // m, from the goal, in this flight to it.
  double nearest() const { return watch_.nearest(); }
  // "looked around, planned on the map"; "nothing" before. Without a map it says so.
  std::string tried() const;

 private:
  bool noProgress(const State& state, const PilotOptions& options) const;
  RecoveryStep look(const State& state, const PilotOptions& options);

  ProgressWatch watch_;
  RecoveryStep step_ = RecoveryStep::FLY;
  bool looked_ = false, planned_ = false, has_map_ = true;
  double turned_ = 0.0;       // rad, anticlockwise
  double looks_since_ = 0.0;  // s
  std::optional<double> yaw_;
  std::optional<double> exhausted_since_;
};

}  // namespace grid_path_planner::avoidance
