// Rectangles as wide as the free space lets them (mergedRuns), as a convex mesh for the projection
// of intervals through borders.
//
//   PolyanyaMesh mesh(mergedRuns(free_cells, stop), stop);
//   const PolyanyaMesh::Rectangle& rect = mesh.rectangle(7);
//   const std::uint32_t end = rect.first[PolyanyaMesh::NORTHWARDS + 1];
//   for (std::uint32_t i = rect.first[PolyanyaMesh::NORTHWARDS]; i < end; ++i)
//     use(mesh.border(i));  // of its north side, eastwards
//
// Such rectangles have no neighbours to the east and west, so a border ends only where there is a
// blocked cell, and only obstacles split an interval. Where one blocked cell is among three free
// ones, a taut path can turn: a corner.
//
// A shortest path enters no dead ends: rectangles are convex, so it enters none twice, and the
// borders that it crosses lie in the blocks (biconnected components: Hopcroft & Tarjan 1973) on the
// path of the block tree from the start's rectangle to the goal's. Every border has its block.
//
// Points are in 1/4096 cell, as SegmentPoint's, in 32 bits: sides up to kMaxSide cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/line_of_sight.h"
#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::planners {

// A point or a direction.
struct MeshPoint {
  std::int32_t x = 0;
  std::int32_t y = 0;

  friend MeshPoint operator-(MeshPoint a, MeshPoint b) { return {a.x - b.x, a.y - b.y}; }
};

// Above 0 where b lies anticlockwise of a.
inline std::int64_t cross(MeshPoint a, MeshPoint b) {
  return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
}

class PolyanyaMesh {
 public:
  static constexpr int kMaxSide = (1 << 18) - 1;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  enum Direction { WEST, EAST };
  enum Heading { SOUTHWARDS, NORTHWARDS };

  // Two in a cache line, like the borders: it measures 2 to 5 % faster.
  struct alignas(32) Rectangle {
    std::int32_t west;
    std::int32_t east;
    std::array<std::int32_t, 2> line;  // where it ends, southwards and northwards
    // Its borders, each side's from the west: [first[0], first[1]) on the south side,
    // [first[1], first[2]) on the north side.
    std::array<std::uint32_t, 3> first;
  };

  // The shared part of the sides of two rectangles, stored for each of them.
  struct alignas(32) Border {
    std::int32_t west;
    std::int32_t east;
    std::uint32_t to;
    std::uint32_t block;
    std::array<std::uint32_t, 2> corner;  // by Direction, at its ends; kNone where no path turns
    // By Direction: the corner's obstacle is behind, and its wall leads along the line to another corner.
    std::array<bool, 2> leads_on;
  };

  struct Corner {
    MeshPoint at;
    std::array<std::uint32_t, 2> along;  // by Direction: the next on the line, kNone beyond a wall
    std::array<std::uint32_t, 2> rectangle;  // by Heading: the one that begins there
    std::uint32_t block;                     // of the border that ends here
    // Of the blocked cell, quarters being numbered anticlockwise from the north-east.
    std::int32_t quarter;
  };

  // Whether the obstacle at the end of a border ends at the border's line, in the direction from
  // `from` across the border; else it begins there.
  static bool behind(const Rectangle& from, const Border& border, Direction direction) {
    return direction == EAST ? border.east == from.east : border.west == from.west;
  }

  PolyanyaMesh() = default;
  // Throws Stopped. Precondition: they are disjoint, none is empty, and none has a neighbour to its
  // east or west.
  PolyanyaMesh(const std::vector<grid::CellRect>& rectangles, const base::StopToken& stop);

  const Rectangle& rectangle(std::uint32_t number) const { return rectangles_[number]; }
  const Border& border(std::uint32_t number) const { return borders_[number]; }
  const Corner& corner(std::uint32_t number) const { return corners_[number]; }
  std::size_t rectangles() const { return rectangles_.size(); }
  std::size_t borders() const { return borders_.size(); }  // each counted from both sides
  std::size_t corners() const { return corners_.size(); }
  std::size_t blocks() const { return block_parent_.size(); }

  // The blocks that a shortest path may pass. False where there is no path.
  bool blocksBetween(std::uint32_t start, std::uint32_t goal,
                     std::vector<std::uint32_t>& blocks) const;

  std::size_t bytes() const;

 private:
  void addBorders(const std::vector<grid::CellRect>& rectangles, const base::StopToken& stop);
  void findBlocks(const base::StopToken& stop);
  std::uint32_t blockOf(std::uint32_t from, std::uint32_t to) const;
  void addCorners(const base::StopToken& stop);
  void addCornersOf(std::uint32_t south, std::uint32_t border);
  std::uint32_t addCorner(MeshPoint at, int quarter, std::uint32_t south, std::uint32_t border);
  std::uint32_t twin(std::uint32_t from, std::uint32_t border) const;
  void link(std::uint32_t west, std::uint32_t east);
  void linkAlong(std::uint32_t first, std::uint32_t end);

  std::vector<Rectangle> rectangles_;
  std::vector<Border> borders_;
  std::vector<Corner> corners_;
  // The block tree: the parent of a rectangle is its block, that of a block is a rectangle.
  std::vector<std::uint32_t> block_above_;  // kNone: the topmost
  std::vector<std::uint32_t> depth_;        // blocks above a rectangle
  std::vector<std::uint32_t> block_parent_;
};

}  // namespace grid_path_planner::planners
