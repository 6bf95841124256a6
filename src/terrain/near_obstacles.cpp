#include "grid_path_planner/terrain/near_obstacles.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace grid_path_planner {
namespace {

constexpr std::size_t kTogether = 8;  // an Eight

// No obstacle in the row: far enough even in the next row but one, and no overflow in the last.
constexpr std::int16_t kBeyond = 16900;

static_assert(kBeyond > 4 * NearObstacles::kLargestReach * NearObstacles::kLargestReach);
static_assert(kBeyond +
                  (2 * NearObstacles::kLargestReach - 1) * (2 * NearObstacles::kLargestReach - 1) <
              NearObstacles::kFar);

// The first occupied one of cells[at] up to cells[count], `count` where there is none.
int occupiedFrom(const Occupancy* cells, int at, int count) {
  const void* found = std::memchr(cells + at, static_cast<int>(Occupancy::OCCUPIED),
                                  static_cast<std::size_t>(count - at));
  return found == nullptr ? count : static_cast<int>(static_cast<const Occupancy*>(found) - cells);
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
      least_(stride_, kFar) {
  assert(reach > 0 && reach <= kLargestReach);
  rising_.assign(static_cast<std::size_t>(rect.width) + 2 * reach + 1, kBeyond);
  for (int apart = 0; apart <= reach; ++apart)
    rising_[static_cast<std::size_t>(apart)] = static_cast<Distance>(squared(apart));
  falling_.assign(rising_.rbegin(), rising_.rend());
  sources_.reserve(static_cast<std::size_t>(period_));
}

const std::int16_t* NearObstacles::row(int row) {
  const int first = std::max(0, row - reach_);
  const int last = std::min(classes_.height() - 1, row + reach_);
  for (; next_ <= last; ++next_) measure(next_);

  sources_.clear();
  for (int other = first; other <= last; ++other)
    if (!empty_[other % period_])
      sources_.push_back(
          {lineOf(other), Eight{} + static_cast<Distance>(squared(std::abs(other - row)))});
  if (sources_.empty()) return nullptr;
  for (std::size_t i = 0; i < stride_; i += kTogether) {
    Eight least = Eight{} + kFar;
    for (const Source& source : sources_) {
      Eight here;
      std::memcpy(&here, source.line + i, sizeof here);
      here += source.added;
      least = here < least ? here : least;
    }
    std::memcpy(least_.data() + i, &least, sizeof least);
  }
  return least_.data();
}

void NearObstacles::measure(int row) {
  const int begin = std::max(0, rect_.column - reach_);
  const int count = std::min(classes_.width(), rect_.column + rect_.width + reach_) - begin;
  const Occupancy* cells = classes_.row(row) + begin;
  const int first = occupiedFrom(cells, 0, count);
  empty_[row % period_] = first == count;
  if (first == count) return;

  Distance* line = lineOf(row);
  constexpr int kNone = 1 << 29;
  int before = -kNone;
  for (int next = first;; next = occupiedFrom(cells, before + 1, count)) {
    fillBetween(before, next == count ? kNone : next, begin, line);
    if (next == count) return;
    const int skipped = next + begin - rect_.column;
    if (skipped >= 0 && skipped < rect_.width) line[skipped] = 0;
    before = next;
  }
}

void NearObstacles::fillBetween(int before, int next, int begin, Distance* line) const {
  const int skipped = rect_.column - begin;
  const int low = std::max(before + 1, skipped);
  const int high = std::min(next, skipped + rect_.width);
  if (low >= high) return;
  const int middle = std::clamp((before + next) / 2 + 1, low, high);
  if (low < middle)
    std::copy_n(rising_.data() + (low - before), middle - low, line + low - skipped);
  const auto last = static_cast<std::ptrdiff_t>(falling_.size()) - 1;
  if (middle < high)
    std::copy_n(falling_.data() + (last - (next - middle)), high - middle, line + middle - skipped);
}

}  // namespace grid_path_planner
