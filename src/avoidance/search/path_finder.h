// The path to a target on what is remembered, by the search that the options name; kept while it is still
// free and no other is cheaper by more than `hysteresis`.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "avoidance/search/look_ahead_tree.h"
#include "avoidance/search/narrow_place.h"
#include "avoidance/search/voxel_search.h"
#include "grid_path_planner/avoidance/pilot_options.h"

namespace grid_path_planner::avoidance {

struct PathQuery {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  double goal_radius = 0.0;  // m
  double time = 0.0;         // s
};

class PathFinder {
 public:
  explicit PathFinder(const PilotOptions& options);

  // For options of another kind of search or another width of bins.
  void setOptions(const PilotOptions& options);

  // The best path now, in `kept` the one that is flown (from the vehicle on, empty: none). Nothing where
  // that is to be kept. Paths through places in `closed` are closed.
  std::optional<std::vector<Eigen::Vector3d>> find(const OpenSpace& space, const PathQuery& query,
                                                   const std::vector<Eigen::Vector3d>& kept,
                                                   const std::vector<Eigen::Vector3d>& closed);
  // Where a path that would keep less than d_safe is too narrow; none: there is no such path, or no such
  // place. Takes up to six searches.
  std::optional<NarrowPlace> tooNarrow(const OpenSpace& space, const PathQuery& query);
  // The width that a place needs, m.
  double neededWidth() const;
  // Whether the last path found was none although everything that can be reached was looked at.
  bool exhausted() const { return exhausted_; }

  const LookAheadTree& tree() const { return tree_; }

 private:
  std::vector<Eigen::Vector3d> treePath(const OpenSpace& space, const PathQuery& query);
  VoxelPath gridPath(const OpenSpace& space, const PathQuery& query, double distance);
  VoxelQuery voxelQuery(const PathQuery& query, double distance) const;
  double treeCost(const std::vector<Eigen::Vector3d>& path, const Eigen::Vector3d& goal) const;
  bool leadsOn(const std::vector<Eigen::Vector3d>& kept, const std::vector<Eigen::Vector3d>& path,
               const PathQuery& query) const;
  bool isFree(const OpenSpace& space, const std::vector<Eigen::Vector3d>& path) const;
  double gridCost(const OpenSpace& space, const std::vector<Eigen::Vector3d>& path,
                  const PathQuery& query);

  PilotOptions options_;
  LookAheadTree tree_;
  VoxelSearch grid_;
  Angles before_;                                            // of the direction chosen last
  Eigen::Vector3d learned_about_ = Eigen::Vector3d::Zero();  // the goal of the tree's last search
  std::vector<Eigen::Vector3d> closed_;
  bool exhausted_ = false;
};

}  // namespace grid_path_planner::avoidance
