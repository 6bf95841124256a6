// Which rectangles touch, and the border that they share.
//
//   Connections connections(rectangles, Touching::BORDERS);
//   for (const Connection& connection : connections.of(3)) use(connection);  // by ascending `to`
//
// The rectangles are disjoint. Borders are found by a sweep along each axis over the sorted edges:
// O(n log n) for n rectangles. Afterwards single rectangles can be removed and added, in time in
// proportion to their own neighbours: every rectangle's connections stand together in a block of
// one array, and a list that outgrows its block moves to another.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::planners {

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

// How `from` touches `to`, which has the number `number`. Precondition: they are disjoint.
std::optional<Connection> connectionBetween(const grid::CellRect& from, const grid::CellRect& to,
                                            std::uint32_t number, Touching touching);

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

  // The most that the constructor takes for each of many rectangles: of the regions of a plane each
  // borders on less than six others in the mean, and all edges are sorted along both axes.
  static constexpr std::size_t kMakingBytes = 6 * sizeof(Connection) + 12 + 4 * 16;

  Connections() = default;
  // Precondition: the rectangles are disjoint and none is empty. Throws Stopped.
  Connections(const std::vector<grid::CellRect>& rectangles, Touching touching,
              const base::StopToken& stop = base::StopToken());

  // Of the rectangle with that number; valid until the next change.
  Range of(std::uint32_t rectangle) const {
    const Block& block = blocks_[rectangle];
    return {all_.data() + block.first, all_.data() + block.first + block.count};
  }
  // Number of the first of them; the others' follow. No two connections have the same number.
  std::size_t firstOf(std::uint32_t rectangle) const { return blocks_[rectangle].first; }
  // Precondition: the number of a connection.
  const Connection& operator[](std::size_t number) const { return all_[number]; }
  // All numbers are below. After remove() some of them belong to no connection.
  std::size_t size() const { return all_.size(); }
  // How many there are, both directions counted.
  std::size_t count() const { return count_; }
  std::size_t bytes() const;

  // Removes the rectangle's connections, and its neighbours' connections to it.
  void remove(std::uint32_t rectangle);
  // Adds the rectangle's connections, by ascending `to`, and its neighbours' connections to it.
  // Preconditions: it has none yet, and the neighbours exist.
  void add(std::uint32_t rectangle, const std::vector<Connection>& connections);

 private:
  // The place of a rectangle's connections, with room for more.
  struct Block {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t room = 0;
  };

  void insert(std::uint32_t rectangle, const Connection& connection);
  void erase(std::uint32_t rectangle, std::uint32_t to);
  // `room` is a power of two.
  std::uint32_t allocate(std::uint32_t room);
  void release(const Block& block);
  void makeRoom(Block& block, std::size_t count);

  std::vector<Connection> all_;
  std::vector<Block> blocks_;                            // of each rectangle
  std::array<std::vector<std::uint32_t>, 32> released_;  // blocks with room for 2^i or more
  std::size_t count_ = 0;
};

}  // namespace grid_path_planner::planners
