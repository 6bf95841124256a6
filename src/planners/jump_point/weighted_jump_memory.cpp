// What a WeightedJumpPoint holds, and what goes first where memory is little.
#include <algorithm>

#include "planners/jump_point/jump_point.h"
#include "planners/jump_point/weighted_jump_point.h"
#include "planners/tables/precomputed_heuristic.h"

namespace grid_path_planner::planners {

using grid::GridGeometry;

// Trees and landmarks are no reason to refuse a map: they go where memory is little.
std::size_t WeightedJumpPoint::bytesFor(const GridGeometry& geometry) const {
  const std::size_t searches = bytesOfSearches(geometry);
  const std::size_t all = searches + bytesBesideSearches(geometry);
  return all > memoryLimit() ? searches : all;
}

std::size_t WeightedJumpPoint::bytesBesideSearches(const GridGeometry& geometry) const {
  return (tree_.held() ? KeptSearchTree::bytesFor(geometry) : 0) + landmarks_.bytes();
}

void WeightedJumpPoint::releaseOptionalMemory() {
  tree_.release();
  landmarks_.release();
}

// So much that another planner like this one fits beside it, and as much again is left.
std::size_t WeightedJumpPoint::roomForLandmarks() const {
  const GridGeometry& geometry = map().geometry();
  const std::size_t taken = bytesOfSearches(geometry) + KeptSearchTree::bytesFor(geometry);
  return (memoryLimit() - std::min(memoryLimit(), 2 * taken)) / 2;
}

// Both where the substitute answers searches until the jumps are prepared.
std::size_t WeightedJumpPoint::bytesOfSearches(const GridGeometry& geometry) const {
  if (jumps_ready_ && substitute_) return bytesOfBoth();
  const std::size_t one = std::max(WeightedJumpSearch::bytesFor(geometry), bytesOfAStar(geometry));
  return a_star_asked_for_ ? one : std::max(one, JumpPoint().bytesFor(geometry));
}

// The jumps' and the substitute's.
std::size_t WeightedJumpPoint::bytesOfBoth() const {
  const GridGeometry& geometry = map().geometry();
  return WeightedJumpSearch::bytesFor(geometry) +
         (jumpPointSubstitutes() ? JumpPoint().bytesFor(geometry) : bytesOfAStar(geometry));
}

std::size_t WeightedJumpPoint::bytesOfAStar(const GridGeometry& geometry) const {
  AStarOptions options = options_;
  if (!a_star_asked_for_ && !landmarks_asked_for_) options.heuristic = Heuristic::BLOCKS;
  return AStar(options).bytesFor(geometry);
}

std::string WeightedJumpPoint::lessMemoryAdvice() const {
  const std::string advice = PrecomputedHeuristic::lessMemoryAdvice(options_);
  return advice.empty() ? Planner::lessMemoryAdvice() : advice;
}

bool WeightedJumpPoint::treeFits() const {
  const GridGeometry& geometry = map().geometry();
  const std::size_t others = bytesOfSearches(geometry) + landmarks_.bytes();
  return others + KeptSearchTree::bytesFor(geometry) <= memoryLimit();
}

std::size_t WeightedJumpPoint::bytesOfTables() {
  if (!landmarks_asked_for_) return landmarks_.bytes();
  return substitute_ ? substitute_->backgroundWork().bytes : 0;
}

}  // namespace grid_path_planner::planners
