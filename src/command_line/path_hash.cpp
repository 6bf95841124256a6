#include "command_line/path_hash.h"

#include <cmath>
#include <cstdio>

namespace grid_path_planner::command_line {

using costmap::SegmentPoint;
using grid::Cell;
using planners::SearchResult;

void PathHash::add(const SearchResult& result) {
  add(toString(result.status));
  add(static_cast<std::int64_t>(result.cells.size()));
  for (const Cell& cell : result.cells) {
    add(static_cast<std::int64_t>(cell.column));
    add(static_cast<std::int64_t>(cell.row));
  }
  add(static_cast<std::int64_t>(result.points.size()));
  for (const SegmentPoint& point : result.points) {
    add(point.x);
    add(point.y);
  }
  add(result.cost.straight);
  add(result.cost.diagonal);
  add(static_cast<std::int64_t>(std::llround(result.segment_cost * 1e9)));
}

std::string PathHash::text() const {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash_));
  return digits;
}

// The low byte first, whatever the machine's order.
void PathHash::add(std::int64_t number) {
  for (int shift = 0; shift < 64; shift += 8)
    addByte(static_cast<unsigned char>(static_cast<std::uint64_t>(number) >> shift));
}

// With its length, so that no two sequences of texts and numbers are one sequence of bytes.
void PathHash::add(std::string_view text) {
  add(static_cast<std::int64_t>(text.size()));
  for (const char character : text) addByte(static_cast<unsigned char>(character));
}

void PathHash::addByte(unsigned char byte) {
  constexpr std::uint64_t kPrime = 1099511628211u;
  hash_ = (hash_ ^ byte) * kPrime;
}

}  // namespace grid_path_planner::command_line
