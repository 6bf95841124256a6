// Which rectangles touch, and the border that they share.
//
//   Connections connections(rectangles, Touching::BORDERS);
//   for (const Connection& connection : connections.of(3)) ...   // by ascending `to`
//
// The rectangles are disjoint. Borders are found by sorting the rectangles along each axis and
// walking both sides of every grid line once: n log n for n rectangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner {

// Where the neighbour lies; rows grow northwards as in Cell.
enum class Side : std::uint8_t { EAST, NORTH, WEST, SOUTH, CORNER };

struct Connection {
  std::uint32_t to;
  Side side;
  std::int32_t first;   // first shared row (EAST, WEST) or column (NORTH, SOUTH)
  std::int32_t length;  // cells that the border is long; 0 for a corner

  friend bool operator==(const Connection& a, const Connection& b) {
    return a.to == b.to && a.side == b.side && a.first == b.first && a.length == b.length;
  }
};

// Whether rectangles that share nothing but a corner are neighbours too.
enum class Touching { BORDERS, BORDERS_AND_CORNERS };

class Connections {
 public:
  class Range {
   public:
    Range(const Connection* begin, const Connection* end) : begin_(begin), end_(end) {}
    const Connection* begin() const { return begin_; }
    const Connection* end() const { return end_; }
    std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }

   private:
    const Connection* begin_;
    const Connection* end_;
  };

  Connections() = default;
  // Precondition: the rectangles are disjoint and none is empty.
  Connections(const std::vector<CellRect>& rectangles, Touching touching);

  // Of the rectangle with that number.
  Range of(std::uint32_t rectangle) const {
    return {all_.data() + first_[rectangle], all_.data() + first_[rectangle + 1]};
  }
  // Number of the first of them among all, which are numbered by rectangle.
  std::size_t firstOf(std::uint32_t rectangle) const { return first_[rectangle]; }
  const Connection& operator[](std::size_t number) const { return all_[number]; }
  // Both directions counted.
  std::size_t size() const { return all_.size(); }
  std::size_t bytes() const {
    return all_.capacity() * sizeof(Connection) + first_.capacity() * sizeof(std::size_t);
  }

 private:
  std::vector<Connection> all_;
  std::vector<std::size_t> first_;  // of each rectangle, and the end
};

}  // namespace grid_path_planner
