// The services of projected_map that change the map or write it to a file.
//
//   ~reset        std_srvs/Empty               empties the map, and removes what was kept of it for a
//                                              node that starts again
//   ~clear_bbx    octomap_msgs/BoundingBoxQuery where there is octomap_msgs, else
//                 grid_path_planner/ClearBox, which has the same MD5 sum
//   ~save_map     grid_path_planner/SaveFile   projected_map as a map_server YAML and its image
//   ~save_octree  grid_path_planner/SaveFile   .bt or .ot
//
// Files lie below the folder to save in (ros/common/node_files.h).
// A request that cannot be fulfilled is refused with a sentence and changes nothing.
#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <std_srvs/Empty.h>

#include <functional>

#include "grid_path_planner/SaveFile.h"
#include "ros/common/node_files.h"
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
  // `thread` and `files` outlive this; `on_change` is called after every change of the map, `on_reset`
  // in the mapping thread before the map is emptied.
  MappingServices(ros::NodeHandle private_nh, MappingThread& thread, const NodeFiles& files,
                  std::function<void()> on_change, std::function<void()> on_reset);

  void shutdown();

 private:
  bool reset(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  bool clearBox(ClearBoxService::Request& request, ClearBoxService::Response& response);
  bool saveMap(SaveFile::Request& request, SaveFile::Response& response);
  bool saveOctree(SaveFile::Request& request, SaveFile::Response& response);

  MappingThread& thread_;
  const NodeFiles& files_;
  std::function<void()> on_change_;
  std::function<void()> on_reset_;
  ros::ServiceServer reset_, clear_box_, save_map_, save_octree_;
};

}  // namespace grid_path_planner::nodes
