#include "mapping/insertion/dense_ray_traversal.h"

#include <algorithm>
#include <cstdlib>

namespace grid_path_planner::mapping {
namespace {

// Two numbers at once, in a SIMD register where the machine has one.
using Times = double __attribute__((vector_size(16)));
using Pair = std::int64_t __attribute__((vector_size(16)));

// By bit: `a` where the mask is set, else `b`. (GCC 12 compiles `mask ? a : b` to branches here.)
template <class Bits>
Bits either(Bits mask, Bits a, Bits b) {
  return b ^ ((a ^ b) & mask);
}

// Which of two crossings at `next` come before the crossing of the major axis at `exit` > 0. Of
// crossings at the same time the higher axis comes first: `kA` > `kB`.
template <unsigned kMajor, unsigned kA, unsigned kB>
Pair before(Times next, double exit) {
  const Times exits{exit, exit};
  if constexpr (kB > kMajor) return next <= exits;
  if constexpr (kA < kMajor) return next < exits;
  const Pair one_less_for_b{0, -1};  // the next smaller number of double precision
  return next <= reinterpret_cast<Times>(reinterpret_cast<Pair>(exits) + one_less_for_b);
}

struct WindowCursor {
  Mark* cells;
  std::int64_t place, end;
  std::array<std::int64_t, 3> steps;

  void mark() { cells[place] = Mark::FREE; }
  void step(unsigned axis) { place += steps[axis]; }
  bool atEnd() const { return place == end; }
};

}  // namespace

void DenseRayTraversal::mark(Ray& ray, const octomap::OcTreeKey& end) const {
  const auto& between = ray.between;
  const std::int64_t end_place = window_.place(end);
  const auto slabs = [&](unsigned axis) {
    return std::abs(static_cast<std::int64_t>(end[axis]) - key_[axis]);
  };
  if (between[0] < between[1] && between[0] < between[2])
    return markSlabs<0>(ray, slabs(0), end_place);
  if (between[1] < between[2]) return markSlabs<1>(ray, slabs(1), end_place);
  markSlabs<2>(ray, slabs(2), end_place);
}

template <unsigned kMajor>
void DenseRayTraversal::markSlabs(Ray& ray, std::int64_t slabs, std::int64_t end) const {
  constexpr unsigned kA = kMajor == 2 ? 1 : 2,
                     kB = kMajor == 0 ? 1 : 0;  // kA > kB
  // Otherwise rounding might let a ray cross two borders of another axis in one slab.
  constexpr double kClearly = 1.0 + 1e-9;
  // The relative error of a sum of up to 65536 crossing times.
  constexpr double kSurely = 1.0 + 1e-11;
  const double between_major = ray.between[kMajor];
  double exit = ray.next[kMajor];
  if (slabs == 0 || !(exit > 0.0) ||
      !(std::min(ray.between[kA], ray.between[kB]) > between_major * kClearly) ||
      !((exit + static_cast<double>(slabs - 1) * between_major) * kSurely <= ray.length))
    return markVoxels(ray, origin_, end, true);

  const auto stride = [&](unsigned axis) {
    return ray.forward[axis] ? window_.strides()[axis] : -window_.strides()[axis];
  };
  Mark* const cells = window_.cells();
  const std::int64_t step_major = stride(kMajor);
  const Pair steps{stride(kA), stride(kB)};
  const Times between{ray.between[kA], ray.between[kB]};
  Times next{ray.next[kA], ray.next[kB]};
  std::int64_t place = origin_;
  for (; slabs > 0; --slabs) {
    const Times swapped{next[1], next[0]}, after = next + between;
    const Pair crosses = before<kMajor, kA, kB>(next, exit);
    const Pair moves = crosses & steps, in_order = next <= swapped;
    const std::int64_t a = moves[0], b = moves[1];
    const std::int64_t second = place + either(in_order[0], a, b);
    const std::int64_t third = place + a + b;
    cells[place] = cells[second] = cells[third] = Mark::FREE;
    place = third + step_major;
    next = reinterpret_cast<Times>(
        either(crosses, reinterpret_cast<Pair>(after), reinterpret_cast<Pair>(next)));
    exit += between_major;
  }
  if (!(exit > ray.length)) {
    ray.next[kA] = next[0];
    ray.next[kB] = next[1];
    ray.next[kMajor] = exit;
    return markVoxels(ray, place, end, false);
  }
  // The last slab: a border of another axis is crossed if its time comes before the ray's length.
  // The voxel entered by the last crossing stays unmarked, and so do the end and all voxels after it.
  const Times lengths{ray.length, ray.length}, swapped{next[1], next[0]};
  const Pair crosses = next <= lengths, moves = crosses & steps, in_order = next <= swapped;
  const std::int64_t second = place + either(in_order[0], moves[0], moves[1]);
  const std::int64_t first_counts = -static_cast<std::int64_t>(place != end);
  const std::int64_t second_counts = first_counts & -static_cast<std::int64_t>(second != end);
  cells[either((crosses[0] | crosses[1]) & first_counts, place, window_.sink())] = Mark::FREE;
  cells[either(crosses[0] & crosses[1] & second_counts, second, window_.sink())] = Mark::FREE;
}

void DenseRayTraversal::markVoxels(Ray& ray, std::int64_t place, std::int64_t end,
                                   bool at_origin) const {
  WindowCursor cursor{window_.cells(), place, end, window_.strides()};
  for (unsigned axis = 0; axis < 3; ++axis)
    if (!ray.forward[axis]) cursor.steps[axis] = -cursor.steps[axis];
  traverseVoxels(ray, cursor, at_origin);
}

}  // namespace grid_path_planner::mapping
