#include "ros/planning/record/map_checksum.h"

#include <cstring>

namespace grid_path_planner::nodes {

using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

// The finalizer of SplitMix64 (Steele, Lea & Flood 2014).
std::uint64_t mixed(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

std::uint64_t bitsOf(double number) {
  number += 0.0;  // -0.0 is 0.0
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  return bits;
}

std::uint64_t checksumOf(const GridGeometry& geometry) {
  std::uint64_t sum = 0;
  for (const double number :
       {static_cast<double>(geometry.width()), static_cast<double>(geometry.height()),
        geometry.resolution(), geometry.origin().x, geometry.origin().y, geometry.origin().yaw})
    sum = mixed(sum ^ bitsOf(number));
  return sum;
}

std::vector<std::uint32_t> numbersOfColumns(int columns) {
  std::vector<std::uint32_t> numbers;
  for (int column = 0; column < columns; ++column)
    numbers.push_back(static_cast<std::uint32_t>(mixed(static_cast<std::uint64_t>(column))));
  return numbers;
}

}  // namespace

MapChecksum::MapChecksum(const OccupancyGrid& map)
    : of_columns_(numbersOfColumns(map.width())),
      geometry_(checksumOf(map.geometry())),
      cells_(sumOf(map, map.geometry().rect())) {}

std::uint64_t MapChecksum::sumOf(const OccupancyGrid& map, const CellRect& rect) const {
  constexpr std::uint64_t kRows = std::uint64_t{1} << 32;  // apart from the numbers of columns
  std::uint64_t sum = 0;
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    const std::int8_t* const values = map.row(row);
    std::uint64_t of_row = 0;
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      of_row += std::uint64_t{static_cast<std::uint8_t>(values[column])} * of_columns_[column];
    sum += of_row * (mixed(kRows + static_cast<std::uint64_t>(row)) | 1u);
  }
  return sum;
}

}  // namespace grid_path_planner::nodes
