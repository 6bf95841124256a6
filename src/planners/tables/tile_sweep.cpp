#include "planners/tables/tile_sweep.h"

#include <algorithm>

namespace grid_path_planner::planners {

namespace {

struct Lengths {
  SearchKey straight, diagonal;
};

// Each cell of a row over those of the row beside it.
void fromBeside(SearchKey* row, const SearchKey* beside, const Lengths& lengths) {
  for (std::ptrdiff_t i = 0; i < std::ptrdiff_t{TileSweep::kSide}; ++i) {
    const SearchKey diagonal = std::min(beside[i - 1], beside[i + 1]) + lengths.diagonal;
    row[i] = std::min(row[i], std::min(beside[i] + lengths.straight, diagonal));
  }
}

// Each cell of a row over the one before, in the order from `first` by `step`.
void along(SearchKey* row, std::ptrdiff_t first, std::ptrdiff_t step, SearchKey length) {
  SearchKey last = row[first];
  for (std::ptrdiff_t i = first + step; i >= 0 && i < std::ptrdiff_t{TileSweep::kSide}; i += step) {
    last = std::min(row[i], last + length);
    row[i] = last;
  }
}

}  // namespace

void TileSweep::run(SearchKey straight, SearchKey diagonal) {
  const Lengths lengths{straight, diagonal};
  for (std::uint32_t row = 0; row < kSide; ++row) {
    fromBeside(&keys_[at(0, row)], &keys_[at(0, row)] - kStride, lengths);
    along(&keys_[at(0, row)], 0, 1, straight);
  }
  for (std::uint32_t row = kSide; row-- > 0;) {
    fromBeside(&keys_[at(0, row)], &keys_[at(0, row)] + kStride, lengths);
    along(&keys_[at(0, row)], kSide - 1, -1, straight);
  }
}

}  // namespace grid_path_planner::planners
