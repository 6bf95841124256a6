// The sizes of several representations of a map's free space: the published comparison (Park 2013:
// the entire map in bits, its empty cells, its rectangles), and the compressed bits, which that
// comparison leaves out.
//
//   MapSizes sizes = mapSizes(map);   // map: all of the free space as rectangles
//
// Lists count each number in whole bits, the fewest that hold it in that map: 44 for a rectangle of
// a 1250x1250 map, 22 for a cell. Only the two representations by rectangles contain the partition;
// from the others it can be computed (decomposition.h). All but the file of rectangles leave out
// resolution and origin. A PNG of 8 bits a pixel, OpenCV's default, takes 1.5 to 12 times as much as
// `png`.
#pragma once

#include <cstddef>

#include "grid_path_planner/planners/rectangle_graph.h"

namespace grid_path_planner::planners {

// Bytes, rounded up.
struct MapSizes {
  std::size_t entire_map;   // a bit a cell
  std::size_t empty_cells;  // a list of all free cells: column, row
  std::size_t rectangles;   // a list: column, row, width, height
  std::size_t file;         // rectangle_file.h
  std::size_t png;          // OpenCV's of 1 bit a pixel, at its highest level of compression
  std::size_t zlib;         // the bits, rows filled to whole bytes, as small as zlib makes them
};

// Takes some 2 bytes of memory a cell. Throws InputError for a map without cells.
MapSizes mapSizes(const RectangleGraph& map);

}  // namespace grid_path_planner::planners
