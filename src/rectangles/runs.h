// Runs of 1 bits in a row of a bit map.
#pragma once

#include "grid_path_planner/terrain/bit_maps.h"

namespace grid_path_planner {

// The first column from `column` on whose bit is 1, or 0; width() where there is none.
int nextFree(const BitMap& bits, int row, int column);
int nextBlocked(const BitMap& bits, int row, int column);

// How many bits up to and including `last` are 1 without a gap, in a row of a bit map.
int freeUpTo(const BitMap& bits, int row, int last);

// Whether all bits of the columns [first, end) of a row are 1. Precondition: first < end.
bool allFree(const BitMap& bits, int row, int first, int end);

// Makes them 0.
void block(BitMap& bits, int row, int first, int end);

}  // namespace grid_path_planner
