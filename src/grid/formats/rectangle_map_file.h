// A map's free cells as disjoint rectangles in a compact file: what `grid_path rectangles --output`
// writes, and one more format of map files.
//
//   RectangleMap map{geometry, {{0, 0, 4, 3}, {5, 0, 2, 3}}};
//   std::string content = rectangleMapContent(map);
//   OccupancyGrid cells = parseRectangleMap(content, "site.rectangles", {});
//
// What is read back has the same geometry to the bit and the same rectangles in the same order. As
// cells: those in a rectangle are free (0), all others occupied (100). What blocked a cell is not
// in the file: unknown cells come back as occupied, and so do free ones that were not cut.
//
// The file, numbers little-endian:
//
//   bytes  0  "RECTMAP" and the format number, 1
//          8  width, height: unsigned, 4 bytes each
//         16  resolution, x, y, yaw: IEEE doubles
//         48  number of rectangles: unsigned, 4 bytes
//         52  their order: 0 largest first, 1 by position, 2 as listed
//         53  bytes of the body: unsigned, 8 bytes
//         61  the body
//       then  CRC-32 of all before, 4 bytes
//
// The body tells of the rectangles by first row, then first column, in lists of unsigned numbers of
// 7 bits a byte, the lowest first, the eighth bit set where more follow: all rows, each less the
// one before; all columns, counted along the row from where the rectangle before in it ends (or
// from the first) without those that rectangles from below cover; all widths less 1; all heights
// less 1; and in the order "as listed" all numbers. Each list is its packed length in 5 bytes and
// itself, deflated (RFC 1951).
//
// Largest first is a rule (planners/decomposition.h), so that order need not be stored. For a
// city map of 1024x1024 cells and 15,257 rectangles this takes 18.8 kB; with the lists deflated
// together 22.7 kB, with columns plainly less those before 27.4 kB, and listed largest first 39.9
// kB.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

struct RectangleMap {
  GridGeometry geometry;
  std::vector<CellRect> rectangles;
};

// Leaves out empty rectangles: later ones move up. Throws InputError for a map without cells.
// Precondition: the rectangles are disjoint and lie in the map.
std::string rectangleMapContent(const RectangleMap& map);

// Whether `content` begins as such a file.
bool looksLikeRectangleMap(const std::string& content);

// Throws InputError naming `file` and what is wrong where `content` is not such a file, has another
// format number, ends early, goes on after its end, does not fit its checksum, or holds rectangles
// that leave the map; overlapping ones are not noticed. What is taken of memory follows the size of
// `content`.
RectangleMap parseRectangles(const std::string& content, const std::string& file,
                             base::ReadLimits limits = {});

// As cells. Throws InputError as parseRectangles, and for rectangles that overlap. Takes memory for
// the cells once all else is checked.
OccupancyGrid parseRectangleMap(const std::string& content, const std::string& file,
                                const MapFileOptions& options);

}  // namespace grid_path_planner::grid
