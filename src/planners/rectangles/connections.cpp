#include "grid_path_planner/planners/connections.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using grid::CellRect;

namespace {

// One side of a rectangle: it lies on a grid line and covers [first, end) of it.
struct Edge {
  int line;
  int first;
  int end;
  std::uint32_t rectangle;
};

bool alongTheLine(const Edge& a, const Edge& b) {
  return std::tie(a.line, a.first) < std::tie(b.line, b.first);
}

Edge columnEdge(const CellRect& rect, bool upper, std::uint32_t number) {
  return {rect.column + (upper ? rect.width : 0), rect.row, rect.row + rect.height, number};
}

Edge rowEdge(const CellRect& rect, bool upper, std::uint32_t number) {
  return {rect.row + (upper ? rect.height : 0), rect.column, rect.column + rect.width, number};
}

struct Corner {
  int column;
  int row;
  std::uint32_t rectangle;
};

bool byPlace(const Corner& a, const Corner& b) {
  return std::tie(a.column, a.row) < std::tie(b.column, b.row);
}

// Polls in every comparison, since sorts may be long.
template <class Value>
void sortBy(bool (*before)(const Value&, const Value&), std::vector<Value>& values,
            StopPoll& poll) {
  std::sort(values.begin(), values.end(), [before, &poll](const Value& a, const Value& b) {
    poll();
    return before(a, b);
  });
}

// The sides of all rectangles along one axis, in order.
struct Edges {
  std::vector<Edge> ends;
  std::vector<Edge> begins;

  Edges(const std::vector<CellRect>& rectangles,
        Edge (*edgeOf)(const CellRect&, bool, std::uint32_t), StopPoll& poll) {
    ends.reserve(rectangles.size());
    begins.reserve(rectangles.size());
    for (std::uint32_t i = 0; i < rectangles.size(); ++i) {
      ends.push_back(edgeOf(rectangles[i], true, i));
      begins.push_back(edgeOf(rectangles[i], false, i));
    }
    sortBy(alongTheLine, ends, poll);
    sortBy(alongTheLine, begins, poll);
  }

  // The shared parts of edges on the same line, from both sides.
  template <class Visit>
  void forEachBorder(Side onwards, Side back, StopPoll& poll, Visit&& visit) const {
    auto b = begins.begin();
    for (auto a = ends.begin(); a != ends.end() && b != begins.end();) {
      poll();
      const int first = std::max(a->first, b->first);
      const int end = std::min(a->end, b->end);
      if (a->line == b->line && first < end) {
        visit(a->rectangle, Connection{b->rectangle, onwards, first, end - first});
        visit(b->rectangle, Connection{a->rectangle, back, first, end - first});
      }
      // The edge that ends first shares no part with later edges.
      if (std::tie(a->line, a->end) <= std::tie(b->line, b->end))
        ++a;
      else
        ++b;
    }
  }
};

// The corners of one direction, and the corners of the opposite direction.
struct Corners {
  std::vector<Corner> ends;
  std::vector<Corner> begins;

  // `north_east`: or else north west.
  Corners(const std::vector<CellRect>& rectangles, bool north_east, StopPoll& poll) {
    for (std::uint32_t i = 0; i < rectangles.size(); ++i) {
      const CellRect& rect = rectangles[i];
      const int west = rect.column, east = rect.column + rect.width;
      ends.push_back({north_east ? east : west, rect.row + rect.height, i});
      begins.push_back({north_east ? west : east, rect.row, i});
    }
    sortBy(byPlace, ends, poll);
    sortBy(byPlace, begins, poll);
  }

  // Pairs of rectangles whose corners coincide, from both sides.
  template <class Visit>
  void forEachPair(StopPoll& poll, Visit&& visit) const {
    auto b = begins.begin();
    for (const Corner& a : ends) {
      poll();
      while (b != begins.end() && byPlace(*b, a)) ++b;
      if (b == begins.end()) break;
      if (byPlace(a, *b)) continue;
      visit(a.rectangle, Connection{b->rectangle, Side::CORNER, 0, 0});
      visit(b->rectangle, Connection{a.rectangle, Side::CORNER, 0, 0});
    }
  }
};

Side opposite(Side side) {
  switch (side) {
    case Side::EAST:
      return Side::WEST;
    case Side::NORTH:
      return Side::SOUTH;
    case Side::WEST:
      return Side::EAST;
    case Side::SOUTH:
      return Side::NORTH;
    case Side::CORNER:
      break;
  }
  return Side::CORNER;
}

bool before(const Connection& connection, std::uint32_t to) {
  return connection.to < to;
}

// The least i with 2^i >= count. Precondition: count > 0.
int roomClass(std::size_t count) {
  return count == 1 ? 0 : 64 - __builtin_clzll(count - 1);
}

}  // namespace

std::optional<Connection> connectionBetween(const CellRect& from, const CellRect& to,
                                            std::uint32_t number, Touching touching) {
  const int first_column = std::max(from.column, to.column);
  const int first_row = std::max(from.row, to.row);
  const int columns = std::min(from.column + from.width, to.column + to.width) - first_column;
  const int rows = std::min(from.row + from.height, to.row + to.height) - first_row;
  if (columns < 0 || rows < 0) return std::nullopt;
  if (rows > 0)
    return Connection{number, from.column < to.column ? Side::EAST : Side::WEST, first_row, rows};
  if (columns > 0)
    return Connection{number, from.row < to.row ? Side::NORTH : Side::SOUTH, first_column, columns};
  if (touching == Touching::BORDERS) return std::nullopt;
  return Connection{number, Side::CORNER, 0, 0};
}

Connections::Connections(const std::vector<CellRect>& rectangles, Touching touching,
                         const StopToken& stop) {
  StopPoll poll(stop);
  const bool corners_too = touching == Touching::BORDERS_AND_CORNERS;
  const std::vector<CellRect> none;
  const Edges columns(rectangles, columnEdge, poll), rows(rectangles, rowEdge, poll);
  const Corners rising(corners_too ? rectangles : none, true, poll);
  const Corners falling(corners_too ? rectangles : none, false, poll);
  const auto forEachConnection = [&](auto&& visit) {
    columns.forEachBorder(Side::EAST, Side::WEST, poll, visit);
    rows.forEachBorder(Side::NORTH, Side::SOUTH, poll, visit);
    rising.forEachPair(poll, visit);
    falling.forEachPair(poll, visit);
  };

  blocks_.resize(rectangles.size());
  forEachConnection([this](std::uint32_t from, const Connection&) { ++blocks_[from].room; });
  for (Block& block : blocks_) {
    block.first = static_cast<std::uint32_t>(count_);
    count_ += block.room;
  }
  all_.reserve(2 * count_);  // so that edits need not move them all
  all_.resize(count_);
  forEachConnection([this](std::uint32_t from, const Connection& connection) {
    Block& block = blocks_[from];
    all_[block.first + block.count++] = connection;
  });
  for (const Block& block : blocks_) {
    poll();
    std::sort(all_.begin() + block.first, all_.begin() + block.first + block.count,
              [](const Connection& a, const Connection& b) { return a.to < b.to; });
  }
}

std::size_t Connections::bytes() const {
  // Memory that is reserved and not used has no pages.
  std::size_t bytes = all_.size() * sizeof(Connection) + blocks_.capacity() * sizeof(Block);
  for (const auto& each : released_) bytes += each.capacity() * sizeof(std::uint32_t);
  return bytes;
}

void Connections::remove(std::uint32_t rectangle) {
  Block& block = blocks_[rectangle];
  for (const Connection& connection : of(rectangle)) erase(connection.to, rectangle);
  count_ -= block.count;
  release(block);
  block = Block();
}

void Connections::add(std::uint32_t rectangle, const std::vector<Connection>& connections) {
  if (blocks_.size() <= rectangle) blocks_.resize(rectangle + std::size_t{1});
  assert(blocks_[rectangle].count == 0);
  makeRoom(blocks_[rectangle], connections.size());
  Block& block = blocks_[rectangle];
  std::copy(connections.begin(), connections.end(), all_.begin() + block.first);
  block.count = static_cast<std::uint32_t>(connections.size());
  count_ += connections.size();
  for (const Connection& each : connections)
    insert(each.to, {rectangle, opposite(each.side), each.first, each.length});
}

void Connections::insert(std::uint32_t rectangle, const Connection& connection) {
  Block& block = blocks_[rectangle];
  makeRoom(block, block.count + std::size_t{1});
  Connection* begin = all_.data() + block.first;
  Connection* end = begin + block.count;
  Connection* place = std::lower_bound(begin, end, connection.to, before);
  std::copy_backward(place, end, end + 1);
  *place = connection;
  ++block.count;
  ++count_;
}

void Connections::erase(std::uint32_t rectangle, std::uint32_t to) {
  Block& block = blocks_[rectangle];
  Connection* begin = all_.data() + block.first;
  Connection* end = begin + block.count;
  Connection* place = std::lower_bound(begin, end, to, before);
  assert(place != end && place->to == to);
  std::copy(place + 1, end, place);
  --block.count;
  --count_;
}

std::uint32_t Connections::allocate(std::uint32_t room) {
  auto& released = released_[static_cast<std::size_t>(roomClass(room))];
  if (released.empty()) {
    all_.resize(all_.size() + room);
    return static_cast<std::uint32_t>(all_.size() - room);
  }
  const std::uint32_t first = released.back();
  released.pop_back();
  return first;
}

void Connections::release(const Block& block) {
  if (block.room == 0) return;
  released_[static_cast<std::size_t>(31 - __builtin_clz(block.room))].push_back(block.first);
}

void Connections::makeRoom(Block& block, std::size_t count) {
  if (count <= block.room) return;
  Block larger = block;
  larger.room = std::uint32_t{1} << std::max(2, roomClass(count));
  larger.first = allocate(larger.room);
  std::copy_n(all_.begin() + block.first, block.count, all_.begin() + larger.first);
  release(block);
  block = larger;
}

}  // namespace grid_path_planner::planners
