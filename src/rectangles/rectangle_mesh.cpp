#include "grid_path_planner/rectangles/rectangle_mesh.h"

#include <algorithm>
#include <optional>

namespace grid_path_planner {
namespace {

constexpr std::int32_t kUnit = static_cast<std::int32_t>(SegmentPoint::kUnitsPerCell);

MeshPoint latticePoint(int column, int row) {
  return {column * kUnit, row * kUnit};
}

RectangleMesh::Border borderOf(const CellRect& from, const Connection& connection) {
  const bool upright = connection.side == Side::EAST || connection.side == Side::WEST;
  const int line = connection.side == Side::EAST    ? from.column + from.width
                   : connection.side == Side::WEST  ? from.column
                   : connection.side == Side::NORTH ? from.row + from.height
                                                    : from.row;
  const auto point = [upright, line](int along) {
    return upright ? latticePoint(line, along) : latticePoint(along, line);
  };
  RectangleMesh::Border border{};
  border.right = point(connection.first);
  border.left = point(connection.first + connection.length);
  if (connection.side == Side::NORTH || connection.side == Side::WEST)
    std::swap(border.right, border.left);
  border.to = connection.to;
  border.right_corner = border.left_corner = RectangleMesh::kNone;
  return border;
}

// The cell of each quarter around a lattice point.
Cell cellInQuarter(MeshPoint point, int quarter) {
  const int column = point.x / kUnit, row = point.y / kUnit;
  return {quarter == 0 || quarter == 3 ? column : column - 1, quarter < 2 ? row : row - 1};
}

// The quarter of the only blocked cell around the point.
std::optional<int> cornerQuarter(const BitMap& free, MeshPoint point) {
  std::optional<int> blocked;
  for (int quarter = 0; quarter < 4; ++quarter) {
    if (free[cellInQuarter(point, quarter)]) continue;
    if (blocked) return std::nullopt;
    blocked = quarter;
  }
  return blocked;
}

bool holds(const RectangleMesh::Rectangle& rect, Cell cell) {
  const MeshPoint low = latticePoint(cell.column, cell.row);
  return rect.low.x <= low.x && low.x < rect.high.x && rect.low.y <= low.y && low.y < rect.high.y;
}

}  // namespace

RectangleMesh::RectangleMesh(const RectangleMap& map, const BitMap& free, const StopToken& stop) {
  addBorders(map, stop);
  addCorners(free, stop);
  findBlocks(stop);
}

void RectangleMesh::addBorders(const RectangleMap& map, const StopToken& stop) {
  StopPoll poll(stop);
  rectangles_.reserve(map.rectangles().size());
  borders_.reserve(map.connections().size());
  std::array<std::vector<Border>, 4> sides;
  for (std::uint32_t i = 0; i < map.rectangles().size(); ++i) {
    poll();
    const CellRect& cells = map.rectangles()[i];
    Rectangle rect{latticePoint(cells.column, cells.row),
                   latticePoint(cells.column + cells.width, cells.row + cells.height),
                   {}};
    for (const Connection& connection : map.connections().of(i))
      if (connection.side != Side::CORNER)
        sides[static_cast<int>(connection.side)].push_back(borderOf(cells, connection));
    for (int side = 0; side < 4; ++side) {
      rect.first[side] = static_cast<std::uint32_t>(borders_.size());
      const bool ascending = side == static_cast<int>(Side::EAST) ||  //
                             side == static_cast<int>(Side::SOUTH);
      std::sort(sides[side].begin(), sides[side].end(), [=](const Border& a, const Border& b) {
        return ascending ? a.right < b.right : b.right < a.right;
      });
      borders_.insert(borders_.end(), sides[side].begin(), sides[side].end());
      sides[side].clear();
    }
    rect.first[4] = static_cast<std::uint32_t>(borders_.size());
    rectangles_.push_back(rect);
  }
}

void RectangleMesh::addCorners(const BitMap& free, const StopToken& stop) {
  StopPoll poll(stop);
  struct End {
    MeshPoint at;
    std::uint32_t border;
    bool left;
    std::uint32_t from;
  };
  std::vector<End> ends;
  for (std::uint32_t from = 0; from < rectangles_.size(); ++from)
    for (std::uint32_t i = rectangles_[from].first[0]; i < rectangles_[from].first[4]; ++i) {
      poll();
      ends.push_back({borders_[i].right, i, false, from});
      ends.push_back({borders_[i].left, i, true, from});
    }
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.at < b.at; });
  for (std::size_t begin = 0, end = 0; begin < ends.size(); begin = end) {
    poll();
    const MeshPoint at = ends[begin].at;
    while (end < ends.size() && ends[end].at == at) ++end;
    const std::optional<int> quarter = cornerQuarter(free, at);
    if (!quarter) continue;
    Corner corner{at, {kNone, kNone}, *quarter};
    const Cell cells[] = {cellInQuarter(at, (*quarter + 3) % 4),
                          cellInQuarter(at, (*quarter + 1) % 4)};
    for (std::size_t i = begin; i < end; ++i) {
      const auto number = static_cast<std::uint32_t>(corners_.size());
      (ends[i].left ? borders_[ends[i].border].left_corner
                    : borders_[ends[i].border].right_corner) = number;
      for (const Turn turn : {ANTICLOCKWISE, CLOCKWISE})
        if (holds(rectangles_[ends[i].from], cells[turn])) corner.rectangle[turn] = ends[i].from;
    }
    corners_.push_back(corner);
  }
}

// A depth-first search over the rectangles. `low` is the earliest one that a rectangle reaches
// past the one above it; where that is the one above, a block ends.
void RectangleMesh::findBlocks(const StopToken& stop) {
  StopPoll poll(stop);
  const std::size_t count = rectangles_.size();
  block_above_.assign(count, kNone);
  std::vector<std::uint32_t> order(count, 0), low(count, 0), next(count, 0), above(count, kNone);
  std::vector<std::uint32_t> by_order, way, open;
  by_order.reserve(count);
  const auto enter = [&](std::uint32_t rect) {
    by_order.push_back(rect);
    order[rect] = low[rect] = static_cast<std::uint32_t>(by_order.size());
    next[rect] = rectangles_[rect].first[0];
    way.push_back(rect);
    open.push_back(rect);
  };
  const auto leave = [&](std::uint32_t rect) {
    const std::uint32_t parent = above[rect];
    way.pop_back();
    if (parent == kNone) return open.clear();
    low[parent] = std::min(low[parent], low[rect]);
    if (low[rect] < order[parent]) return;
    const auto block = static_cast<std::uint32_t>(block_parent_.size());
    block_parent_.push_back(parent);
    for (std::uint32_t last = kNone; last != rect;) {
      last = open.back();
      open.pop_back();
      block_above_[last] = block;
    }
  };
  for (std::uint32_t root = 0; root < count; ++root) {
    if (order[root] != 0) continue;
    enter(root);
    while (!way.empty()) {
      poll();
      const std::uint32_t rect = way.back();
      if (next[rect] == rectangles_[rect].first[4]) {
        leave(rect);
        continue;
      }
      const std::uint32_t to = borders_[next[rect]++].to;
      if (order[to] == 0) {
        above[to] = rect;
        enter(to);
      } else if (to != above[rect]) {
        low[rect] = std::min(low[rect], order[to]);
      }
    }
  }
  depth_.assign(count, 0);
  for (const std::uint32_t rect : by_order)
    if (block_above_[rect] != kNone) depth_[rect] = depth_[block_parent_[block_above_[rect]]] + 1;
  for (std::uint32_t from = 0; from < count; ++from)
    for (std::uint32_t i = rectangles_[from].first[0]; i < rectangles_[from].first[4]; ++i)
      borders_[i].block = blockOf(from, borders_[i].to);
}

std::uint32_t RectangleMesh::blockOf(std::uint32_t from, std::uint32_t to) const {
  const std::uint32_t above = block_above_[to];
  return above != kNone && block_parent_[above] == from ? above : block_above_[from];
}

bool RectangleMesh::blocksBetween(std::uint32_t start, std::uint32_t goal,
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

std::size_t RectangleMesh::bytes() const {
  return rectangles_.capacity() * sizeof(Rectangle) + borders_.capacity() * sizeof(Border) +
         corners_.capacity() * sizeof(Corner) +
         (block_above_.capacity() + depth_.capacity() + block_parent_.capacity()) *
             sizeof(std::uint32_t);
}

}  // namespace grid_path_planner
