#include "planners/tables/landmark_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <utility>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "planners/tables/shortest_path_tree.h"

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using costmap::CostGrid;
using grid::Cell, grid::CellIndex, grid::CellRect, grid::GridGeometry;

namespace {

constexpr std::size_t kCacheLine = 64;  // bytes
constexpr std::uint32_t kNone = 0xffffffffU;
constexpr int kMergeDistance = 16;  // cells between places that count as one
constexpr std::size_t kMostPlaces = 4;

CompactCost compactCostOf(SearchKey cost) {
  return CompactCostUnit().entryOf(cost);
}

std::size_t rowBytesFor(int landmarks) {
  const int lanes = (landmarks + LandmarkTable::kLanes - 1) / LandmarkTable::kLanes;
  return static_cast<std::size_t>(lanes * LandmarkTable::kLanes) * sizeof(CompactCost);
}

// The largest |a[i] - b[i]|.
CompactCost largestDifference(const CompactCost* a, const CompactCost* b, int stride) {
#ifdef __SSE2__
  __m128i largest = _mm_setzero_si128();
  for (int i = 0; i < stride; i += LandmarkTable::kLanes) {
    const __m128i x = _mm_loadu_si128(reinterpret_cast<const __m128i*>(a + i));
    const __m128i y = _mm_loadu_si128(reinterpret_cast<const __m128i*>(b + i));
    const __m128i difference = _mm_sub_epi32(x, y);
    const __m128i sign = _mm_srai_epi32(difference, 31);
    const __m128i absolute = _mm_sub_epi32(_mm_xor_si128(difference, sign), sign);
    const __m128i larger = _mm_cmpgt_epi32(absolute, largest);
    largest = _mm_or_si128(_mm_and_si128(larger, absolute), _mm_andnot_si128(larger, largest));
  }
  alignas(16) CompactCost lanes[LandmarkTable::kLanes];
  _mm_store_si128(reinterpret_cast<__m128i*>(lanes), largest);
  return *std::max_element(lanes, lanes + LandmarkTable::kLanes);
#else
  CompactCost largest = 0;
  for (int i = 0; i < stride; ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
#endif
}

WideCost largestDifference(const WideCost* a, const WideCost* b, int stride) {
#ifdef __SSE2__
  const __m128d sign = _mm_set1_pd(-0.0);
  __m128d largest = _mm_setzero_pd();
  for (int i = 0; i < stride; i += 2)
    largest = _mm_max_pd(largest,
                         _mm_andnot_pd(sign, _mm_sub_pd(_mm_loadu_pd(a + i), _mm_loadu_pd(b + i))));
  return std::max(_mm_cvtsd_f64(largest), _mm_cvtsd_f64(_mm_unpackhi_pd(largest, largest)));
#else
  WideCost largest = 0;
  for (int i = 0; i < stride; ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
#endif
}

}  // namespace

// Chooses landmark after landmark.
class LandmarkTable::Making {
 public:
  Making(LandmarkTable& table, const CostGrid& map, const StopToken& stop)
      : table_(table),
        map_(map),
        stop_(stop),
        from_(map, stop),
        sizes_(map.geometry().size()),
        children_(map.geometry().size()) {}

  // Throws Stopped and TooExpensive.
  void run(int landmarks) {
    if (choose(landmarks)) return;
    beginAnew();
    table_.wide_ = true;
    if (!choose(table_.stride())) table_.landmarks_.clear();
  }

 private:
  // Whether all costs fit into entries.
  bool choose(int landmarks);
  void beginAnew();
  std::uint32_t drawRoot();
  template <class Entry>
  bool write(int number, Entry (*entry_of)(SearchKey), Entry none);
  WideCost boundBetween(std::uint32_t a, std::uint32_t b) const;
  std::uint32_t farthest() const;
  std::uint32_t worstBounded(std::uint32_t root);
  void weigh(std::uint32_t root);
  std::uint32_t heaviest(std::uint32_t root) const;
  std::uint32_t heaviestChild(std::uint32_t index) const;

  // In sizes_: a landmark stands in the cell or behind it.
  static constexpr std::uint64_t kCovered = ~std::uint64_t{0};
  // In children_, which counts those that are not done.
  static constexpr std::uint8_t kDone = 255;
  // In sizes_, so that sums of them stay below kCovered: of 2^31 cells.
  static constexpr double kMostShort = 4294967296.0;

  LandmarkTable& table_;
  const CostGrid& map_;
  const StopToken& stop_;
  ShortestPathTree from_;
  std::vector<std::uint64_t> sizes_;
  std::vector<std::uint8_t> children_;
  std::mt19937 random_;
};

bool LandmarkTable::Making::choose(int landmarks) {
  for (int number = 0; number < landmarks; ++number) {
    const std::uint32_t root = drawRoot();
    if (root == kNone) return true;
    from_.run(root);
    const std::uint32_t landmark = number == 0 ? farthest() : worstBounded(root);
    from_.run(landmark);
    const bool fit = table_.wide_ ? write<WideCost>(number, wideCostOf, kNoWideCost)
                                  : write<CompactCost>(number, compactCostOf, kNoCompactCost);
    if (!fit) return false;
    table_.landmarks_.push_back(map_.geometry().cell(CellIndex(landmark)));
  }
  return true;
}

std::uint32_t LandmarkTable::Making::drawRoot() {
  const auto& weights = map_.weights().values();
  const std::size_t drawn = random_() % weights.size();
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const std::size_t index = (drawn + i) % weights.size();
    if (weights[index] != CostGrid::kBlocked) return static_cast<std::uint32_t>(index);
  }
  return kNone;
}

void LandmarkTable::Making::beginAnew() {
  table_.landmarks_.clear();
  table_.memory_.clear();
  random_ = std::mt19937();
}

template <class Entry>
bool LandmarkTable::Making::write(int number, Entry (*entry_of)(SearchKey), Entry none) {
  StopPoll poll(stop_, 1 << 16);
  unsigned char* row = table_.rows_ + static_cast<std::size_t>(number) * sizeof(Entry);
  for (const SearchKey cost : from_.costs()) {
    poll();
    const Entry entry = entry_of(cost);
    if (entry == none && cost != kInfiniteKey) return false;
    *reinterpret_cast<Entry*>(row) = entry;
    row += table_.row_bytes_;
  }
  return true;
}

WideCost LandmarkTable::Making::boundBetween(std::uint32_t a, std::uint32_t b) const {
  const int stride = table_.stride();
  return table_.wide_ ? largestDifference(table_.wideRow(a), table_.wideRow(b), stride)
                      : largestDifference(table_.row(a), table_.row(b), stride);
}

std::uint32_t LandmarkTable::Making::farthest() const {
  const auto nearer = [](SearchKey a, SearchKey b) { return a + 1 < b + 1; };  // infinite: 0
  const auto& costs = from_.costs();
  return static_cast<std::uint32_t>(std::max_element(costs.begin(), costs.end(), nearer) -
                                    costs.begin());
}

std::uint32_t LandmarkTable::Making::worstBounded(std::uint32_t root) {
  weigh(root);
  std::uint32_t best = heaviest(root);
  if (best == kNone) return root;
  for (std::uint32_t next = best; next != kNone; next = heaviestChild(next)) best = next;
  return best;
}

// The size of a cell is the sum, over the cells behind it in the shortest-path tree of the
// root, of what the bounds of the present landmarks fall short of the cost.
void LandmarkTable::Making::weigh(std::uint32_t root) {
  StopPoll poll(stop_, 1 << 14);
  const auto& costs = from_.costs();
  std::fill(children_.begin(), children_.end(), std::uint8_t{0});
  for (std::uint32_t i = 0; i < costs.size(); ++i) {
    poll();
    sizes_[i] = 0;
    if (costs[i] == kInfiniteKey || i == root) continue;
    ++children_[from_.parent(i)];
    const WideCost cost = table_.wide_ ? wideCostOf(costs[i]) : compactCostOf(costs[i]);
    sizes_[i] =
        static_cast<std::uint64_t>(std::clamp(cost - boundBetween(i, root), 0.0, kMostShort));
  }
  for (const Cell landmark : table_.landmarks_)
    sizes_[map_.geometry().index(landmark).value()] = kCovered;
  for (std::uint32_t leaf = 0; leaf < costs.size(); ++leaf) {
    poll();
    if (costs[leaf] == kInfiniteKey || children_[leaf] != 0) continue;
    for (std::uint32_t at = leaf;;) {
      children_[at] = kDone;
      if (at == root) break;
      const std::uint32_t parent = from_.parent(at);
      const bool covered = sizes_[at] == kCovered || sizes_[parent] == kCovered;
      sizes_[parent] = covered ? kCovered : sizes_[parent] + sizes_[at];
      if (--children_[parent] != 0) break;
      at = parent;
    }
  }
}

std::uint32_t LandmarkTable::Making::heaviest(std::uint32_t root) const {
  std::uint32_t best = kNone;
  for (std::uint32_t i = 0; i < sizes_.size(); ++i) {
    if (i == root || sizes_[i] == kCovered || sizes_[i] == 0) continue;
    if (best == kNone || sizes_[i] > sizes_[best]) best = i;
  }
  return best;
}

std::uint32_t LandmarkTable::Making::heaviestChild(std::uint32_t index) const {
  std::uint32_t best = kNone;
  for (unsigned mask = from_.masks()[index]; mask != 0; mask &= mask - 1) {
    const auto child =
        static_cast<std::uint32_t>(index + from_.masks().offsets()[__builtin_ctz(mask)]);
    if (from_.costs()[child] <= from_.costs()[index] || from_.parent(child) != index) continue;
    if (best == kNone || sizes_[child] > sizes_[best]) best = child;
  }
  return best;
}

std::size_t LandmarkTable::bytesFor(const GridGeometry& geometry, int landmarks) {
  return geometry.size() * rowBytesFor(landmarks) + kCacheLine;
}

std::size_t LandmarkTable::makingBytesFor(const GridGeometry& geometry, int landmarks) {
  const std::size_t sizes_and_children = geometry.size() * (sizeof(std::uint64_t) + 1);
  return bytesFor(geometry, landmarks) + sizes_and_children + ShortestPathTree::bytesFor(geometry);
}

LandmarkTable::LandmarkTable(const CostGrid& map, int landmarks, const StopToken& stop)
    : row_bytes_(rowBytesFor(landmarks)), memory_(map.geometry().size() * row_bytes_ + kCacheLine) {
  rows_ = &memory_[0];
  while (reinterpret_cast<std::uintptr_t>(rows_) % kCacheLine != 0) ++rows_;
  try {
    Making(*this, map, stop).run(landmarks);
  } catch (const TooExpensive&) {
    landmarks_.clear();
  }
  if (!landmarks_.empty()) return;
  row_bytes_ = 0;
  memory_ = base::ZeroedArray<unsigned char>(kCacheLine);  // all rows are the same one
  rows_ = &memory_[0];
}

WideCost LandmarkTable::entry(std::uint32_t index, int landmark) const {
  if (wide_) return wideRow(index)[landmark];
  const CompactCost cost = row(index)[landmark];
  return cost == kNoCompactCost ? kNoWideCost : cost;
}

SearchKey LandmarkTable::keyOf(WideCost difference, const KeyScale& scale) const {
  if (wide_) return keyOfWide(difference, scale);
  return CompactCostUnit().keyOf(static_cast<CompactCost>(difference), scale);
}

CostDecreases::Place CostDecreases::placeOf(const LandmarkTable& table,
                                            const GridGeometry& geometry, const CellRect& rect) {
  const auto stride = static_cast<std::size_t>(table.stride());
  Place place{rect, std::vector<WideCost>(stride, kNoWideCost), std::vector<WideCost>(stride, 0)};
  const CellRect around = rect.grown(1).intersection(geometry.rect());
  for (int row = around.row; row < around.row + around.height; ++row)
    for (int column = around.column; column < around.column + around.width; ++column) {
      const std::uint32_t index = geometry.index({column, row}).value();
      for (std::size_t i = 0; i < stride; ++i) {
        const WideCost entry = table.entry(index, static_cast<int>(i));
        if (entry == kNoWideCost) continue;
        place.low[i] = std::min(place.low[i], entry);
        place.high[i] = std::max(place.high[i], entry);
      }
    }
  return place;
}

void CostDecreases::Place::join(const Place& other) {
  rect = rect.hull(other.rect);
  for (std::size_t i = 0; i < low.size(); ++i) {
    low[i] = std::min(low[i], other.low[i]);
    high[i] = std::max(high[i], other.high[i]);
  }
}

void CostDecreases::add(const LandmarkTable& table, const GridGeometry& geometry,
                        const CellRect& rect) {
  Place added = placeOf(table, geometry, rect);
  const auto near = [&added](const Place& place) {
    return !place.rect.grown(kMergeDistance).intersection(added.rect).empty();
  };
  const bool full = places_.size() == kMostPlaces;
  for (auto place = places_.begin(); place != places_.end();) {
    if (!full && !near(*place)) {
      ++place;
      continue;
    }
    added.join(*place);
    place = places_.erase(place);
  }
  places_.push_back(std::move(added));
}

CellRect CostDecreases::hull() const {
  CellRect all;
  for (const Place& place : places_) all = all.hull(place.rect);
  return all;
}

SearchKey CostDecreases::least(const LandmarkTable& table, std::uint32_t index,
                               const KeyScale& scale) const {
  SearchKey least = kInfiniteKey;
  for (const Place& place : places_) {
    WideCost outside = 0;
    for (std::size_t i = 0; i < place.low.size(); ++i) {
      const WideCost entry = table.entry(index, static_cast<int>(i));
      const bool silent = entry == kNoWideCost || place.low[i] > place.high[i];
      if (!silent) outside = std::max({outside, place.low[i] - entry, entry - place.high[i]});
    }
    least = std::min(least, table.keyOf(outside, scale));
  }
  return least;
}

LandmarkBound::LandmarkBound(const LandmarkTable& table, const CostDecreases& decreases,
                             std::uint32_t goal, const KeyScale& scale)
    : table_(table), decreases_(decreases), scale_(scale), goal_(goal) {
  if (table.wide())
    wide_goal_row_.assign(table.wideRow(goal), table.wideRow(goal) + table.stride());
  else
    goal_row_.assign(table.row(goal), table.row(goal) + table.stride());
  if (!decreases_.empty()) goal_to_decreases_ = decreases_.least(table_, goal, scale_);
}

SearchKey LandmarkBound::operator()(std::uint32_t index) const {
  const int stride = table_.stride();
  const SearchKey unchanged =
      table_.wide()
          ? keyOfWide(largestDifference(table_.wideRow(index), wide_goal_row_.data(), stride),
                      scale_)
          : CompactCostUnit().keyOf(largestDifference(table_.row(index), goal_row_.data(), stride),
                                    scale_);
  if (decreases_.empty()) return unchanged;
  return std::min(unchanged, decreases_.least(table_, index, scale_) + goal_to_decreases_);
}

bool LandmarkBound::separates(std::uint32_t index) const {
  if (!decreases_.empty()) return false;
  for (int i = 0; i < table_.stride(); ++i)
    if ((table_.entry(index, i) == kNoWideCost) != (table_.entry(goal_, i) == kNoWideCost))
      return true;
  return false;
}

}  // namespace grid_path_planner::planners
