// The services of projected_map that change the map or write it to a file.
//
//   ~reset        std_srvs/Empty               empties the map, and removes what was kept of it for a
//                                              node that starts again
//   ~clear_bbx    octomap_msgs/BoundingBoxQuery where there is octomap_msgs, else
//                 grid_path_planner/ClearBox, which has the same MD5 sum
//   ~save_map     grid_path_planner/SaveFile   projected_map as a map_server YAML and its image
//   ~save_octree  grid_path_planner/SaveFile   .bt or .ot
//
// A cloud that came before ~reset is dropped; one that came before ~clear_bbx is inserted before the box is emptied, or
// dropped where it still waits for its transform.
// Files lie below the folder to save in (ros/guard/node_files.h).
// A request that cannot be fulfilled is refused with a sentence and changes nothing.
#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <std_srvs/Empty.h>

#include <functional>

#include "grid_path_planner/SaveFile.h"
#include "ros/guard/node_files.h"
#include "ros/mapping/mapping_thread.h"

#ifdef GPP_HAS_OCTOMAP_MSGS
#include <octomap_msgs/BoundingBoxQuery.h>
#else
#include "grid_path_planner/ClearBox.h"
#endif

namespace grid_path_planner::nodes {

#ifdef GPP_HAS_OCTOMAP_MSGS
using ClearBoxService = octomap_msgs::BoundingBoxQuery;
#else
using ClearBoxService = ClearBox;
#endif

class MappingServices {
 public:
  struct Listener {
    std::function<void()> on_change;  // after every change of the map
    // In the mapping thread: clouds that came before the map, or a box of it, is emptied are dealt with.
    std::function<void()> on_reset;
    std::function<void(mapping::MapModel&)> on_clear_box;
  };

  // `thread` and `files` outlive this.
  MappingServices(ros::NodeHandle private_nh, MappingThread& thread, const NodeFiles& files,
                  Listener listener);

  void shutdown();

 private:
  bool reset(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  bool clearBox(ClearBoxService::Request& request, ClearBoxService::Response& response);
  bool saveMap(SaveFile::Request& request, SaveFile::Response& response);
  bool saveOctree(SaveFile::Request& request, SaveFile::Response& response);

  MappingThread& thread_;
  const NodeFiles& files_;
  const Listener listener_;
  ros::ServiceServer reset_, clear_box_, save_map_, save_octree_;
};

}  // namespace grid_path_planner::nodes
