// One number for the answers of a run of queries: equal where every status, path and cost is equal.
//
//   PathHash hash;
//   hash.add(planner.search(request, stop));
//   std::puts(hash.text().c_str());  // 16 hexadecimal digits
//
// Hashes integers, by FNV-1a: cells, points in units of SegmentPoint, exact costs. The cost of
// segments is the only sum of roots, and is rounded to 1e-9 first. So the rounding of single
// operations has no effect. Times and counts of expanded cells are left out.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "grid_path_planner/planners/planner.h"

namespace grid_path_planner::command_line {

class PathHash {
 public:
  void add(const planners::SearchResult& result);
  std::string text() const;

 private:
  void add(std::int64_t number);
  void add(std::string_view text);
  void addByte(unsigned char byte);

  std::uint64_t hash_ = 14695981039346656037u;  // FNV's offset basis
};

}  // namespace grid_path_planner::command_line
