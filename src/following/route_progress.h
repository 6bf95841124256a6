// How far a drive has come along its path: which waypoints were reached or missed, and what is next.
//
//   RouteProgress progress(path, Join::NEAREST, options, events);
//   progress.join(pose);                               // the route starts at the vehicle
//   if (const auto ending = progress.advance(pose, time)) use(*ending);  // arrived, or failed
//   controller.follow(progress.position(pose.position), pose, seconds, 1.0);
//
// Guaranteed: every waypoint is reported as reached or as missed, once in a lap, or lies before the
// point where the path was joined.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "following/follow_events.h"
#include "following/velocity_controller.h"

namespace grid_path_planner::following {

// How a drive ended.
struct DriveEnd {
  FollowState state;
  DriveStatus status;
  std::string message;
};

class RouteProgress {
 public:
  // `options` and `events` must outlive this. The path loops where the options say so now.
  RouteProgress(path::Path path, Join join, const FollowerOptions& options, FollowEvents& events);

  const path::Path& path() const { return path_; }
  int currentWaypoint() const { return current_waypoint_; }
  std::string currentName() const { return waypointName(current_waypoint_, path_); }
  const std::vector<int>& missed() const { return missed_; }

  bool joined() const { return route_ != nullptr; }
  // Starts the route at `vehicle`.
  void join(const path::Pose& vehicle);
  // After a change of the options.
  void updateRoute();

  // What follows needs a joined route.

  // Goes to the next segment as often as the end of the present one has been reached or passed, and
  // watches for progress.
  std::optional<DriveEnd> advance(const path::Pose& vehicle, double time);
  // The vehicle does not drive: this time does not count as lack of progress ...
  void restartProgress() { progress_since_.reset(); }
  // ... nor as time spent at a stop.
  void restartSettling() { settled_since_.reset(); }

  RoutePosition position(const Eigen::Vector3d& vehicle) const;
  // From `vehicle` straight to the nearest point of the route, at most `distance` metres, and where
  // that is reached the route from there on, `distance` metres of it.
  std::vector<Eigen::Vector3d> ahead(const Eigen::Vector3d& vehicle, double distance) const;
  // Metres along the path to its end, of this lap in a loop.
  double distanceRemaining(const Eigen::Vector3d& vehicle) const;
  // Seconds until then, by the limits of speed (driving_time.h).
  double timeRemaining(const Eigen::Vector3d& vehicle) const;

 private:
  std::optional<DriveEnd> passWaypoints(const path::Pose& vehicle, double time);
  std::size_t endOfLap() const;
  bool isSettled(const path::Pose& vehicle, double time);
  bool isPassed(const Eigen::Vector3d& position) const;
  bool retry(const path::Pose& vehicle, int waypoint);
  std::optional<DriveEnd> miss(int waypoint);
  std::string passedText(int waypoint) const;
  void reach(int waypoint);
  void startSegment(std::size_t segment);
  void appendLap();
  std::optional<DriveEnd> checkProgress(const path::Pose& vehicle, double time);

  const FollowerOptions& options_;
  FollowEvents& events_;
  const path::Path path_;
  const Join join_;
  const bool loop_;

  std::unique_ptr<DrivenRoute> route_;  // none until the path is joined
  std::size_t segment_ = 0;
  double closest_ = std::numeric_limits<double>::infinity();  // m, to the end of the segment so far
  bool at_stop_ = false;  // came near to the end of the segment, where it stops
  int current_waypoint_ = 0;
  std::vector<int> missed_;
  int retries_ = 0;

  std::optional<double> settled_since_;
  std::optional<double> progress_since_;
  double least_left_ = std::numeric_limits<double>::infinity();
};

}  // namespace grid_path_planner::following
