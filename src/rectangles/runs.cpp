#include "runs.h"

#include <algorithm>

namespace grid_path_planner {
namespace {

using Word = BitMap::Word;

constexpr Word kOnes = ~Word{0};

// Bits [first, end) of the word that holds `first`, as far as it reaches.
Word maskFrom(int first, int end) {
  const int from = first & 63;
  const int length = std::min(64 - from, end - first);
  const Word low = length == 64 ? kOnes : (Word{1} << length) - 1;
  return low << from;
}

// The first column from `column` on where `flip` ^ bit is 1.
int next(const BitMap& bits, int row, int column, Word flip) {
  if (column >= bits.width()) return bits.width();
  const Word* words = bits.row(row);
  int index = column >> 6;
  Word word = (words[index] ^ flip) & (kOnes << (column & 63));
  while (word == 0) {
    if (++index >= bits.words()) return bits.width();
    word = words[index] ^ flip;
  }
  return std::min(bits.width(), index * 64 + __builtin_ctzll(word));
}

}  // namespace

int nextFree(const BitMap& bits, int row, int column) {
  return next(bits, row, column, 0);
}

int nextBlocked(const BitMap& bits, int row, int column) {
  return next(bits, row, column, kOnes);
}

int freeUpTo(const BitMap& bits, int row, int last) {
  const Word* words = bits.row(row);
  int index = last >> 6;
  const int below = 63 - (last & 63);  // bits of the first word beyond `last`
  Word blocked = ~words[index] << below;
  if (blocked != 0) return __builtin_clzll(blocked);
  int count = 64 - below;
  while (words[--index] == kOnes) count += 64;
  return count + __builtin_clzll(~words[index]);
}

bool allFree(const BitMap& bits, int row, int first, int end) {
  const Word* words = bits.row(row);
  while (first < end) {
    const Word mask = maskFrom(first, end);
    if ((words[first >> 6] & mask) != mask) return false;
    first = (first | 63) + 1;
  }
  return true;
}

void block(BitMap& bits, int row, int first, int end) {
  Word* words = bits.row(row);
  while (first < end) {
    words[first >> 6] &= ~maskFrom(first, end);
    first = (first | 63) + 1;
  }
}

}  // namespace grid_path_planner
