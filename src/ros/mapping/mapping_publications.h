// What projected_map publishes, when: its maps publish_rate times a second, for a new subscriber and after a change that
// somebody asked for, and a heartbeat. Before each publication voxels decay, and the band follows the vehicle.
#pragma once

#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include "ros/input/frame_lookup.h"
#include "ros/mapping/mapping_thread.h"
#include "ros/mapping/octree_publisher.h"
#include "ros/mapping/projected_map_publisher.h"

namespace grid_path_planner::nodes {

class MappingPublications {
 public:
  // `thread` and `transforms` outlive this. Services are served by the queue of `service_nh`.
  MappingPublications(const ros::NodeHandle& nh, const ros::NodeHandle& service_nh,
                      MappingThread& thread, const FrameLookup& transforms,
                      const mapping::ProjectedMapOptions& options);

  // By the periods of these options from now on.
  void use(const mapping::ProjectedMapOptions& options);
  // After what the mapping thread has to do already. Thread-safe.
  void post();
  // Of the octree's services: asks the master, which may not answer.
  void shutdown() { octree_.shutdown(); }

  ProjectedMapPublisher& map() { return map_; }
  const OctreePublisher& octree() const { return octree_; }

 private:
  // In the mapping thread
  void publish(mapping::MapModel& map);
  void decay(mapping::MapModel& map);
  bool updateVehicleHeight(mapping::MapModel& map) const;

  ros::NodeHandle nh_;
  MappingThread& thread_;
  const FrameLookup& transforms_;
  ProjectedMapPublisher map_;
  OctreePublisher octree_;
  ros::Time decayed_until_;                           // of the mapping thread
  ros::SteadyTimer publish_timer_, heartbeat_timer_;  // destroyed before what they call
};

}  // namespace grid_path_planner::nodes
