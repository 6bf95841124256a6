#include "costmap/bounded_distance_transform.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace grid_path_planner::costmap {

using grid::CellRect, grid::Grid, grid::Occupancy;

namespace {

// No obstacle in the row: far enough even in the next row but one, and no overflow in the last.
constexpr std::int16_t kBeyond = 16900;
constexpr std::int16_t kFar = 32767;

constexpr int kLargestAcross = 2 * BoundedDistanceTransform::kLargestReach;  // half cells
static_assert(kBeyond > (kLargestAcross + 1) * (kLargestAcross + 1));
static_assert(kBeyond + (kLargestAcross - 1) * (kLargestAcross - 1) < kFar);

// Between two looks at what is the largest distance: each takes as long as a line or two.
constexpr int kLinesBetween = 4;

std::size_t roundedUp(std::size_t number, std::size_t to) {
  return (number + to - 1) / to * to;
}

// The index of the first source from cells[at] on; `count` where there is none.
int sourceFrom(const Occupancy* cells, Occupancy source, int at, int count) {
  const void* found =
      std::memchr(cells + at, static_cast<int>(source), static_cast<std::size_t>(count - at));
  return found == nullptr ? count : static_cast<int>(static_cast<const Occupancy*>(found) - cells);
}

}  // namespace

BoundedDistanceTransform::BoundedDistanceTransform(const Grid<Occupancy>& classes, Occupancy source,
                                                   const CellRect& sources, const CellRect& rect,
                                                   int reach)
    : classes_(classes),
      source_(source),
      rect_(rect),
      window_(rect.grown(reach).intersection(sources)),
      reach_(reach),
      period_(std::max(1, std::min(2 * reach + 1, window_.height))),
      stride_(roundedUp(static_cast<std::size_t>(rect.width), kEights * kTogether)),
      next_(window_.row),
      memory_(stride_ * static_cast<std::size_t>(period_)),
      least_(stride_) {
  assert(reach > 0 && reach <= kLargestReach);
  rising_.assign(static_cast<std::size_t>(rect.width) + 2 * reach + 1, kBeyond);
  for (int apart = 0; apart <= reach; ++apart) {
    rising_[static_cast<std::size_t>(apart)] = static_cast<Distance>(squared(apart));
    apart_.push_back(Eight{} + static_cast<Distance>(squared(apart)));
  }
  falling_.assign(rising_.rbegin(), rising_.rend());
}

const std::int16_t* BoundedDistanceTransform::row(int row) {
  const auto beforeRow = [](const Line& line, int row) { return line.row < row; };
  lines_.erase(lines_.begin(),
               std::lower_bound(lines_.begin(), lines_.end(), row - reach_, beforeRow));
  const int end = std::min(window_.row + window_.height, row + reach_ + 1);
  for (; next_ < end; ++next_) measure(next_);
  if (lines_.empty()) return nullptr;
  const auto above = std::lower_bound(lines_.begin(), lines_.end(), row, beforeRow);
  for (std::size_t i = 0; i < stride_; i += kEights * kTogether) {
    const Eights eights = least(row, static_cast<std::size_t>(above - lines_.begin()), i);
    std::memcpy(least_.data() + i, &eights, sizeof eights);
  }
  return least_.data();
}

// From the row upwards and downwards, until no line can give less, which is asked now and then.
BoundedDistanceTransform::Eights BoundedDistanceTransform::least(int row, std::size_t above,
                                                                 std::size_t first) const {
  Eights least;
  least.fill(Eight{} + kFar);
  int most = kFar, looked = 0;
  // Returns false where a line so far away gives nothing less.
  const auto lowerBy = [&](const Line& line, int rows) {
    if (++looked % kLinesBetween == 0) most = largest(least);
    const Eight& apart = apart_[static_cast<std::size_t>(rows)];
    if (apart[0] >= most) return false;
    for (std::size_t i = 0; i < kEights; ++i) {
      const Eight here = from(line.distances + first + i * kTogether) + apart;
      least[i] = here < least[i] ? here : least[i];
    }
    return true;
  };
  for (std::size_t i = above; i < lines_.size(); ++i) {
    if (lines_[i].dominated_by_previous && i > above) continue;
    if (!lowerBy(lines_[i], lines_[i].row - row)) break;
  }
  most = largest(least);
  for (std::size_t i = above; i-- > 0;) {
    if (lines_[i].dominated_by_next && i + 1 < above) continue;
    if (!lowerBy(lines_[i], row - lines_[i].row)) break;
  }
  return least;
}

void BoundedDistanceTransform::measure(int row) {
  const Occupancy* cells = classes_.row(row) + window_.column;
  const int first = sourceFrom(cells, source_, 0, window_.width);
  if (first == window_.width) return;

  Distance* line = memory_.data() + static_cast<std::size_t>(row % period_) * stride_;
  constexpr int kNone = 1 << 29;
  const int skipped = rect_.column - window_.column;
  int before = -kNone;
  for (int next = first;; next = sourceFrom(cells, source_, before + 1, window_.width)) {
    fillBetween(before, next == window_.width ? kNone : next, line);
    if (next == window_.width) return append(row, line);
    before = next;
    while (before + 1 < window_.width && cells[before + 1] == source_) ++before;
    const int low = std::max(next, skipped), high = std::min(before + 1, skipped + rect_.width);
    if (low < high) std::fill(line + low - skipped, line + high - skipped, Distance{0});
  }
}

void BoundedDistanceTransform::append(int row, const Distance* distances) {
  Line line{row, distances};
  if (!lines_.empty()) {
    Line& last = lines_.back();
    Eight nearer = {}, farther = {};  // than the last
    for (std::size_t i = 0; i < stride_; i += kTogether) {
      const Eight here = from(distances + i), there = from(last.distances + i);
      nearer |= here < there;
      farther |= here > there;
    }
    line.dominated_by_previous = !any(nearer);
    last.dominated_by_next = !any(farther);
  }
  lines_.push_back(line);
}

void BoundedDistanceTransform::fillBetween(int before, int next, Distance* line) const {
  const int skipped = rect_.column - window_.column;
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

}  // namespace grid_path_planner::costmap
