#include "grid_path_planner/grid/occupancy.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>

namespace grid_path_planner::grid {

using base::InputError;

namespace {

constexpr std::ptrdiff_t kTogether = 16;

bool bad(std::int8_t value) {
  return value < -1 || value > 100;
}

// Whether one of sixteen values is.
bool anyBad(const std::int8_t* values) {
  using Sixteen = std::int8_t __attribute__((vector_size(kTogether)));
  using Halves = std::int64_t __attribute__((vector_size(kTogether)));
  Sixteen value;
  std::memcpy(&value, values, sizeof value);
  const auto signs = reinterpret_cast<Halves>((value < -1) | (value > 100));
  return (signs[0] | signs[1]) != 0;
}

const std::int8_t* firstBad(const std::int8_t* begin, const std::int8_t* end) {
  while (end - begin >= kTogether && !anyBad(begin)) begin += kTogether;
  return std::find_if(begin, end, bad);
}

}  // namespace

void checkOccupancyValues(const OccupancyGrid& map) {
  checkOccupancyValues(map, map.geometry().rect());
}

void checkOccupancyValues(const OccupancyGrid& map, const CellRect& rect) {
  const CellRect inside = rect.intersection(map.geometry().rect());
  for (int row = inside.row; row < inside.row + inside.height; ++row) {
    const std::int8_t* begin = map.row(row) + inside.column;
    const std::int8_t* end = begin + inside.width;
    const std::int8_t* found = firstBad(begin, end);
    if (found == end) continue;
    throw InputError("occupancy must be -1 to 100, got " + std::to_string(*found) + " at column " +
                     std::to_string(found - map.row(row)) + ", row " + std::to_string(row));
  }
}

}  // namespace grid_path_planner::grid
