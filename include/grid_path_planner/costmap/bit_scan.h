// Scans and fillings of a row of a bit map, a word at a time. Scans rely on the zeros around it.
#pragma once

#include <algorithm>

#include "grid_path_planner/costmap/bit_maps.h"

namespace grid_path_planner::costmap {

inline bool bitAt(const BitMap::Word* row, int column) {
  return (row[column >> 6] >> (column & 63) & 1U) != 0;
}

// The first 0 at or after `column`. Precondition: 0 <= column <= width.
inline int zeroFrom(const BitMap::Word* row, int column) {
  int word = column >> 6;
  BitMap::Word zeros = ~row[word] >> (column & 63) << (column & 63);
  while (zeros == 0) zeros = ~row[++word];
  return word * 64 + __builtin_ctzll(zeros);
}

// The first 1 at or after `column`, or some column from `limit` on. Precondition: 0 <= column.
inline int oneFrom(const BitMap::Word* row, int column, int limit) {
  if (column >= limit) return limit;
  int word = column >> 6;
  BitMap::Word ones = row[word] >> (column & 63) << (column & 63);
  while (ones == 0) {
    if (++word * 64 >= limit) return limit;
    ones = row[word];
  }
  return word * 64 + __builtin_ctzll(ones);
}

// The last 0 before `column`, -1 at least: what follows it up to `column` is all ones.
// Precondition: 0 <= column <= width.
inline int zeroBefore(const BitMap::Word* row, int column) {
  int word = (column - 1) >> 6;  // of column 0: the word of zeros before the row
  const int shift = 63 - ((column - 1) & 63);
  BitMap::Word zeros = ~row[word] << shift >> shift;
  while (zeros == 0) zeros = ~row[--word];
  return word * 64 + 63 - __builtin_clzll(zeros);
}

// Whether all of [first, last) are ones. Precondition: 0 <= first < last <= width.
inline bool allOnes(const BitMap::Word* row, int first, int last) {
  int word = first >> 6;
  const int end = (last - 1) >> 6;
  BitMap::Word mask = ~BitMap::Word{0} << (first & 63);
  for (; word < end; ++word, mask = ~BitMap::Word{0})
    if ((~row[word] & mask) != 0) return false;
  return (~row[word] & mask) << (63 - ((last - 1) & 63)) == 0;
}

// Makes all of [first, last) ones or zeros. Precondition: 0 <= first, last <= 64 words().
inline void fillBits(BitMap::Word* row, int first, int last, bool value) {
  while (first < last) {
    const int next = std::min(last, (first | 63) + 1);
    const BitMap::Word ones = ~BitMap::Word{0} >> (64 - (next - first)) << (first & 63);
    BitMap::Word& word = row[first >> 6];
    word = value ? word | ones : word & ~ones;
    first = next;
  }
}

}  // namespace grid_path_planner::costmap
