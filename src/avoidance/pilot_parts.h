// The pilot's parts and the order in which they act: see grid_path_planner/avoidance/pilot.h.
#pragma once

#include <optional>
#include <string>

#include "avoidance/memory/surroundings.h"
#include "avoidance/recovery.h"
#include "avoidance/route.h"
#include "avoidance/search/path_finder.h"
#include "avoidance/steering/steering.h"
#include "avoidance/steering/unseen_places.h"
#include "grid_path_planner/avoidance/pilot.h"

namespace grid_path_planner::avoidance {

class Pilot::Parts {
 public:
  explicit Parts(const PilotOptions& wanted) : options(wanted), finder(wanted) {}

  PilotAnswer update(const PilotInput& input);
  void see(const Frame& frame);
  void start();
  void end(PilotStatus status, const std::string& sentence);
  PilotAnswer answer() const;
  const Eigen::Vector3d& position() const { return motion_.position; }

  PilotOptions options;
  Surroundings surroundings;
  Route route, plan;  // the plan on the map to the route's waypoint, where that is followed
  PathFinder finder;
  FlownPath flown;
  Recovery recovery;
  UnseenPlaces unseen;
  MapPlan map_plan;

 private:
  void setTime(double time);
  bool cannotFly(const PilotInput& input);
  bool hasFrame(const std::string& cloud_problem);
  void followRoute();
  void findPath();
  std::optional<Eigen::Vector3d> beyond(const std::vector<Eigen::Vector3d>& path) const;
  void fly(const PilotInput& input);
  void hover(PilotStatus status, const std::string& sentence);
  void hold(PilotStatus status, const std::string& sentence);
  bool recovers();
  void askForPlan();
  void noteNarrow();
  bool goalIsOccupied() const;
  void lookAtUnseen(const Steering& steering);
  Steering steer() const;
  void describe(const Steering& steering);
  std::string closedText(const Eigen::Vector3d& at) const;
  Eigen::Vector3d target() const;
  double targetRadius() const;

  PilotStatus status_ = PilotStatus::IDLE;
  std::string sentence_ = "nothing was asked for yet";
  RecoveryStep step_ = RecoveryStep::FLY;
  std::string narrow_;      // of the newest look around, "; the passage at ... is 1.1 m wide"
  bool ended_ = false;      // the status stays until a new route
  bool restarts_ = false;   // the next pose begins the path to a waypoint
  bool kept_ = false;       // the path leads to the present target
  bool fresh_ = false;      // the newest update brought a frame
  int told_path_ = 0;       // the revision of the path that was answered last
  int frames_without_ = 0;  // since the last search that found no path
  double time_ = 0.0, elapsed_ = 0.0;  // s; since the update before
  bool has_time_ = false;
  Motion motion_;
  base::BodyVelocity command_;
  double clear_path_ = 0.0;
};

}  // namespace grid_path_planner::avoidance
