// The rectangles of a map as a convex mesh, laid out for a search that sees through borders.
//
//   RectangleMesh mesh(rectangles, free, stop);
//   mesh.rectangle(7).first[Side] ... first[Side + 1]   // its borders on that side, anticlockwise
//
// A border is the part of a side that two rectangles share, seen from one of them. Where one of its
// ends is a corner at which a taut way can turn, one blocked cell among three free ones, it knows
// the corner.
//
// Two rectangles that can be left in one way only need not be entered by a shortest way between
// others: rectangles are convex, so a shortest way enters none twice, and the borders that it
// crosses lie in the blocks (biconnected components: Hopcroft & Tarjan 1973) between the one that
// holds the start and the one that holds the goal. Every border knows its block.
//
// Points are in 1/4096 cell, as SegmentPoint's, in 32 bits: sides up to kMaxSide cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/rectangles/rectangle_map.h"
#include "grid_path_planner/terrain/bit_maps.h"
#include "grid_path_planner/terrain/segment.h"

namespace grid_path_planner {

// A point or a direction.
struct MeshPoint {
  std::int32_t x = 0;
  std::int32_t y = 0;

  friend MeshPoint operator-(MeshPoint a, MeshPoint b) { return {a.x - b.x, a.y - b.y}; }
  friend bool operator==(MeshPoint a, MeshPoint b) { return a.x == b.x && a.y == b.y; }
  friend bool operator<(MeshPoint a, MeshPoint b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }
};

// Above 0 where b lies anticlockwise of a.
inline std::int64_t cross(MeshPoint a, MeshPoint b) {
  return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
}

class RectangleMesh {
 public:
  static constexpr int kMaxSide = (1 << 18) - 1;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  // Which way a way turns.
  enum Turn { ANTICLOCKWISE, CLOCKWISE };

  struct Rectangle {
    MeshPoint low;
    MeshPoint high;
    // By Side, and the end: its borders. Within a side anticlockwise too.
    std::array<std::uint32_t, 5> first;

    // Where the side ends, anticlockwise.
    MeshPoint end(int side) const {
      return {side == 0 || side == 3 ? high.x : low.x, side < 2 ? high.y : low.y};
    }
  };

  struct Border {
    MeshPoint right;  // its ends, as one sees it who leaves
    MeshPoint left;
    std::uint32_t to;
    std::uint32_t block;
    std::uint32_t right_corner;  // kNone where no way turns there
    std::uint32_t left_corner;
  };

  struct Corner {
    MeshPoint at;
    std::array<std::uint32_t, 2> rectangle;  // by Turn: the one in which a way goes on
    // Of the blocked cell, quarters being numbered anticlockwise from the north-east.
    std::int32_t quarter;
  };

  RectangleMesh() = default;
  // `free`: the cells that the rectangles cover. Throws Stopped.
  RectangleMesh(const RectangleMap& map, const BitMap& free, const StopToken& stop);

  const Rectangle& rectangle(std::uint32_t number) const { return rectangles_[number]; }
  const Border& border(std::uint32_t number) const { return borders_[number]; }
  const Corner& corner(std::uint32_t number) const { return corners_[number]; }
  std::size_t corners() const { return corners_.size(); }
  std::size_t blocks() const { return block_parent_.size(); }

  // The blocks that a shortest way may pass. False where no way leads.
  bool blocksBetween(std::uint32_t start, std::uint32_t goal,
                     std::vector<std::uint32_t>& blocks) const;

  std::size_t bytes() const;

 private:
  void addBorders(const RectangleMap& map, const StopToken& stop);
  void addCorners(const BitMap& free, const StopToken& stop);
  void findBlocks(const StopToken& stop);
  std::uint32_t blockOf(std::uint32_t from, std::uint32_t to) const;

  std::vector<Rectangle> rectangles_;
  std::vector<Border> borders_;
  std::vector<Corner> corners_;
  // The tree of blocks: above a rectangle its block, above a block the rectangle that it hangs on.
  std::vector<std::uint32_t> block_above_;  // kNone: the topmost
  std::vector<std::uint32_t> depth_;        // blocks above a rectangle
  std::vector<std::uint32_t> block_parent_;
};

}  // namespace grid_path_planner
