#include "mapping/seabed.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace grid_path_planner::mapping {
namespace {

std::uint32_t hashKey(BrickColumn column) {
  return static_cast<std::uint32_t>(column.x) << 16 | column.y;
}

// From `cell` to the nearest of the eight columns from `first` on, along one axis.
int distanceToRun(int cell, int first) {
  return std::max({first - cell, cell - (first + 7), 0});
}

double length(int dx, int dy) {
  return std::sqrt(static_cast<double>(dx * dx + dy * dy));
}

}  // namespace

Seabed::Seabed(double radius, double max_slope, double resolution)
    : radius_(radius / resolution),
      max_slope_(max_slope),
      reach_(static_cast<int>(std::ceil(radius_ / 8.0))) {}

Seabed::Bottoms Seabed::bottomsOf(const OccupancyBricks& bricks, BrickColumn column) {
  Bottoms bottoms;
  bottoms.z.fill(kNoBottom);
  std::array<bool, 64> lowest_seen{};
  std::array<bool, 64> free_below{};  // of the topmost voxels of the brick below
  int brick_below = -2;
  bricks.forEachBrick(column, [&](int z, const Brick& brick) {
    for (unsigned i = 0; i < lowest_seen.size(); ++i) {
      const unsigned occupied = Brick::column(brick.occupied, i % 8, i / 8);
      const unsigned free = Brick::column(brick.known, i % 8, i / 8) & ~occupied;
      if (!lowest_seen[i] && occupied != 0) {
        lowest_seen[i] = true;
        const int bit = __builtin_ctz(occupied);
        const bool hangs =
            bit > 0 ? (free >> (bit - 1) & 1u) != 0 : brick_below == z - 1 && free_below[i];
        if (!hangs) bottoms.z[i] = 8 * z + bit;
      }
      free_below[i] = (free & 0x80u) != 0;
    }
    brick_below = z;
  });
  bottoms.least = *std::min_element(bottoms.z.begin(), bottoms.z.end());
  return bottoms;
}

bool Seabed::update(const OccupancyBricks& bricks, BrickColumn column) {
  const Bottoms now = bottomsOf(bricks, column);
  const auto before = bottoms_.find(hashKey(column));
  if (before == bottoms_.end()) {
    if (now.least == kNoBottom) return false;
    bottoms_.emplace(hashKey(column), now);
    return true;
  }
  if (before->second.z == now.z) return false;
  if (now.least == kNoBottom)
    bottoms_.erase(before);
  else
    before->second = now;
  return true;
}

std::vector<Seabed::Neighbour> Seabed::neighboursOf(BrickColumn column) const {
  std::vector<Neighbour> neighbours;
  for (int dy = -reach_; dy <= reach_; ++dy)
    for (int dx = -reach_; dx <= reach_; ++dx) {
      const int x = column.x + dx;
      const int y = column.y + dy;
      if (x < 0 || y < 0 || x > UINT16_MAX || y > UINT16_MAX) continue;
      const auto found =
          bottoms_.find(hashKey({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)}));
      if (found != bottoms_.end()) neighbours.push_back({8 * dx, 8 * dy, &found->second});
    }
  // The nearest first: they lower the height, so that most others can be skipped.
  std::stable_sort(neighbours.begin(), neighbours.end(),
                   [](const Neighbour& a, const Neighbour& b) {
                     return a.dx * a.dx + a.dy * a.dy < b.dx * b.dx + b.dy * b.dy;
                   });
  return neighbours;
}

double Seabed::heightAt(int x, int y, const std::vector<Neighbour>& neighbours) const {
  double height = kNone;
  for (const Neighbour& neighbour : neighbours) {
    const double nearest = length(distanceToRun(x, neighbour.dx), distanceToRun(y, neighbour.dy));
    if (nearest > radius_ || neighbour.bottoms->least + max_slope_ * nearest >= height) continue;
    for (int row = 0; row < 8; ++row)
      for (int column = 0; column < 8; ++column) {
        const int bottom = neighbour.bottoms->z[static_cast<std::size_t>(8 * row + column)];
        if (bottom >= height) continue;
        const double distance = length(neighbour.dx + column - x, neighbour.dy + row - y);
        if (distance <= radius_ && bottom != kNoBottom)
          height = std::min(height, bottom + max_slope_ * distance);
      }
  }
  return height;
}

Seabed::Heights Seabed::heightsAt(BrickColumn column) const {
  const std::vector<Neighbour> neighbours = neighboursOf(column);
  Heights heights;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      heights[static_cast<std::size_t>(8 * y + x)] = heightAt(x, y, neighbours);
  return heights;
}

}  // namespace grid_path_planner::mapping
