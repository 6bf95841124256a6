#include "grid_path_planner/terrain/near_obstacles.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace grid_path_planner {
namespace {

// Eight distances, handled by one instruction where the machine has such.
using Eight = std::int16_t __attribute__((vector_size(16)));
constexpr std::size_t kTogether = 8;

// No obstacle in the row: far enough even in the next row but one, and no overflow in the last.
constexpr std::int16_t kBeyond = 16900;

static_assert(kBeyond > 4 * NearObstacles::kLargestReach * NearObstacles::kLargestReach);
static_assert(kBeyond +
                  (2 * NearObstacles::kLargestReach - 1) * (2 * NearObstacles::kLargestReach - 1) <
              NearObstacles::kFar);

Eight load(const std::int16_t* from) {
  Eight eight;
  std::memcpy(&eight, from, sizeof eight);
  return eight;
}

bool hasOccupied(const Occupancy* cells, int count) {
  return std::memchr(cells, static_cast<int>(Occupancy::OCCUPIED),
                     static_cast<std::size_t>(count)) != nullptr;
}

}  // namespace

NearObstacles::NearObstacles(const Grid<Occupancy>& classes, const CellRect& rect, int reach)
    : classes_(classes),
      rect_(rect),
      reach_(reach),
      period_(2 * reach + 1),
      stride_((static_cast<std::size_t>(rect.width) + kTogether - 1) / kTogether * kTogether),
      next_(std::max(0, rect.row - reach)),
      lines_(stride_ * period_, kBeyond),
      empty_(period_, true),
      least_(stride_, kFar),
      apart_(static_cast<std::size_t>(rect.width) + 2 * reach) {
  assert(reach > 0 && reach <= kLargestReach);
  for (int apart = 0; apart <= reach; ++apart)
    squares_.push_back(static_cast<Distance>(squared(apart)));
  squares_.push_back(kBeyond);
}

const std::int16_t* NearObstacles::row(int row) {
  const int first = std::max(0, row - reach_);
  const int last = std::min(classes_.height() - 1, row + reach_);
  for (; next_ <= last; ++next_) measure(next_);

  bool lowered = false;
  for (int other = first; other <= last; ++other) {
    if (empty_[other % period_]) continue;
    if (!lowered) std::fill(least_.begin(), least_.end(), kFar);
    lowered = true;
    lower(lineOf(other), squared(std::abs(other - row)));
  }
  return lowered ? least_.data() : nullptr;
}

void NearObstacles::lower(const Distance* line, int offset) {
  const auto added = static_cast<Distance>(offset);
  const Eight step = {added, added, added, added, added, added, added, added};
  for (std::size_t i = 0; i < stride_; i += kTogether) {
    const Eight before = load(least_.data() + i);
    const Eight here = load(line + i) + step;
    const Eight least = here < before ? here : before;
    std::memcpy(least_.data() + i, &least, sizeof least);
  }
}

void NearObstacles::measure(int row) {
  const int begin = std::max(0, rect_.column - reach_);
  const int end = std::min(classes_.width(), rect_.column + rect_.width + reach_);
  const Occupancy* cells = classes_.row(row) + begin;
  const int count = end - begin;
  const bool empty = !hasOccupied(cells, count);
  empty_[row % period_] = empty;
  if (empty) return;

  int apart = reach_ + 1;
  for (int i = 0; i < count; ++i) {
    apart = cells[i] == Occupancy::OCCUPIED ? 0 : std::min(apart + 1, reach_ + 1);
    apart_[i] = static_cast<std::uint8_t>(apart);
  }
  apart = reach_ + 1;
  Distance* line = lineOf(row);
  const int skipped = rect_.column - begin;
  for (int i = count - 1; i >= skipped; --i) {
    apart = cells[i] == Occupancy::OCCUPIED ? 0 : std::min(apart + 1, reach_ + 1);
    if (i - skipped < rect_.width)
      line[i - skipped] = squares_[std::min<std::size_t>(apart, apart_[i])];
  }
}

}  // namespace grid_path_planner
