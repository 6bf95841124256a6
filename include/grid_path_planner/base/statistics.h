// Counters of a search, with the same meaning for every planner.
#pragma once

#include <cstddef>
#include <cstdint>

namespace grid_path_planner::base {

struct Statistics {
  std::uint64_t expanded = 0;   // nodes taken from the open list whose successors were generated
  std::uint64_t generated = 0;  // nodes put into the open list, again for every lower g-value
  std::uint64_t reopened = 0;   // nodes expanded before and put into the open list again
  std::size_t peak_open = 0;    // entries
  double time_s = 0.0;          // steady clock, the plan alone: map preparation is not in it
  // Memory of the search, the map excluded: its arrays, and the open list at its longest.
  std::size_t search_bytes = 0;

  // Sums of counters and time, the larger of the sizes: two searches of one request.
  Statistics& operator+=(const Statistics& other) {
    expanded += other.expanded;
    generated += other.generated;
    reopened += other.reopened;
    peak_open = peak_open > other.peak_open ? peak_open : other.peak_open;
    time_s += other.time_s;
    search_bytes = search_bytes > other.search_bytes ? search_bytes : other.search_bytes;
    return *this;
  }
};

}  // namespace grid_path_planner::base
