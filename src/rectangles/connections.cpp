#include "grid_path_planner/rectangles/connections.h"

#include <algorithm>
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

}  // namespace

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

  first_.assign(rectangles.size() + 1, 0);
  all_.reserve(found.size());
  for (const Found& each : found) {
    ++first_[each.from + 1];
    all_.push_back(each.connection);
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

}  // namespace grid_path_planner
