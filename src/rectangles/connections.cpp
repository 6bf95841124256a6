#include "grid_path_planner/rectangles/connections.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace grid_path_planner {
namespace {

struct Found {
  std::uint32_t from;
  Connection connection;
};

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

std::vector<Edge> sortedEdges(const std::vector<CellRect>& rectangles,
                              Edge (*edgeOf)(const CellRect&, bool, std::uint32_t), bool upper) {
  std::vector<Edge> edges;
  edges.reserve(rectangles.size());
  for (std::uint32_t i = 0; i < rectangles.size(); ++i)
    edges.push_back(edgeOf(rectangles[i], upper, i));
  std::sort(edges.begin(), edges.end(), alongTheLine);
  return edges;
}

// The shared parts of edges on the same line: `lower` ends there, `upper` begins there.
void addBorders(const std::vector<Edge>& lower, const std::vector<Edge>& upper, Side onwards,
                Side back, std::vector<Found>& found) {
  auto b = upper.begin();
  for (auto a = lower.begin(); a != lower.end() && b != upper.end();) {
    const int first = std::max(a->first, b->first);
    const int end = std::min(a->end, b->end);
    if (a->line == b->line && first < end) {
      found.push_back({a->rectangle, {b->rectangle, onwards, first, end - first}});
      found.push_back({b->rectangle, {a->rectangle, back, first, end - first}});
    }
    // The one that ends first has met all it can meet.
    if (std::tie(a->line, a->end) <= std::tie(b->line, b->end))
      ++a;
    else
      ++b;
  }
}

struct Corner {
  int column;
  int row;
  std::uint32_t rectangle;
};

bool byPlace(const Corner& a, const Corner& b) {
  return std::tie(a.column, a.row) < std::tie(b.column, b.row);
}

// Pairs of which the one's corner of the kind `of` is where the other's opposite corner is.
void addCorners(std::vector<Corner> ends, std::vector<Corner> begins, std::vector<Found>& found) {
  std::sort(ends.begin(), ends.end(), byPlace);
  std::sort(begins.begin(), begins.end(), byPlace);
  auto b = begins.begin();
  for (const Corner& a : ends) {
    while (b != begins.end() && byPlace(*b, a)) ++b;
    if (b == begins.end()) break;
    if (byPlace(a, *b)) continue;
    found.push_back({a.rectangle, {b->rectangle, Side::CORNER, 0, 0}});
    found.push_back({b->rectangle, {a.rectangle, Side::CORNER, 0, 0}});
  }
}

void addAllCorners(const std::vector<CellRect>& rectangles, std::vector<Found>& found) {
  std::vector<Corner> south_west, north_east, south_east, north_west;
  for (std::uint32_t i = 0; i < rectangles.size(); ++i) {
    const CellRect& rect = rectangles[i];
    const int east = rect.column + rect.width, north = rect.row + rect.height;
    south_west.push_back({rect.column, rect.row, i});
    north_east.push_back({east, north, i});
    south_east.push_back({east, rect.row, i});
    north_west.push_back({rect.column, north, i});
  }
  addCorners(std::move(north_east), std::move(south_west), found);
  addCorners(std::move(north_west), std::move(south_east), found);
}

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

Connections::Connections(const std::vector<CellRect>& rectangles, Touching touching) {
  std::vector<Found> found;
  addBorders(sortedEdges(rectangles, columnEdge, true), sortedEdges(rectangles, columnEdge, false),
             Side::EAST, Side::WEST, found);
  addBorders(sortedEdges(rectangles, rowEdge, true), sortedEdges(rectangles, rowEdge, false),
             Side::NORTH, Side::SOUTH, found);
  if (touching == Touching::BORDERS_AND_CORNERS) addAllCorners(rectangles, found);
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return std::tie(a.from, a.connection.to) < std::tie(b.from, b.connection.to);
  });

  blocks_.resize(rectangles.size());
  all_.reserve(2 * found.size());  // so that edits need not move them all
  for (const Found& each : found) {
    ++blocks_[each.from].count;
    all_.push_back(each.connection);
  }
  std::uint32_t first = 0;
  for (Block& block : blocks_) {
    block.first = first;
    block.room = block.count;
    first += block.count;
  }
  count_ = all_.size();
}

std::size_t Connections::bytes() const {
  // What is only reserved was never touched.
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

std::uint32_t Connections::take(std::uint32_t room) {
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
  larger.first = take(larger.room);
  std::copy_n(all_.begin() + block.first, block.count, all_.begin() + larger.first);
  release(block);
  block = larger;
}

}  // namespace grid_path_planner
