#include "mapping/seabed.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grid_path_planner::mapping {
namespace {

std::uint32_t hashKey(int x, int y) {
  return static_cast<std::uint32_t>(x) << 16 | static_cast<std::uint32_t>(y);
}

std::uint32_t hashKey(BrickColumn column) {
  return hashKey(column.x, column.y);
}

// Along one axis, between the nearest two of `one_length` cells from `one` on and of `other_length` from `other` on.
int gap(int one, int one_length, int other, int other_length) {
  return std::max({other - (one + one_length - 1), one - (other + other_length - 1), 0});
}

// Of any cells of the tree: in int the squares overflow.
double length(double dx, double dy) {
  return std::sqrt(dx * dx + dy * dy);
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
  } else if (before->second.z == now.z) {
    return false;
  } else if (now.least == kNoBottom) {
    bottoms_.erase(before);
  } else {
    before->second = now;
  }
  updateSquares(column);
  return true;
}

// Of squares that hold a bottom, as of columns.
void Seabed::updateSquares(BrickColumn column) {
  for (int level = 1; level <= kLevels; ++level) {
    const Square square{level, column.x >> level, column.y >> level};
    int least = kNoBottom;
    for (int quarter = 0; quarter < 4; ++quarter)
      least = std::min(least, leastIn(quarterOf(square, quarter % 2, quarter / 2)));
    if (least == leastIn(square)) return;
    auto& squares = squares_[static_cast<std::size_t>(level - 1)];
    if (least == kNoBottom)
      squares.erase(hashKey(square.x, square.y));
    else
      squares[hashKey(square.x, square.y)] = least;
  }
}

Seabed::Square Seabed::quarterOf(const Square& square, int right, int upper) {
  return {square.level - 1, 2 * square.x + right, 2 * square.y + upper};
}

int Seabed::leastIn(const Square& square) const {
  const std::uint32_t key = hashKey(square.x, square.y);
  if (square.level == 0) {
    const auto found = bottoms_.find(key);
    return found == bottoms_.end() ? kNoBottom : found->second.least;
  }
  const auto& squares = squares_[static_cast<std::size_t>(square.level - 1)];
  const auto found = squares.find(key);
  return found == squares.end() ? kNoBottom : found->second;
}

// By the bottoms of one brick column, which lies `dx` and `dy` columns from the one that the heights are of.
void Seabed::lowerBy(const Bottoms& bottoms, int dx, int dy, Heights& heights) const {
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      double& height = heights[static_cast<std::size_t>(8 * y + x)];
      const double nearest = length(gap(x, 1, dx, 8), gap(y, 1, dy, 8));
      if (nearest > radius_ || bottoms.least + max_slope_ * nearest >= height) continue;
      for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 8; ++column) {
          const int bottom = bottoms.z[static_cast<std::size_t>(8 * row + column)];
          if (bottom >= height) continue;
          const double distance = length(dx + column - x, dy + row - y);
          if (distance <= radius_ && bottom != kNoBottom)
            height = std::min(height, bottom + max_slope_ * distance);
        }
    }
}

// By all of a square. The quarter that is nearest first: it lowers the heights, so that most others can be passed over.
void Seabed::lowerBySquare(const Square& square, BrickColumn column, Heights& heights) const {
  const int side = 8 << square.level;
  const double nearest = length(gap(8 * column.x, 8, side * square.x, side),
                                gap(8 * column.y, 8, side * square.y, side));
  if (nearest > radius_) return;
  const int least = leastIn(square);
  if (least == kNoBottom ||
      least + max_slope_ * nearest >= *std::max_element(heights.begin(), heights.end()))
    return;
  if (square.level == 0)
    return lowerBy(bottoms_.at(hashKey(square.x, square.y)), 8 * (square.x - column.x),
                   8 * (square.y - column.y), heights);
  const int right = column.x >> (square.level - 1) > 2 * square.x ? 1 : 0;
  const int upper = column.y >> (square.level - 1) > 2 * square.y ? 1 : 0;
  for (const auto& [across, along] :
       {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)})
    lowerBySquare(quarterOf(square, right ^ across, upper ^ along), column, heights);
}

Seabed::Heights Seabed::heightsAt(BrickColumn column) const {
  Heights heights;
  heights.fill(kNone);
  lowerBySquare({kLevels, 0, 0}, column, heights);
  return heights;
}

}  // namespace grid_path_planner::mapping
