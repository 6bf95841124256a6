// A* over the voxels of an OpenSpace: the path of least cost that no remembered point closes.
//
// Voxels that were never seen may hold a path and cost more; so do voxels near points, and height. A goal
// outside the window is searched for up to the window's side. Neighbours are the 26 voxels around, in a
// flat search the 8 of the same height. The path is pulled taut where that costs no more.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "avoidance/memory/open_space.h"

namespace grid_path_planner::avoidance {

struct VoxelQuery {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  double goal_radius = 0.0;  // m, within which the goal is reached
  double distance = 0.0;     // m, kept from points; at most d_safe + 0.1
  double z_min = 0.0, z_max = 0.0;
  bool flat = false;  // at the goal's height
  double unseen_cost = 1.0;
  int most_nodes = 0;
  double most_cost =
      std::numeric_limits<double>::infinity();  // m, weighted; costlier paths are not found
  // Places that are closed, 0.5 m about each.
  const std::vector<Eigen::Vector3d>* closed = nullptr;
};

struct VoxelPath {
  std::vector<Eigen::Vector3d> points = {};  // from the start on; empty where there is none
  double cost = 0.0;                         // m, weighted
  bool exhausted = false;                    // every voxel that can be reached was looked at
  int expanded = 0;
};

class VoxelSearch {
 public:
  VoxelSearch();

  VoxelPath search(const OpenSpace& space, const VoxelQuery& query);

  // Of a line, weighted as in the query of the last search; infinite where a point closes it.
  double lineCost(const OpenSpace& space, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                  const VoxelQuery& query);

 private:
  enum class Room : std::uint8_t { UNKNOWN, CLOSED, NEAR, FREE };
  struct Node {
    float g;
    std::uint16_t query;    // in which this node is valid
    std::uint8_t from;      // number of the step that led here
    std::uint8_t room : 2;  // Room
    std::uint8_t done : 1;
  };
  using Entry = std::pair<float, std::int32_t>;  // f, slot

  void begin(const OpenSpace& space, const VoxelQuery& query);
  Node& nodeAt(int slot);
  Room roomAt(const Voxel& voxel);
  Room judge(const Eigen::Vector3d& centre, int slot) const;
  double weight(const Voxel& voxel);
  double heuristic(const Voxel& voxel) const;
  bool atGoal(const Voxel& voxel) const;
  void expand(const Voxel& voxel);
  int run(VoxelPath& path);
  void trace(int slot, VoxelPath& path);
  void pullTaut(VoxelPath& path);
  double costOfLine(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

  const OpenSpace* space_ = nullptr;
  const VoxelQuery* query_ = nullptr;
  Voxel start_ = {0, 0, 0}, goal_ = {0, 0, 0};
  double start_room_ = 0.0;  // m, from the start to the nearest point
  std::uint16_t count_ = 0;
  std::vector<Node> nodes_;
  std::vector<Entry> open_;
  std::vector<double> costs_;  // of the path's points, before it is pulled taut
};

}  // namespace grid_path_planner::avoidance
