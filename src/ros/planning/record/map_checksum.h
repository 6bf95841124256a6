// A checksum of a map, by which a recording says which map was searched.
//
//   MapChecksum checksum(map);
//   checksum.change(map, rect, [&] { applyUpdate(update, rect, map); });  // in proportion to the update
//   const bool recorded = checksum.value() == record.map_checksum;
//
// Of the cells it is a sum, modulo 2^64, of each value times a fixed pseudo-random number of its column
// and one of its row; size, resolution and origin are mixed in. Maps that differ have equal checksums
// by chance only, one in some 2^32; no protection from those who look for such maps.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::nodes {

class MapChecksum {
 public:
  explicit MapChecksum(const grid::OccupancyGrid& map);

  std::uint64_t value() const { return geometry_ + cells_; }

  // `change` changes cells of `map`, of which this is, inside `rect` only, which lies in the map.
  template <class Change>
  void change(const grid::OccupancyGrid& map, const grid::CellRect& rect, const Change& change) {
    cells_ -= sumOf(map, rect);
    change();
    cells_ += sumOf(map, rect);
  }

 private:
  std::uint64_t sumOf(const grid::OccupancyGrid& map, const grid::CellRect& rect) const;

  std::vector<std::uint32_t> of_columns_;
  std::uint64_t geometry_;
  std::uint64_t cells_;
};

}  // namespace grid_path_planner::nodes
