// The projection of interval nodes through the borders of a mesh of rectangles, in one query.
//
// An interval node is the part of a rectangle's far side that is visible from its root between two
// rays. Points and rays are whole numbers and every decision is the sign of a difference of two
// products of them, so all are exact.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <vector>

#include "planners/any_angle/polyanya_mesh.h"
#include "planners/core/stamped_array.h"

namespace grid_path_planner::planners {

// A direction: columns to the east for lines ahead, which are 0 or more.
struct MeshRay {
  std::int32_t columns;
  std::int32_t lines;
};

// Where a point lies of a ray, so many columns and lines from the root: east of it above 0.
inline std::int64_t eastOf(const MeshRay& ray, std::int64_t columns, std::int64_t lines) {
  return columns * ray.lines - ray.columns * lines;
}

// An interval node that is about to cross a rectangle; or a flat node: the next corner along the
// line on which its root lies.
struct PolyanyaNode {
  static constexpr std::int8_t kInterval = -1;

  MeshRay ray[2];  // by Direction
  std::int32_t root;
  std::uint32_t place;            // the rectangle, or the corner
  PolyanyaMesh::Heading heading;  // of an interval node
  std::int8_t along;              // a flat node's Direction along the line, else kInterval

  bool flat() const { return along != kInterval; }
};

class PolyanyaProjection {
 public:
  using Direction = PolyanyaMesh::Direction;
  using Heading = PolyanyaMesh::Heading;

  // How a projection ends: with no successor, in the goal's rectangle, at borders that split the
  // interval or at one where a path can turn, or after as many borders as were allowed.
  enum class End { NO_SUCCESSOR, GOAL, BORDERS, LIMIT };

  // The far side of a rectangle: its borders from the first visible one on.
  struct FarSide {
    std::int32_t lines;  // from the root
    std::uint32_t first;
    std::uint32_t end;
  };

  // False where no path leads from one rectangle to the other.
  bool startQuery(const PolyanyaMesh& mesh, std::uint32_t start, std::uint32_t goal);

  // Whether a shortest path can pass the block, or the border: it enters the start's rectangle not
  // again.
  bool allowed(std::uint32_t block) const { return stamp_.wrote(block_stamps_[block]); }
  bool allowed(const PolyanyaMesh::Border& border) const {
    return allowed(border.block) && border.to != start_;
  }

  // Whether a taut path can turn at that end of the border, so many columns and lines from the
  // root, and has a successor there.
  bool turns(const PolyanyaMesh::Rectangle& from, const PolyanyaMesh::Border& border,
             Direction direction, Heading heading, std::int32_t columns, std::int32_t lines) const;

  // Moves the interval node on through at most `borders` borders, while nothing splits it and no
  // taut path turns at its ends. `far`: the borders at which it stops.
  End project(MeshPoint root, PolyanyaNode& node, FarSide& far, int& borders) const;

  std::size_t bytes() const {
    return (blocks_.capacity() + block_stamps_.capacity()) * sizeof(std::uint32_t);
  }

 private:
  // Sides with more borders than these are bisected.
  static constexpr std::uint32_t kFewBorders = 8;

  std::uint32_t firstVisible(std::uint32_t first, std::uint32_t end, std::int32_t root,
                             MeshRay west, std::int32_t lines) const;

  const PolyanyaMesh* mesh_ = nullptr;
  std::uint32_t start_ = 0;  // rectangles
  std::uint32_t goal_ = 0;
  std::vector<std::uint32_t> blocks_;  // that a shortest path may pass
  std::vector<std::uint32_t> block_stamps_;
  QueryStamp<std::uint32_t> stamp_;  // of these blocks
};

inline bool PolyanyaProjection::startQuery(const PolyanyaMesh& mesh, std::uint32_t start,
                                           std::uint32_t goal) {
  mesh_ = &mesh;
  start_ = start;
  goal_ = goal;
  if (block_stamps_.size() != mesh.blocks()) {
    block_stamps_.assign(mesh.blocks(), 0);
    stamp_.restart();
  } else {
    stamp_.next([this] { block_stamps_.assign(block_stamps_.size(), 0); });
  }
  if (!mesh.blocksBetween(start, goal, blocks_)) return false;
  for (const std::uint32_t block : blocks_) block_stamps_[block] = stamp_.word();
  return true;
}

inline bool PolyanyaProjection::turns(const PolyanyaMesh::Rectangle& from,
                                      const PolyanyaMesh::Border& border, Direction direction,
                                      Heading heading, std::int32_t columns,
                                      std::int32_t lines) const {
  const bool east = direction == Direction::EAST;
  if (border.corner[direction] == PolyanyaMesh::kNone) return false;
  if (!PolyanyaMesh::behind(from, border, direction) && (east ? columns >= 0 : columns <= 0))
    return false;
  if (border.to == goal_ || border.leads_on[direction]) return true;
  // Of the next far side, the border that is farthest round the corner.
  const PolyanyaMesh::Rectangle& next = mesh_->rectangle(border.to);
  const std::uint32_t first = next.first[heading], end = next.first[heading + 1];
  if (first == end) return false;
  const std::int64_t limit = std::int64_t{columns} * (next.line[1] - next.line[0]);
  return east ? std::int64_t{mesh_->border(end - 1).east - border.east} * lines > limit
              : std::int64_t{mesh_->border(first).west - border.west} * lines < limit;
}

// Of borders in order the westernmost that reaches to the east of the ray.
inline std::uint32_t PolyanyaProjection::firstVisible(std::uint32_t first, std::uint32_t end,
                                                      std::int32_t root, MeshRay west,
                                                      std::int32_t lines) const {
  const std::int64_t limit = std::int64_t{west.columns} * lines;
  const auto hidden = [&](std::uint32_t i) {
    return std::int64_t{mesh_->border(i).east - root} * west.lines <= limit;
  };
  std::uint32_t last = end;
  while (last - first > kFewBorders) {
    const std::uint32_t middle = first + (last - first) / 2;
    if (hidden(middle))
      first = middle + 1;
    else
      last = middle;
  }
  while (first < last && hidden(first)) ++first;
  return first;
}

inline PolyanyaProjection::End PolyanyaProjection::project(MeshPoint root, PolyanyaNode& node,
                                                           FarSide& far, int& borders) const {
  const Heading heading = node.heading;
  MeshRay west = node.ray[Direction::WEST], east = node.ray[Direction::EAST];
  std::uint32_t place = node.place, first = 0, end = 0;
  std::int32_t lines = 0;
  int left = borders;
  End result = End::NO_SUCCESSOR;
  for (;; --left) {
    if (place == goal_ || left <= 0) {
      result = place == goal_ ? End::GOAL : End::LIMIT;
      break;
    }
    const PolyanyaMesh::Rectangle& rect = mesh_->rectangle(place);
    lines = std::abs(rect.line[heading] - root.y);
    end = rect.first[heading + 1];
    first = firstVisible(rect.first[heading], end, root.x, west, lines);
    if (first == end) break;
    const PolyanyaMesh::Border& border = mesh_->border(first);
    const std::int32_t west_end = border.west - root.x, east_end = border.east - root.x;
    if (eastOf(east, west_end, lines) >= 0) break;
    if (eastOf(west, west_end, lines) >= 0) {
      if (turns(rect, border, Direction::WEST, heading, west_end, lines)) {
        result = End::BORDERS;
        break;
      }
      west = {west_end, lines};
    }
    if (eastOf(east, east_end, lines) <= 0) {
      if (turns(rect, border, Direction::EAST, heading, east_end, lines) ||
          (first + 1 < end && eastOf(east, mesh_->border(first + 1).west - root.x, lines) < 0)) {
        result = End::BORDERS;
        break;
      }
      east = {east_end, lines};
    }
    if (!allowed(border)) break;
    place = border.to;
  }
  node.ray[Direction::WEST] = west;
  node.ray[Direction::EAST] = east;
  node.place = place;
  borders = left;
  far = {lines, first, end};
  return result;
}

}  // namespace grid_path_planner::planners
