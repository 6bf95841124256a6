#include "planners/any_angle/polyanya_mesh.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "grid_path_planner/planners/connections.h"

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using costmap::SegmentPoint;
using grid::CellRect;

namespace {

constexpr std::int32_t kUnit = static_cast<std::int32_t>(SegmentPoint::kUnitsPerCell);

bool fromTheWest(const PolyanyaMesh::Border& a, const PolyanyaMesh::Border& b) {
  return a.west < b.west;
}

// Its block and corners are found later.
PolyanyaMesh::Border borderOf(const Connection& connection) {
  PolyanyaMesh::Border border{};
  border.west = connection.first * kUnit;
  border.east = (connection.first + connection.length) * kUnit;
  border.to = connection.to;
  border.block = PolyanyaMesh::kNone;
  border.corner = {PolyanyaMesh::kNone, PolyanyaMesh::kNone};
  return border;
}

// The depth-first search of Hopcroft & Tarjan. `low` is the lowest visiting number that a rectangle's
// subtree is connected to; where that is its parent's, a block is complete.
class BlockSearch {
 public:
  explicit BlockSearch(const PolyanyaMesh& mesh)
      : block_above(mesh.rectangles(), PolyanyaMesh::kNone),
        mesh_(mesh),
        order_(mesh.rectangles(), 0),
        low_(mesh.rectangles(), 0),
        next_(mesh.rectangles(), 0),
        parent_(mesh.rectangles(), PolyanyaMesh::kNone) {}

  // Visits all that is connected to `root`, unless it was visited before.
  void visitFrom(std::uint32_t root, StopPoll& poll) {
    if (order_[root] == 0) discover(root);
    while (!stack_.empty()) {
      poll();
      const std::uint32_t rect = stack_.back();
      if (next_[rect] == mesh_.rectangle(rect).first[2])
        finish(rect);
      else
        visitBorder(rect, mesh_.border(next_[rect]++).to);
    }
  }

  std::vector<std::uint32_t> visited;       // in order
  std::vector<std::uint32_t> block_above;   // of a rectangle
  std::vector<std::uint32_t> block_parent;  // the rectangle above a block

 private:
  void discover(std::uint32_t rect) {
    visited.push_back(rect);
    order_[rect] = low_[rect] = static_cast<std::uint32_t>(visited.size());
    next_[rect] = mesh_.rectangle(rect).first[0];
    stack_.push_back(rect);
    unassigned_.push_back(rect);
  }

  void visitBorder(std::uint32_t rect, std::uint32_t to) {
    if (order_[to] == 0) {
      parent_[to] = rect;
      discover(to);
    } else if (to != parent_[rect]) {
      low_[rect] = std::min(low_[rect], order_[to]);
    }
  }

  void finish(std::uint32_t rect) {
    const std::uint32_t parent = parent_[rect];
    stack_.pop_back();
    if (parent == PolyanyaMesh::kNone) return unassigned_.clear();
    low_[parent] = std::min(low_[parent], low_[rect]);
    if (low_[rect] < order_[parent]) return;
    const auto block = static_cast<std::uint32_t>(block_parent.size());
    block_parent.push_back(parent);
    for (std::uint32_t last = PolyanyaMesh::kNone; last != rect;) {
      last = unassigned_.back();
      unassigned_.pop_back();
      block_above[last] = block;
    }
  }

  const PolyanyaMesh& mesh_;
  std::vector<std::uint32_t> order_;  // of the visit, 0 before it
  std::vector<std::uint32_t> low_;
  std::vector<std::uint32_t> next_;    // border to be visited
  std::vector<std::uint32_t> parent_;  // in the search tree
  std::vector<std::uint32_t> stack_;
  std::vector<std::uint32_t> unassigned_;  // visited, and in no block yet
};

}  // namespace

PolyanyaMesh::PolyanyaMesh(const std::vector<CellRect>& rectangles, const StopToken& stop) {
  addBorders(rectangles, stop);
  findBlocks(stop);
  addCorners(stop);
}

void PolyanyaMesh::addBorders(const std::vector<CellRect>& rectangles, const StopToken& stop) {
  StopPoll poll(stop);
  const Connections connections(rectangles, Touching::BORDERS, stop);
  rectangles_.reserve(rectangles.size());
  borders_.reserve(connections.size());
  std::array<std::vector<const Connection*>, 2> sides;  // by Heading
  for (std::uint32_t i = 0; i < rectangles.size(); ++i) {
    poll();
    for (const Connection& connection : connections.of(i)) {
      assert(connection.side != Side::EAST && connection.side != Side::WEST);
      sides[connection.side == Side::NORTH ? NORTHWARDS : SOUTHWARDS].push_back(&connection);
    }
    const CellRect& cells = rectangles[i];
    Rectangle rect{cells.column * kUnit,
                   (cells.column + cells.width) * kUnit,
                   {cells.row * kUnit, (cells.row + cells.height) * kUnit},
                   {static_cast<std::uint32_t>(borders_.size()), 0, 0}};
    for (const Heading heading : {SOUTHWARDS, NORTHWARDS}) {
      std::sort(sides[heading].begin(), sides[heading].end(),
                [](const Connection* a, const Connection* b) { return a->first < b->first; });
      for (const Connection* connection : sides[heading]) borders_.push_back(borderOf(*connection));
      rect.first[heading + 1] = static_cast<std::uint32_t>(borders_.size());
      sides[heading].clear();
    }
    rectangles_.push_back(rect);
  }
}

void PolyanyaMesh::findBlocks(const StopToken& stop) {
  StopPoll poll(stop);
  BlockSearch search(*this);
  for (std::uint32_t i = 0; i < rectangles_.size(); ++i) search.visitFrom(i, poll);
  block_above_ = std::move(search.block_above);
  block_parent_ = std::move(search.block_parent);
  depth_.assign(rectangles_.size(), 0);
  for (const std::uint32_t rect : search.visited) {
    poll();
    if (block_above_[rect] != kNone) depth_[rect] = depth_[block_parent_[block_above_[rect]]] + 1;
  }
  for (std::uint32_t from = 0; from < rectangles_.size(); ++from) {
    poll();
    for (std::uint32_t i = rectangles_[from].first[0]; i < rectangles_[from].first[2]; ++i)
      borders_[i].block = blockOf(from, borders_[i].to);
  }
}

std::uint32_t PolyanyaMesh::blockOf(std::uint32_t from, std::uint32_t to) const {
  const std::uint32_t above = block_above_[to];
  return above != kNone && block_parent_[above] == from ? above : block_above_[from];
}

// The same border as the rectangle to the north has it.
std::uint32_t PolyanyaMesh::twin(std::uint32_t south, std::uint32_t border) const {
  const Rectangle& north = rectangles_[borders_[border].to];
  const auto first = borders_.begin() + north.first[0], end = borders_.begin() + north.first[1];
  const auto found = std::lower_bound(first, end, borders_[border], fromTheWest);
  assert(found != end && found->to == south);
  static_cast<void>(south);
  return static_cast<std::uint32_t>(found - borders_.begin());
}

std::uint32_t PolyanyaMesh::addCorner(MeshPoint at, int quarter, std::uint32_t south,
                                      std::uint32_t border) {
  const Border& between = borders_[border];
  corners_.push_back({at, {kNone, kNone}, {south, between.to}, between.block, quarter});
  return static_cast<std::uint32_t>(corners_.size() - 1);
}

// At an end of a border one of the two rectangles ends, and there is a corner; or both do.
void PolyanyaMesh::addCornersOf(std::uint32_t south, std::uint32_t border) {
  const Rectangle lower = rectangles_[south], upper = rectangles_[borders_[border].to];
  std::array<std::uint32_t, 2> found = {kNone, kNone};
  if (lower.west != upper.west) {
    const MeshPoint at{std::max(lower.west, upper.west), lower.line[NORTHWARDS]};
    found[WEST] = addCorner(at, lower.west < upper.west ? 1 : 2, south, border);
  }
  if (lower.east != upper.east) {
    const MeshPoint at{std::min(lower.east, upper.east), lower.line[NORTHWARDS]};
    found[EAST] = addCorner(at, lower.east > upper.east ? 0 : 3, south, border);
  }
  borders_[border].corner = borders_[twin(south, border)].corner = found;
  link(found[WEST], found[EAST]);
}

void PolyanyaMesh::link(std::uint32_t west, std::uint32_t east) {
  if (west == kNone || east == kNone) return;
  corners_[west].along[EAST] = east;
  corners_[east].along[WEST] = west;
}

// Links the corners at the ends of the walls between borders on one side of a rectangle.
void PolyanyaMesh::linkAlong(std::uint32_t first, std::uint32_t end) {
  for (; first + 1 < end; ++first)
    link(borders_[first].corner[EAST], borders_[first + 1].corner[WEST]);
}

void PolyanyaMesh::addCorners(const StopToken& stop) {
  StopPoll poll(stop);
  for (std::uint32_t south = 0; south < rectangles_.size(); ++south)
    for (std::uint32_t i = rectangles_[south].first[1]; i < rectangles_[south].first[2]; ++i) {
      poll();
      addCornersOf(south, i);
    }
  for (const Rectangle& rect : rectangles_) {
    poll();
    linkAlong(rect.first[0], rect.first[1]);
    linkAlong(rect.first[1], rect.first[2]);
  }
  for (const Rectangle& rect : rectangles_) {
    poll();
    for (std::uint32_t i = rect.first[0]; i < rect.first[2]; ++i)
      for (const Direction direction : {WEST, EAST}) {
        Border& border = borders_[i];
        const std::uint32_t corner = border.corner[direction];
        border.leads_on[direction] = corner != kNone && behind(rect, border, direction) &&
                                     corners_[corner].along[direction] != kNone;
      }
  }
}

bool PolyanyaMesh::blocksBetween(std::uint32_t start, std::uint32_t goal,
                                 std::vector<std::uint32_t>& blocks) const {
  blocks.clear();
  while (start != goal) {
    const std::uint32_t a = block_above_[start], b = block_above_[goal];
    if (a == b && a == kNone) return false;
    if (a == b) {
      blocks.push_back(a);
      return true;
    }
    const std::uint32_t depth = depth_[start];
    if (depth >= depth_[goal]) {
      blocks.push_back(a);
      start = block_parent_[a];
    }
    if (depth <= depth_[goal]) {
      blocks.push_back(b);
      goal = block_parent_[b];
    }
  }
  return true;
}

std::size_t PolyanyaMesh::bytes() const {
  return rectangles_.capacity() * sizeof(Rectangle) + borders_.capacity() * sizeof(Border) +
         corners_.capacity() * sizeof(Corner) +
         (block_above_.capacity() + depth_.capacity() + block_parent_.capacity()) *
             sizeof(std::uint32_t);
}

}  // namespace grid_path_planner::planners
