#include "grid_path_planner/mapping/octree_map.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "mapping/insertion/scan_insertion.h"
#include "mapping/insertion/tree_edits.h"
#include "mapping/map_tree.h"
#include "mapping/tree_file.h"
#include "mapping/tree_to_bricks.h"

namespace grid_path_planner::mapping {

using base::decimalText;
using base::InputError;

namespace {

using octomap::OcTreeKey;
using octomap::point3d;

std::string text(const point3d& point) {
  return "(" + std::to_string(point.x()) + ", " + std::to_string(point.y()) + ", " +
         std::to_string(point.z()) + ")";
}

const OctreeOptions& checked(const OctreeOptions& options) {
  checkOctreeOptions(options);
  return options;
}

}  // namespace

// What changes the tree and the bricks: where it fails, for want of memory, nobody knows how far it came.
template <class Work>
auto OctreeMap::change(Work work) -> std::invoke_result_t<Work> {
  restoreBricks();
  try {
    return work();
  } catch (const InputError&) {  // nothing was changed
    throw;
  } catch (...) {
    bricks_match_tree_ = false;
    throw;
  }
}

OctreeMap::OctreeMap(const OctreeOptions& options)
    : options_(checked(options)),
      tree_(std::make_unique<MapTree>(options.resolution, options)),
      bricks_(options.resolution),
      insertion_(std::make_unique<ScanInsertion>()) {}

OctreeMap::~OctreeMap() = default;
OctreeMap::OctreeMap(OctreeMap&&) noexcept = default;
OctreeMap& OctreeMap::operator=(OctreeMap&&) noexcept = default;

const octomap::OcTree& OctreeMap::tree() const {
  return *tree_;
}

OccupancyBricks& OctreeMap::bricks() {
  restoreBricks();
  return bricks_;
}

void OctreeMap::restoreBricks() {
  if (bricks_match_tree_) return;
  tree_->restoreInvariants();
  bricks_.restart(tree_->getResolution());
  makeBricks();
}

void OctreeMap::makeBricks() {
  bricks_match_tree_ = false;
  bricks_.clear(tree_->getResolution());
  treeToBricks(*tree_, bricks_);
  bricks_match_tree_ = true;
}

void OctreeMap::setOptions(const OctreeOptions& options) {
  checkOctreeOptions(options);
  if (options.resolution != options_.resolution)
    throw InputError("resolution is " + decimalText(options_.resolution) + " m and cannot become " +
                     decimalText(options.resolution) + " m in a map that exists");
  const bool judged_anew = options.occupancy_threshold != options_.occupancy_threshold;
  options_ = options;
  tree_->setModel(options);
  if (judged_anew) makeBricks();
}

std::size_t OctreeMap::insert(const Scan& scan) {
  OcTreeKey origin_key;
  if (!tree_->keyOf(scan.origin, origin_key))
    throw InputError("the origin " + text(scan.origin) + " of a scan is outside the octree");
  return change([&] {
    return insertion_->insert(scan, origin_key, options_.max_range, memoryLimitOf(options_), *tree_,
                              bricks_);
  });
}

void OctreeMap::clearBox(const point3d& low, const point3d& high) {
  OcTreeKey keys[2];
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (!(low(axis) <= high(axis)) || !std::isfinite(low(axis)) || !std::isfinite(high(axis)))
      throw InputError("a box goes from its low to its high corner, got " + text(low) + " and " +
                       text(high));
    keys[0][axis] = nearestKey(low(axis));
    keys[1][axis] = nearestKey(high(axis));
  }
  change([&] { freeBox(*tree_, bricks_, keys[0], keys[1]); });
}

void OctreeMap::reset() {
  change([&] {
    tree_->clear();
    bricks_.clear(tree_->getResolution());
  });
}

void OctreeMap::decay(double seconds) {
  if (!(seconds >= 0.0 && std::isfinite(seconds)))
    throw InputError("a map decays by a time of 0 s or more, got " + decimalText(seconds));
  if (options_.decay_time == 0.0) return;
  const double range = tree_->getClampingThresMaxLog() - tree_->getOccupancyThresLog();
  change([&] {
    fadeOccupied(*tree_, bricks_, static_cast<float>(range * seconds / options_.decay_time));
  });
}

void OctreeMap::load(const std::string& file, const base::ReadLimits& limits) {
  base::readWithin(file, limits, [&](base::ReadLimits& within) {
    replace(readTreeFile(file, options_, within), file, within);
  });
}

void OctreeMap::assign(const octomap::OcTree& tree) {
  base::ReadLimits limits;
  replace(std::make_unique<MapTree>(tree, options_), "the tree", limits);
}

void OctreeMap::save(const base::OutputFile& file) const {
  writeTreeFile(*tree_, file);
}

std::string OctreeMap::fileText(const std::vector<std::string>& comments) const {
  return treeText(*tree_, comments);
}

bool OctreeMap::isFull() const {
  return !insertion_->fits();
}

std::size_t OctreeMap::memoryUsage() const {
  return tree_->memoryUsage() + bricks_.memoryUsage() + insertion_->memoryUsage();
}

octomap::key_type OctreeMap::nearestKey(double coordinate) const {
  octomap::key_type key;
  if (tree_->keyOf(coordinate, key)) return key;
  return coordinate < 0.0 ? 0 : 0xFFFF;
}

void OctreeMap::replace(std::unique_ptr<MapTree> tree, const std::string& name,
                        base::ReadLimits& limits) {
  if (const std::size_t bricks = countBricks(*tree); bricks > kMostBricks)
    throw InputError(name, "covers " + std::to_string(bricks) +
                               " bricks of 8x8x8 voxels, at most " + std::to_string(kMostBricks) +
                               " can be held");
  limits.take(name, bytesToMeasureBricks(*tree));
  limits.take(name, bytesOfBricks(*tree));
  OctreeOptions options = options_;
  options.resolution = tree->getResolution();
  try {
    checkOctreeOptions(options);
  } catch (const InputError& error) {
    throw InputError(name, error.what());
  }
  options_ = options;
  tree_ = std::move(tree);
  makeBricks();
}

}  // namespace grid_path_planner::mapping
