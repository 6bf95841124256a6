#include "ros/mapping/mapping_publications.h"

#include <ros/console.h>

#include <algorithm>

#include "grid_path_planner/base/errors.h"
#include "ros/guard/scheduling/guarded_timer.h"
#include "ros/guard/scheduling/log_throttle.h"

namespace grid_path_planner::nodes {

using base::InputError;
using mapping::MapModel;
using mapping::ProjectedMapOptions;
using mapping::ProjectionReference;

namespace {

constexpr double kDecayPeriod = 1.0;    // s of ROS time; decay visits every occupied voxel
constexpr double kLongestDecay = 10.0;  // s of ROS time that a step of the decay counts at most
constexpr double kOldestDepth = 3.0;    // s of ROS time, of the vehicle's that the band refers to

}  // namespace

MappingPublications::MappingPublications(const ros::NodeHandle& nh,
                                         const ros::NodeHandle& service_nh, MappingThread& thread,
                                         const FrameLookup& transforms,
                                         const ProjectedMapOptions& options)
    : nh_(nh),
      thread_(thread),
      transforms_(transforms),
      map_(nh, options.latch, [this] { post(); }),
      octree_(nh, service_nh, options.latch, thread, [this] { post(); }) {
  use(options);
}

void MappingPublications::use(const ProjectedMapOptions& options) {
  publish_timer_ = guardedTimer(nh_, 1.0 / options.publish_rate, [this] { post(); });
  heartbeat_timer_.stop();
  if (options.heartbeat_period <= 0.0) return;
  heartbeat_timer_ = guardedTimer(nh_, options.heartbeat_period, [this] {
    thread_.post("heartbeat",
                 [this](MapModel& map) { map_.publishHeartbeat(map.options().frame_id); });
  });
}

void MappingPublications::post() {
  thread_.post("publish", [this](MapModel& map) { publish(map); });
}

void MappingPublications::publish(MapModel& map) {
  if (!ros::Time::isValid()) return;
  decay(map);
  const ros::Time stamp = ros::Time::now();
  try {
    if (updateVehicleHeight(map))
      map_.publish(map, stamp);
    else
      map_.owe();
  } catch (const InputError& error) {
    map_.owe();
    static LogThrottle seldom(10.0);
    ROS_ERROR_STREAM_COND(seldom.isDue(), "projected_map stays as it was: " << error.what());
  }
  static LogThrottle cut(10.0);
  if (const double area = map.areaLeftOut(); area > 0.0)
    ROS_WARN_STREAM_COND(cut.isDue(), "projected_map leaves out "
                                          << area << " m^2 that were seen: "
                                          << "they do not fit into projection_max_cells");
  octree_.publish(map, stamp);
}

// Less than passed by a clock that was put forward: in that time nothing could have been seen again.
void MappingPublications::decay(MapModel& map) {
  const ros::Time now = ros::Time::now();
  const double passed = now.toSec() - decayed_until_.toSec();
  if (passed >= 0.0 && passed < kDecayPeriod) return;
  if (map.options().octree.decay_time > 0.0 && passed > 0.0 && !decayed_until_.isZero())
    map.decay(std::min(passed, std::max(kLongestDecay, 2.0 / map.options().publish_rate)));
  decayed_until_ = now;
}

// Returns whether the height that the band refers to is known.
bool MappingPublications::updateVehicleHeight(MapModel& map) const {
  const ProjectedMapOptions& options = map.options();
  if (options.projection.reference != ProjectionReference::VEHICLE) return true;
  try {
    const Placed vehicle = transforms_.placeVehicle(
        {options.frame_id, kOldestDepth, Moving::WITH_VEHICLE, options.base_frame_id});
    map.setVehicleHeight(vehicle.pose.translation().z());
    return true;
  } catch (const TransformError& error) {
    static LogThrottle seldom(10.0);
    ROS_WARN_STREAM_COND(seldom.isDue(),
                         "projected_map waits for the vehicle's depth: " << error.what());
    return false;
  }
}

}  // namespace grid_path_planner::nodes
