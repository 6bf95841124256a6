// The 3-D map: an OctoMap tree filled by depth frames, and the same voxels as bricks.
//
//   OctreeMap map(options);
//   map.insert({origin, hits, clear_only});
//   map.tree();                          // octomap::OcTree, to be saved and published
//   map.bricks().drainChangedColumns();  // what is to be projected again
//
// Guaranteed: after insert() the tree is the one that octomap::OcTree::insertPointCloud makes of
// the same scans: the same nodes with bit-identical log odds, each voxel updated once a scan, a hit
// winning over a ray that passes. After every call exactly the voxels that are known and occupied in
// the tree are so in the bricks. A call that throws InputError has changed nothing. Not guaranteed:
// safe use by several threads at once, except for const calls; OctoMap's result where it is
// undefined (rays too short for single precision, rays that rounding leads out of space).
//
// A. Hornung et al., "OctoMap: an efficient probabilistic 3D mapping framework based on octrees",
// Autonomous Robots 34 (2013).
#pragma once

#include <octomap/OcTree.h>

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "grid_path_planner/mapping/octree_options.h"
#include "grid_path_planner/mapping/scan.h"

namespace grid_path_planner::mapping {

class MapTree;
class ScanInsertion;

class OctreeMap {
 public:
  // An empty map. Throws InputError where checkOctreeOptions does.
  explicit OctreeMap(const OctreeOptions& options);
  ~OctreeMap();
  OctreeMap(OctreeMap&&) noexcept;
  OctreeMap& operator=(OctreeMap&&) noexcept;

  const OctreeOptions& options() const { return options_; }
  // Takes effect with the next call; a new occupancy_threshold changes the bricks at once. Throws
  // InputError where checkOctreeOptions does and for another resolution.
  void setOptions(const OctreeOptions& options);

  // Points beyond max_range clear their ray up to it, clear_only points up to themselves. A
  // point that is not finite or lies outside the tree's range (32768 voxels in each direction; of a point
  // beyond max_range where its ray is cut) is left out; returns how many were. Throws InputError
  // where the origin itself is such a point, and where the rays of few points cross very many bricks of a
  // box that they do not fill: half a million are always allowed, and 512 for each point.
  std::size_t insert(const Scan& scan);

  // Whether the last scan would have brought more than memory_limit: what it said of voxels that were
  // known is in the map, from a quarter above the limit on its hits alone; the others are still unknown.
  bool isFull() const;

  // Known voxels that the box touches become free for sure (octomap_server's clear_bbx, but also
  // inside of larger leaves exactly the box); unknown ones stay unknown. Corners in metres; outside
  // the tree's range they are taken to its border. Throws InputError for a corner that is not
  // finite and for one of `low` above that of `high`.
  void clearBox(const octomap::point3d& low, const octomap::point3d& high);

  // Forgets everything.
  void reset();

  // Lets `seconds` pass for occupied voxels: a surely occupied one is unknown after decay_time
  // without another hit, others sooner. Throws InputError for a negative or infinite time.
  void decay(double seconds);

  // Replaces the map by a .bt or .ot file, told apart by content; its resolution becomes ours.
  // Throws InputError naming the file where it is missing, damaged, of another kind or too large to
  // be a map (see kMostBricks) or for `limits`; then the map is as it was.
  void load(const std::string& file, const base::ReadLimits& limits = {});

  // Replaces the map by a copy of `tree`; its resolution becomes ours. Throws InputError if it is
  // too large.
  void assign(const octomap::OcTree& tree);

  // By the file's ending: .bt holds free, occupied and unknown, .ot the log odds. The file is whole
  // or as it was. Throws InputError naming the file for another ending or if it cannot be written.
  void save(const base::OutputFile& file) const;

  // What save() writes to a .ot file, with lines of comment after the first line.
  std::string fileText(const std::vector<std::string>& comments) const;

  const octomap::OcTree& tree() const;
  const OccupancyBricks& bricks() const { return bricks_; }
  // To drain what has changed.
  OccupancyBricks& bricks();

  // Of tree, bricks and what is kept for the next insertion, in bytes.
  std::size_t memoryUsage() const;

  // The most bricks of 8x8x8 voxels that a tree from outside may cover: a few bytes of a file can
  // claim to know the whole of space.
  static constexpr std::size_t kMostBricks = std::size_t{1} << 25;

 private:
  template <class Work>
  auto change(Work work) -> std::invoke_result_t<Work>;
  // Makes them of the tree, where a change of both had no memory.
  void restoreBricks();
  void makeBricks();
  octomap::key_type nearestKey(double coordinate) const;
  void replace(std::unique_ptr<MapTree> tree, const std::string& name, base::ReadLimits& limits);

  OctreeOptions options_;
  std::unique_ptr<MapTree> tree_;
  OccupancyBricks bricks_;
  bool bricks_match_tree_ = true;
  std::unique_ptr<ScanInsertion> insertion_;
};

}  // namespace grid_path_planner::mapping
