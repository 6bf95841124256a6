// A rectangle map in a compact file.
//
//   writeRectangleFile("site.rectangles", map);
//   RectangleGraph same = readRectangleFile("site.rectangles", Touching::BORDERS);
//
// What is read back has the same geometry to the bit and the same rectangles in the same order, so
// their numbers, and the weights made of them, are the same. Places without a rectangle, which
// edits may leave, are not written: later rectangles move up. What a map knows besides (weights,
// which blocked cells are unknown) is not in it.
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
// Largest first is a rule (decomposition.h), so that order need not be stored. For a city map of
// 1024x1024 cells and 15,257 rectangles this takes 18.8 kB; with the lists deflated together 22.7
// kB, with columns plainly less those before 27.4 kB, and listed largest first 39.9 kB.
#pragma once

#include <string>

#include "grid_path_planner/rectangles/rectangle_graph.h"

namespace grid_path_planner {

// What the file of `map` holds. Throws InputError for a map without cells.
std::string rectangleFileContent(const RectangleGraph& map);

// Throws InputError naming the file where it cannot be written; then it is as it was.
void writeRectangleFile(const std::string& file, const RectangleGraph& map);

// Throws InputError naming the file and what is wrong where it cannot be read, is not such a file,
// has another format number, ends early, goes on after its end, does not fit its checksum, or holds
// rectangles that leave the map or overlap. What is taken of memory follows the file's size.
RectangleGraph readRectangleFile(const std::string& file, Touching touching);

}  // namespace grid_path_planner
