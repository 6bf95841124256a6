#include "ray_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grid_path_planner {
namespace {

// Two of something at once, in a register where the machine has such.
using Times = double __attribute__((vector_size(16)));
using Pair = std::int64_t __attribute__((vector_size(16)));

// A voxel inside its tile: the lower half is its place in the tile's cells; the upper half holds
// its coordinates with a guard bit above each, which a step out of the tile sets, either way.
using Spot = std::uint64_t;

constexpr unsigned kFieldBits = VoxelTile::kEdgeBits + 1;
constexpr unsigned kFieldShift[] = {32, 32 + kFieldBits, 32 + 2 * kFieldBits};

constexpr Spot field(unsigned axis, Spot value) {
  return value << kFieldShift[axis];
}

constexpr Spot kGuards =
    field(0, VoxelTile::kEdge) | field(1, VoxelTile::kEdge) | field(2, VoxelTile::kEdge);

// One voxel forward along each axis.
constexpr Spot kUnit[] = {field(0, 1) | VoxelTile::place(1, 0, 0),
                          field(1, 1) | VoxelTile::place(0, 1, 0),
                          field(2, 1) | VoxelTile::place(0, 0, 1)};

Spot spotOf(const octomap::OcTreeKey& key) {
  Spot spot = VoxelTile::place(key[0], key[1], key[2]);
  for (unsigned axis = 0; axis < 3; ++axis) spot |= field(axis, key[axis] % VoxelTile::kEdge);
  return spot;
}

void mark(VoxelTile* tile, Spot spot) {
  tile->cells[static_cast<std::uint32_t>(spot)] = Mark::FREE;
}

// Whether a crossing of axis `kA` at `a` comes before one of axis `kB` at `b`: of two at the same
// time, the higher axis is first.
template <unsigned kA, unsigned kB>
Pair before(Times a, Times b) {
  if constexpr (kA > kB)
    return a <= b;
  else
    return a < b;
}

}  // namespace

// By axis: when the ray next crosses a border and how long it goes from one to the next (both as
// lengths along the ray), the step in the tile and how many remain to the last voxel.
struct RayTracer::Walk {
  VoxelTile* tile;
  Spot spot;
  std::array<double, 3> next, between;
  std::array<Spot, 3> step;
  std::array<bool, 3> forward;
  std::array<std::int64_t, 3> remaining;
  double length;
};

RayTracer::RayTracer(const MapTree& tree, const octomap::point3d& origin,
                     const octomap::OcTreeKey& key, VoxelTiles& tiles)
    : origin_(origin),
      key_(key),
      resolution_(tree.getResolution()),
      tiles_(tiles),
      first_tile_(tiles.tileOf(key)) {
  for (unsigned axis = 0; axis < 3; ++axis)
    for (const int step : {-1, 1}) {
      double border = tree.keyToCoord(key[axis]);
      border += static_cast<float>(step * resolution_ * 0.5);
      border_[axis][step > 0] = border - origin(axis);
    }
}

void RayTracer::trace(const octomap::point3d& end, const octomap::OcTreeKey& key) {
  if (key == key_) return;
  octomap::point3d direction = end - origin_;
  const float length = static_cast<float>(direction.norm());
  direction /= length;
  Walk walk;
  walk.tile = &first_tile_;
  walk.spot = spotOf(key_);
  walk.length = length;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const bool forward = direction(axis) > 0.0f, still = !forward && !(direction(axis) < 0.0f);
    const std::int64_t voxels = static_cast<std::int64_t>(key[axis]) - key_[axis];
    constexpr double kNever = std::numeric_limits<double>::max();
    walk.next[axis] = still ? kNever : border_[axis][forward] / direction(axis);
    walk.between[axis] = still ? kNever : resolution_ / std::fabs(direction(axis));
    walk.forward[axis] = forward;
    walk.step[axis] = forward ? kUnit[axis] : -kUnit[axis];
    walk.remaining[axis] = forward ? voxels : -voxels;
  }
  const auto& between = walk.between;
  const unsigned major =
      static_cast<unsigned>(std::min_element(between.begin(), between.end()) - between.begin());
  if (major == 0) return walkSlabs<0>(walk);
  if (major == 1) return walkSlabs<1>(walk);
  return walkSlabs<2>(walk);
}

template <unsigned kMajor>
void RayTracer::walkSlabs(Walk& walk) const {
  constexpr unsigned kA = kMajor == 2 ? 1 : 2, kB = kMajor == 0 ? 1 : 0;  // kA > kB
  // Otherwise rounding might let it cross two borders of another axis in one slab.
  constexpr double kClearly = 1.0 + 1e-9;
  if (!(std::min(walk.between[kA], walk.between[kB]) > walk.between[kMajor] * kClearly))
    return walkVoxels(walk, true);

  Times next{walk.next[kA], walk.next[kB]};
  const Times between{walk.between[kA], walk.between[kB]};
  const Pair step{static_cast<std::int64_t>(walk.step[kA]),
                  static_cast<std::int64_t>(walk.step[kB])};
  Pair remaining{walk.remaining[kA], walk.remaining[kB]};
  double exit = walk.next[kMajor];
  Spot spot = walk.spot;
  VoxelTile* tile = walk.tile;
  std::int64_t slabs = walk.remaining[kMajor];
  const std::int64_t all_slabs = slabs;
  for (; slabs > 0 && exit <= walk.length; --slabs) {
    const Times exits{exit, exit};
    Pair crosses = next < exits;
    if constexpr (kMajor == 0) crosses = next <= exits;
    if constexpr (kMajor == 1) crosses |= (next == exits) & Pair{-1, 0};
    const Times swapped{next[1], next[0]};
    const Spot a_first = static_cast<Spot>(before<kA, kB>(next, swapped)[0]);
    const Pair moves = crosses & step;
    const Spot a = static_cast<Spot>(moves[0]), b = static_cast<Spot>(moves[1]);
    const Spot second = spot + (b ^ ((a ^ b) & a_first)), third = spot + a + b;
    const Spot following = third + walk.step[kMajor];
    next = crosses ? next + between : next;
    remaining += crosses;
    exit += walk.between[kMajor];
    mark(tile, spot);
    if (!(following & kGuards)) {
      mark(tile, second);
      mark(tile, third);
      spot = following;
      continue;
    }
    walk.spot = spot;
    walk.tile = tile;
    for (const bool turn : {true, false}) {
      const bool a_now = turn == static_cast<bool>(a_first);
      if (!(a_now ? a : b)) continue;
      move(walk, a_now ? kA : kB);
      mark(walk.tile, walk.spot);
    }
    move(walk, kMajor);
    spot = walk.spot;
    tile = walk.tile;
  }
  walk.spot = spot;
  walk.tile = tile;
  walk.next[kA] = next[0];
  walk.next[kB] = next[1];
  walk.next[kMajor] = exit;
  walk.remaining[kA] = remaining[0];
  walk.remaining[kB] = remaining[1];
  walk.remaining[kMajor] = slabs;
  walkVoxels(walk, slabs == all_slabs);
}

// `at_origin`: the origin's voxel is free however short the ray.
void RayTracer::walkVoxels(Walk& walk, bool at_origin) const {
  auto& next = walk.next;
  auto& remaining = walk.remaining;
  // A ray too short for its direction to be a number would never end.
  std::int64_t most = 4;
  for (const std::int64_t voxels : remaining) most += std::max<std::int64_t>(voxels, 0);
  for (; most > 0; --most) {
    const bool at_end = remaining[0] == 0 && remaining[1] == 0 && remaining[2] == 0;
    if (!at_origin && (at_end || std::min({next[0], next[1], next[2]}) > walk.length)) return;
    at_origin = false;
    mark(walk.tile, walk.spot);
    const unsigned axis =
        next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    next[axis] += walk.between[axis];
    --remaining[axis];
    move(walk, axis);
  }
}

void RayTracer::move(Walk& walk, unsigned axis) const {
  walk.spot += walk.step[axis];
  if (!(walk.spot & kGuards)) return;
  const Spot across = VoxelTile::kEdge * kUnit[axis];
  walk.spot += walk.forward[axis] ? -across : across;
  walk.tile = &tiles_.neighbor(*walk.tile, axis, walk.forward[axis]);
}

}  // namespace grid_path_planner
