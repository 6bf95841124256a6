// The node `projected_map`: point clouds or an octree file to a 3-D map, and that to a 2-D map.
//
//   subscribes  cloud_in                     sensor_msgs/PointCloud2
//   publishes   projected_map                nav_msgs/OccupancyGrid
//               projected_map_updates        map_msgs/OccupancyGridUpdate
//               occupied_cells_vis_array     visualization_msgs/MarkerArray
//               free_cells_vis_array         visualization_msgs/MarkerArray (publish_free_space)
//               octomap_point_cloud_centers  sensor_msgs/PointCloud2
//               octomap_binary, octomap_full octomap_msgs/Octomap, where there is octomap_msgs
//   services    ~reset, ~clear_bbx, ~save_map, ~save_octree (mapping_services.h)
//               octomap_binary, octomap_full octomap_msgs/GetOctomap, where there is octomap_msgs
//   subscribes  tf                           frame_id -> the clouds' frames, -> base_frame_id
//
// The names are octomap_server's. Clouds are inserted, one after the other, as soon as tf knows
// the pose of their sensor (input.h); a cloud that cannot be used is dropped with its reason,
// without effect on others. Where ROS time jumps back, as when a bag loops, tf and the waiting
// clouds are cleared; the map stays. A node that was ended and starts again under the same roscore
// begins with the map it had (map_autosave.h).
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/steady_timer.h>
#include <sensor_msgs/PointCloud2.h>

#include <memory>
#include <string>

#include "ros/guard/node_files.h"
#include "ros/input/frame_lookup.h"
#include "ros/input/input.h"
#include "ros/mapping/map_autosave.h"
#include "ros/mapping/mapping_diagnostics.h"
#include "ros/mapping/mapping_publications.h"
#include "ros/mapping/mapping_services.h"
#include "ros/mapping/mapping_thread.h"

namespace grid_path_planner {
class ProjectedMapConfig;
}  // namespace grid_path_planner

namespace grid_path_planner::None {}  // namespace grid_path_planner::None

namespace grid_path_planner::nodes {

template <class Config, class Options>
class Reconfigurable;

class ProjectedMapNode {
 public:
  // A file by argument stands for the parameter, as in octomap_server; others lie below the folder to
  // load from. Throws InputError for parameters and files that cannot be used. Callbacks are served
  // by the queue of `nh`, services by a thread of their own.
  ProjectedMapNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const NodeFiles& files = {});
  ~ProjectedMapNode();

 private:
  using Clouds = Input<sensor_msgs::PointCloud2>;

  // With the path of the file that the option names: `loaded`, where it names the same as before.
  mapping::ProjectedMapOptions withFile(mapping::ProjectedMapOptions options,
                                        const std::string& loaded) const;
  void use(const mapping::ProjectedMapOptions& options);
  void warnOfSilence() const;
  void postInsertion();
  void startAutosave(const ros::NodeHandle& nh, double period);

  // In the map's thread
  void forgetAll();
  void insertAll(mapping::MapModel& map);
  bool insertOne(mapping::MapModel& map);
  void insert(mapping::MapModel& map, const Clouds::Arrival& cloud);
  void save(const mapping::MapModel& map, MapAutosave::When when);

  NodeFiles files_;
  std::string filename_;  // the option that was used last
  FrameTransforms transforms_;
  std::unique_ptr<Clouds> clouds_;
  std::unique_ptr<MapAutosave> autosave_;  // null: none
  std::unique_ptr<MappingThread> thread_;

  ros::CallbackQueue service_queue_;
  ros::AsyncSpinner service_spinner_;
  std::unique_ptr<MappingPublications> publications_;
  std::unique_ptr<MappingServices> services_;
  std::unique_ptr<MappingDiagnostics> diagnostics_;
  std::unique_ptr<Reconfigurable<ProjectedMapConfig, mapping::ProjectedMapOptions>> reconfigurable_;
  ros::SteadyTimer autosave_timer_, silence_timer_;  // destroyed before what they call
};

}  // namespace grid_path_planner::nodes
