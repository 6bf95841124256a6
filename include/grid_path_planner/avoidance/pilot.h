// Flies a vehicle to waypoints through space of which there is no map: from where it is and what it
// sees to the velocity that it should have.
//
//   Pilot pilot(options);
//   pilot.setRoute({{30.0, 10.0, 1.5}, {0.0, 0.0, 1.5}});      // throws InputError
//   // at any rate, with a frame whenever there is a new one:
//   const PilotAnswer answer = pilot.update({time, pose, velocity, &frame});
//   vehicle.command(answer.velocity);
//
// The pilot remembers what it saw in a window of voxels that travels along, plans a path on that with
// every frame, and flies along it. Under the rules `safe` it is guaranteed: the ball of radius d_safe
// about every point of the path that is flown, and about every point of the path that braking takes, was
// seen and holds no remembered point; what was never seen or too long ago is closed (exceptions:
// start_clear about the start, and what is nearer than 2 m does not age; a vehicle that is nearer than
// d_safe to a point already moves only away from it, slowly). The speed v obeys
// v (frame_period + response_time) + v^2 / (2 max_acceleration) <= clear_path. Limits of speed and turn
// are never exceeded; the velocity is zero in every status but FLYING and BLOCKED, where it may turn.
// The same calls give the same answers, bit for bit; no clock is read. Not guaranteed: that nothing runs
// into a vehicle; that a path is found where there is one.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/avoidance/frame.h"
#include "grid_path_planner/avoidance/pilot_options.h"
#include "grid_path_planner/base/body_velocity.h"

namespace grid_path_planner::avoidance {

// Whether nothing is known by the frame: no point within range_min to range_max, and no rays of a picture that no_return_clears
// lets stand for space. Such a sensor is lost, not free of obstacles.
bool isBlind(const Frame& frame, const PilotOptions& options);

enum class PilotStatus {
  IDLE,  // nothing was asked for yet
  FLYING,
  ARRIVED,
  BLOCKED,
  STUCK,
  NO_CLOUD,
  TRANSFORM_ERROR,
  GOAL_OCCUPIED,
  CANCELLED,
};
// The enumerator's own name.
const char* toString(PilotStatus status);

struct VehiclePose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m, map frame
  double yaw = 0.0;                                    // rad
};

struct PilotInput {
  double time = 0.0;                 // s; must not decrease
  std::optional<VehiclePose> pose;   // none where it is not known now
  base::BodyVelocity velocity = {};  // as measured
  const Frame* frame = nullptr;      // the newest, if it is new
  std::string pose_problem = {};     // why there is no pose, in a sentence
  std::string hold = {};             // why it is to stand now, in a sentence; empty: it flies
  std::string cloud_problem =
      {};  // why it must not fly on what it saw, in a sentence; empty: it may
};

struct PilotAnswer {
  base::BodyVelocity velocity = {};  // to command
  PilotStatus status = PilotStatus::IDLE;
  std::string sentence = {};  // about the status, with its values
  double clearance = 0.0;     // m from the vehicle to the nearest remembered point; at most 12
  double clear_path = 0.0;    // m of the path that may be flown now
  double frame_age = 0.0;     // s, of the newest frame; infinite before the first
  int waypoint = 0;           // index of the one that is flown to
  bool new_path = false;      // path() is another than before
};

// A path from the vehicle to a goal on a map that someone else keeps; empty where there is none, none while
// it is not known yet: it is asked again with the next update, for the same.
using MapPlan = std::function<std::optional<std::vector<Eigen::Vector3d>>(
    const Eigen::Vector3d& from, const Eigen::Vector3d& goal)>;

// A remembered point, and when it was last seen.
struct RememberedPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m, map frame
  double time = 0.0;                                   // s
};

// What is about the vehicle in a direction: the distance to the nearest remembered point in each bin,
// infinite where there is none. Row 0 looks straight down, column 0 along -x of the map, columns go on
// anticlockwise.
struct HistogramView {
  int columns = 0;
  int rows = 0;
  std::vector<float> distances = {};  // m, row by row
};

class Pilot {
 public:
  // Throws InputError for options that checkPilotOptions refuses.
  explicit Pilot(const PilotOptions& options = {});
  ~Pilot();

  // From the next update on; a change of `rules` or `memory` forgets nothing. Throws InputError, then
  // nothing has changed.
  void setOptions(const PilotOptions& options);
  const PilotOptions& options() const;

  // Flies to these points (m, map frame), one after the other, instead of what was flown before. Throws
  // InputError naming the point for none, one that is not finite, beyond 1e6 m, or outside the fence; then
  // the flight before goes on.
  void setRoute(const std::vector<Eigen::Vector3d>& waypoints);
  // The same along a path from outside: its points are passed, not arrived at, and left out where they
  // are occupied.
  void setPath(const std::vector<Eigen::Vector3d>& path);
  // Asked once it makes no progress and `recover` is set; none: there is no map.
  void setMapPlan(MapPlan plan);
  // `reason` goes into the sentence.
  void cancel(const std::string& reason);
  // All that was seen; the next pose is a new start.
  void forget();

  PilotAnswer update(const PilotInput& input);
  // One more frame, of another sensor, to be seen before the next update; it may be older than the newest,
  // by at most cloud_timeout.
  void see(const Frame& frame);

  // The path that is flown, from where the vehicle was when it was planned; empty where there is none.
  const std::vector<Eigen::Vector3d>& path() const;
  // Of the present status: what is flown to, what closes the path, what was tried.
  std::string explain() const;
  std::vector<RememberedPoint> rememberedPoints() const;
  HistogramView histogram() const;
  // Whether the ball of radius d_safe about a point was seen and is empty, as the rules `safe` mean it.
  bool isOpen(const Eigen::Vector3d& point) const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace grid_path_planner::avoidance
