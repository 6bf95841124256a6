// The octree as messages: cubes for rviz, and the centres of its occupied voxels.
//
// Leaves count whose cube reaches into the heights between `min_z` and `max_z`, m. A leaf that
// stands for 8^n voxels is one cube and one centre, as octomap_server has it.
#pragma once

#include <octomap/OcTree.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include "grid_path_planner/mapping/projected_map_options.h"

namespace grid_path_planner::nodes {

struct HeightRange {
  double min_z;
  double max_z;
};

// One CUBE_LIST marker a size of leaf, with its depth in the tree for an id; sizes that do not
// occur are deleted from the display. Frame and stamp are the caller's.
visualization_msgs::MarkerArray occupiedMarkers(const octomap::OcTree& tree,
                                                const HeightRange& heights,
                                                const mapping::VoxelColors& colors);
visualization_msgs::MarkerArray freeMarkers(const octomap::OcTree& tree, const HeightRange& heights,
                                            const mapping::VoxelColors& colors);

// Fields x, y, z as FLOAT32; without header.
sensor_msgs::PointCloud2 occupiedCentres(const octomap::OcTree& tree, const HeightRange& heights);

}  // namespace grid_path_planner::nodes
