#include "avoidance/search/path_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace grid_path_planner::avoidance {

using Eigen::Vector3d;

namespace {

constexpr double kSameHeight = 0.4;  // m between vehicle and goal
constexpr double kLongPath = 1.3;    // times the straight distance
constexpr double kLongMore = 2.0;    // m
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double lengthOf(const Points& path) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) length += (path[i + 1] - path[i]).norm();
  return length;
}

}  // namespace

PathFinder::PathFinder(const PilotOptions& options) : options_(options), tree_(options) {}

void PathFinder::setOptions(const PilotOptions& options) {
  const bool other_bins = options.bin != options_.bin || options.elevation != options_.elevation;
  options_ = options;
  tree_.learned().forget();
  if (other_bins) tree_ = LookAheadTree(options);
}

VoxelQuery PathFinder::voxelQuery(const PathQuery& query, double distance) const {
  VoxelQuery voxels;
  voxels.start = query.start;
  voxels.goal = query.goal;
  voxels.goal_radius = std::max(0.1, query.goal_radius - 0.2);
  voxels.distance = distance;
  voxels.z_min = options_.z_min;
  voxels.z_max = options_.z_max;
  voxels.unseen_cost = options_.unseen_cost;
  voxels.most_nodes = options_.grid_nodes;
  voxels.closed = &closed_;
  return voxels;
}

// At the goal's height first; through all heights where that is a long path, or none; where those are too
// many to look at, at the vehicle's height.
VoxelPath PathFinder::gridPath(const OpenSpace& space, const PathQuery& query, double distance) {
  VoxelQuery voxels = voxelQuery(query, distance);
  const double straight = (query.goal - query.start).norm();
  VoxelPath level;
  voxels.flat = !options_.elevation || std::abs(query.goal.z() - query.start.z()) <= kSameHeight;
  if (!options_.elevation) voxels.goal.z() = query.start.z();
  if (voxels.flat) {
    level = grid_.search(space, voxels);
    if (!options_.elevation) return level;
    if (!level.points.empty() && level.cost <= kLongPath * straight + kLongMore) return level;
  }
  const bool was_flat = voxels.flat;
  voxels.flat = false;
  if (!level.points.empty()) voxels.most_cost = level.cost;
  VoxelPath any = grid_.search(space, voxels);
  if (any.points.empty() && !any.exhausted && !was_flat) {
    voxels.flat = true;
    voxels.goal.z() = query.start.z();
    any = grid_.search(space, voxels);
    any.exhausted = false;
  }
  const bool level_wins = !level.points.empty() && (any.points.empty() || level.cost <= any.cost);
  if (!level_wins) return any;
  return level;
}

Points PathFinder::treePath(const OpenSpace& space, const PathQuery& query) {
  PilotOptions options = options_;
  if (options.search == Search::DIRECTION) options.nodes = 1;
  LearnedCosts& learned = tree_.learned();
  if (query.goal != learned_about_) learned.forget();
  learned.forgetBefore(query.time - options.memory);
  learned_about_ = query.goal;
  Points path = tree_.search(space, options, query.start, query.goal, before_, closed_, query.time);
  if (options.search == Search::DIRECTION && path.size() < 2) {
    const TreeNode* best = nullptr;
    for (const TreeNode& node : tree_.nodes())
      if (node.parent == 0 && (best == nullptr || node.total < best->total)) best = &node;
    if (best != nullptr) path.push_back(best->position);
  }
  return path;
}

double PathFinder::treeCost(const Points& path, const Vector3d& goal) const {
  double cost = 0.0;
  Angles before = before_;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vector3d edge = path[i + 1] - path[i];
    const Angles angles = anglesOf(edge);
    cost += directionCost(options_, angles, anglesOf(goal - path[i]), before) * edge.norm() /
            options_.step;
    before = angles;
  }
  return cost + tree_.estimate(options_, path.back(), goal);
}

bool PathFinder::isFree(const OpenSpace& space, const Points& path) const {
  const double room = space.nearest(path.front(), options_.d_safe);
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    if (!space.clear(
            path[i], path[i + 1],
            i == 0 ? std::min(options_.d_safe, std::max(0.0, room - 0.02)) : options_.d_safe))
      return false;
  return true;
}

double PathFinder::gridCost(const OpenSpace& space, const Points& path, const PathQuery& query) {
  const VoxelQuery voxels = voxelQuery(query, options_.d_safe + kPlanRoom);
  double cost = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    cost += grid_.lineCost(space, path[i], path[i + 1], voxels);
  const double rest = (path.back() - query.goal).norm();
  return rest > query.goal_radius ? cost + rest : cost;
}

// A path that leads to the goal, or still half as far as the new one.
bool PathFinder::leadsOn(const Points& kept, const Points& path, const PathQuery& query) const {
  return (kept.back() - query.goal).norm() <= query.goal_radius ||
         lengthOf(kept) >= 0.5 * lengthOf(path);
}

double PathFinder::neededWidth() const {
  return 2.0 * (options_.d_safe + kPlanRoom);
}

std::optional<NarrowPlace> PathFinder::tooNarrow(const OpenSpace& space, const PathQuery& query) {
  constexpr double kSteps = 6.0;
  const double kept = options_.d_safe + kPlanRoom;
  closed_.clear();
  for (double share = kSteps - 1.0; share >= 1.0; share -= 1.0) {
    const VoxelPath path = gridPath(space, query, kept * share / kSteps);
    if (!path.points.empty()) return narrowestPlace(space, path.points, kept);
  }
  return std::nullopt;
}

std::optional<Points> PathFinder::find(const OpenSpace& space, const PathQuery& query,
                                       const Points& kept, const Points& closed) {
  closed_ = closed;
  const bool keep = kept.size() >= 2 && isFree(space, kept);
  Points path;
  double cost = kInfinity, kept_cost = kInfinity;
  if (options_.search == Search::GRID) {
    VoxelPath found = gridPath(space, query, options_.d_safe + kPlanRoom);
    exhausted_ = found.points.empty() && found.exhausted;
    path = std::move(found.points);
    if (keep && !path.empty()) {
      cost = gridCost(space, path, query);
      kept_cost = gridCost(space, kept, query);
    }
  } else {
    path = treePath(space, query);
    exhausted_ = path.size() < 2;
    if (keep && path.size() >= 2) {
      cost = treeCost(path, query.goal);
      kept_cost = treeCost(kept, query.goal);
    }
  }
  if (keep && leadsOn(kept, path, query) &&
      (path.size() < 2 || cost >= (1.0 - options_.hysteresis) * kept_cost))
    return std::nullopt;
  if (path.size() >= 2) before_ = anglesOf(path[1] - path[0]);
  return path;
}

}  // namespace grid_path_planner::avoidance
