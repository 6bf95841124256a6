#include "planners/tables/tiled_dijkstra.h"

namespace grid_path_planner::planners {

using base::Stopped, base::StopReason, base::StopToken, base::ZeroedArray;
using costmap::CostGrid;
using grid::Cell, grid::CellRect, grid::Grid;

namespace {

// A tile with so many offers that make cells cheaper is swept over, with fewer searched from these.
constexpr int kManyCheaper = 32;

constexpr std::uint32_t kLast = TileLayout::kSide - 1;

// What each step adds to a cell's number in its tile, modulo 2^32.
constexpr std::array<std::uint32_t, 8> kInsideOffsets = [] {
  std::array<std::uint32_t, 8> offsets{};
  for (std::size_t step = 0; step < offsets.size(); ++step)
    offsets[step] = static_cast<std::uint32_t>(
        kSteps[step].row * static_cast<int>(TileLayout::kSide) + kSteps[step].column);
  return offsets;
}();

// The steps that lead out of a tile, bit n for step n.
std::uint32_t stepsOutOf(std::uint32_t cell) {
  const std::uint32_t column = cell % TileLayout::kSide, row = cell / TileLayout::kSide;
  const std::uint32_t east = column == kLast ? 1 | 16 | 128 : 0;
  const std::uint32_t north = row == kLast ? 2 | 16 | 32 : 0;
  const std::uint32_t west = column == 0 ? 4 | 32 | 64 : 0;
  const std::uint32_t south = row == 0 ? 8 | 64 | 128 : 0;
  return east | north | west | south;
}

// Whether all cells weigh the same, and none is blocked.
bool isOpen(const Grid<CostGrid::Weight>& weights, const CellRect& rect) {
  const CostGrid::Weight weight = weights[{rect.column, rect.row}];
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    const CostGrid::Weight* first = weights.row(row) + rect.column;
    if (*first != weight || !std::equal(first + 1, first + rect.width, first)) return false;
  }
  return weight != CostGrid::kBlocked;
}

// Of those that are not blocked; 0 where all are.
SearchKey meanWeight(const Grid<CostGrid::Weight>& weights, const CellRect& rect) {
  std::size_t passable = 0, sum = 0;
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    const CostGrid::Weight* first = weights.row(row) + rect.column;
    for (const CostGrid::Weight* at = first; at != first + rect.width; ++at) {
      passable += *at != CostGrid::kBlocked ? 1 : 0;
      sum += *at;
    }
  }
  return sum / std::max<std::size_t>(passable, 1);
}

}  // namespace

template <class Label>
TiledDijkstra<Label>::TiledDijkstra(const CostGrid& map, ZeroedArray<Label>& labels,
                                    const KeyScale& scale, const StopToken& stop)
    : map_(map),
      labels_(labels),
      scale_(scale),
      stop_(stop),
      rules_(map),
      across_(TileLayout::along(map.geometry().width())),
      steps_(labels.size()),
      classes_(labels.size()),
      weights_(map.uniform() ? 0 : labels.size()),
      tiles_(TileLayout::tiles(map.geometry())) {
  for (std::size_t step = 0; step < lengths_.size(); ++step)
    lengths_[step] = step < 4 ? scale.straight : diagonalKey(scale, map.motion().diagonal_cost);
}

template <class Label>
void TiledDijkstra<Label>::addGoal(Cell goal) {
  const auto column = static_cast<std::uint32_t>(goal.column);
  const auto row = static_cast<std::uint32_t>(goal.row);
  deliver(row / kSide * across_ + column / kSide, {0, TileLayout::insideOf(column, row), kGoal});
}

template <class Label>
void TiledDijkstra<Label>::run(int threads) {
  std::vector<std::thread> others;
  try {
    for (int i = 1; i < threads; ++i) others.emplace_back([this] { workSafely(); });
  } catch (const std::system_error&) {
    // No memory for another thread's stack: those that there are do the work.
  }
  workSafely();
  for (std::thread& other : others) other.join();
  if (failure_) std::rethrow_exception(failure_);
  if (reason_ != StopReason::NONE) throw Stopped(reason_);
  if (too_expensive_) throw TooExpensive();
}

template <class Label>
void TiledDijkstra<Label>::deliver(std::size_t index, const Offer& offer) {
  Tile& tile = tiles_[index];
  tile.offers.push_back(offer);
  if (offer.key >= tile.least) return;
  tile.least = offer.key;
  if (!tile.busy) turns_.push({offer.key, index});
}

template <class Label>
void TiledDijkstra<Label>::workSafely() {
  try {
    work();
  } catch (...) {
    const std::lock_guard<std::mutex> lock(mutex_);
    failure_ = std::current_exception();
    ended_ = true;
    changed_.notify_all();
  }
}

template <class Label>
void TiledDijkstra<Label>::work() {
  Worker worker;
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    // 1. The tile with the least offer; there is none for good where no thread works either.
    changed_.wait(lock, [this] { return ended_ || !turns_.empty() || working_ == 0; });
    if (ended_ || turns_.empty()) break;
    const auto [least, index] = turns_.pop();
    Tile& tile = tiles_[index];
    if (tile.busy || tile.least != least) continue;

    // 2. Its search, while other threads search other tiles.
    tile.busy = true;
    tile.least = kInfiniteKey;
    worker.offers.swap(tile.offers);
    ++working_;
    lock.unlock();
    search(index, worker);
    const StopReason reason = stop_.reason();
    lock.lock();
    --working_;

    // 3. New offers to its neighbours, and those of its neighbours meanwhile.
    tile.busy = false;
    if (tile.least != kInfiniteKey) turns_.push({tile.least, index});
    for (const Sent& sent : worker.sent) deliver(sent.tile, sent.offer);
    worker.sent.clear();
    too_expensive_ = too_expensive_ || worker.too_expensive;
    if (reason != StopReason::NONE) reason_ = reason;
    ended_ = ended_ || too_expensive_ || reason_ != StopReason::NONE;
    changed_.notify_all();
  }
  changed_.notify_all();
}

template <class Label>
typename TiledDijkstra<Label>::View TiledDijkstra<Label>::viewOf(std::size_t tile) {
  const std::size_t first = tile * TileLayout::kCells;
  return {&labels_[first], &steps_[first], &classes_[first],
          map_.uniform() ? nullptr : &weights_[first]};
}

template <class Label>
CellRect TiledDijkstra<Label>::rectOf(std::size_t tile) const {
  const CellRect whole{static_cast<int>(tile % across_ * kSide),
                       static_cast<int>(tile / across_ * kSide), kSide, kSide};
  return whole.intersection(map_.geometry().rect());
}

// Classes and weights, and buckets half as wide as a step of the tile's mean weight.
template <class Label>
void TiledDijkstra<Label>::make(std::size_t index) {
  const View view = viewOf(index);
  const CellRect rect = rectOf(index);
  const CostGrid::Weight* weights = map_.weights().values().data();
  std::size_t at = 0;
  int column = 0;
  forEachEight(map_, rect, StopToken(),
               [&](std::size_t first, int number, const SimdNeighbourhood& cells) {
                 storeBytes(rules_.neighbourhoodClasses(cells), number, view.classes + at);
                 if (view.weights != nullptr)
                   std::copy_n(weights + first, number, view.weights + at);
                 at += static_cast<std::size_t>(number);
                 column += number;
                 if (column < rect.width) return;
                 at += kSide - static_cast<std::size_t>(column);
                 column = 0;
               });
  Tile& tile = tiles_[index];
  tile.open = isOpen(map_.weights(), rect);
  const SearchKey weight = map_.uniform() ? 1 : meanWeight(map_.weights(), rect);
  tile.bucket_shift = 63U - static_cast<unsigned>(__builtin_clzll(scale_.straight * weight / 2));
  tile.made = true;
}

template <class Label>
void TiledDijkstra<Label>::search(std::size_t index, Worker& worker) {
  const bool first = !tiles_[index].made;
  if (first) make(index);
  const View view = viewOf(index);
  if (tiles_[index].open && (first || manyAreCheaper(view, worker.offers))) {
    takeKeys(first, view, worker);
    sweep(index, view, worker);
    return;
  }
  SearchKey least = kInfiniteKey;
  for (const Offer& offer : worker.offers) least = std::min(least, offer.key);
  worker.open.reset(least, tiles_[index].bucket_shift);
  for (const Offer& offer : worker.offers) relax(view, offer, worker.open);
  worker.offers.clear();
  while (!worker.open.empty() && !worker.too_expensive) {
    const std::uint32_t from = worker.open.pop();
    if ((view.labels[from] & kOpen) != 0) expand(index, view, from, worker);
  }
}

template <class Label>
bool TiledDijkstra<Label>::manyAreCheaper(const View& view,
                                          const std::vector<Offer>& offers) const {
  int cheaper = 0;
  for (const Offer& offer : offers)
    cheaper += static_cast<Label>(scale_.largest - offer.key) > view.labels[offer.cell] ? 1 : 0;
  return cheaper >= kManyCheaper;
}

// Those of the tile's labels, none of which is read where all are new, and of what is offered.
template <class Label>
void TiledDijkstra<Label>::takeKeys(bool all_new, const View& view, Worker& worker) const {
  const Label* label = view.labels;
  if (all_new) worker.sweep.clear();
  for (std::uint32_t row = 0; row < kSide && !all_new; ++row)
    for (std::uint32_t column = 0; column < kSide; ++column, ++label)
      worker.sweep.key(column, row) = *label == 0 ? TileSweep::kNoKey : keyOf(*label);
  for (const Offer& offer : worker.offers) {
    SearchKey& key = worker.sweep.key(offer.cell % kSide, offer.cell / kSide);
    key = std::min(key, offer.key);
  }
  worker.offers.clear();
}

// What is beyond the map's border counts as open, too: no path through it is shorter.
template <class Label>
void TiledDijkstra<Label>::sweep(std::size_t index, const View& view, Worker& worker) {
  const SearchKey weight = view.weights == nullptr ? 1 : view.weights[0];
  const bool diagonals = map_.motion().connectivity == costmap::Connectivity::EIGHT;
  worker.sweep.run(lengths_[0] * weight, (diagonals ? lengths_[4] : 2 * lengths_[0]) * weight);
  keepSwept(index, view, worker);
}

// The keys that are less than before, and offers across the tile's border from them.
template <class Label>
void TiledDijkstra<Label>::keepSwept(std::size_t index, const View& view, Worker& worker) {
  const CellRect rect = rectOf(index);
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rect.height); ++row)
    for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(rect.width); ++column) {
      const SearchKey key = worker.sweep.key(column, row);
      if (isTooExpensive(key, worker)) return;
      const std::uint32_t cell = TileLayout::insideOf(column, row);
      const auto label = static_cast<Label>(scale_.largest - key);
      const Label known = view.labels[cell];
      if (label == known) continue;
      view.labels[cell] = label;
      if (known != 0) view.steps[cell] = 0;
      const std::uint32_t out = stepsOutOf(cell);
      if (out != 0)
        offerOutside(index, view, cell, out & rules_.after(0, view.classes[cell]), worker);
    }
}

// A cheaper path to a cell of the tile; or one of equal cost, after which other moves are natural.
template <class Label>
void TiledDijkstra<Label>::relax(const View& view, const Offer& offer, BucketQueue& open) const {
  Label& label = view.labels[offer.cell];
  std::uint8_t& steps = view.steps[offer.cell];
  const auto offered = static_cast<Label>(scale_.largest - offer.key);
  const Label known = label & ~kOpen;
  const auto bit = static_cast<std::uint8_t>(1U << offer.step);
  if (offered < known) return;
  if (offered > known) {
    steps = bit;
  } else {
    if (steps == 0 || !rules_.missing(steps, offer.step, view.classes[offer.cell])) return;
    steps = static_cast<std::uint8_t>(steps | bit);
    if ((label & kOpen) != 0) return;
  }
  label = offered | kOpen;
  open.push(offer.key, offer.cell);
}

template <class Label>
void TiledDijkstra<Label>::expand(std::size_t index, const View& view, std::uint32_t from,
                                  Worker& worker) {
  view.labels[from] &= ~kOpen;
  const std::uint32_t moves = rules_.after(view.steps[from], view.classes[from]);
  const std::uint32_t out = stepsOutOf(from);
  offerInside(view, from, moves & ~out, worker);
  if ((moves & out) != 0) offerOutside(index, view, from, moves & out, worker);
}

template <class Label>
void TiledDijkstra<Label>::offerInside(const View& view, std::uint32_t from, std::uint32_t moves,
                                       Worker& worker) {
  const SearchKey cost = keyOf(view.labels[from]);
  for (; moves != 0; moves &= moves - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(moves));
    const std::uint32_t to = from + kInsideOffsets[step];
    SearchKey length = lengths_[step];
    if (view.weights != nullptr) length *= std::max(view.weights[from], view.weights[to]);
    if (isTooExpensive(cost + length, worker)) return;
    relax(view, {cost + length, to, step}, worker.open);
  }
}

template <class Label>
void TiledDijkstra<Label>::offerOutside(std::size_t index, const View& view, std::uint32_t from,
                                        std::uint32_t moves, Worker& worker) {
  const SearchKey cost = keyOf(view.labels[from]);
  const CellRect rect = rectOf(index);
  for (; moves != 0; moves &= moves - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(moves));
    const Cell to{rect.column + static_cast<int>(from % kSide) + kSteps[step].column,
                  rect.row + static_cast<int>(from / kSide) + kSteps[step].row};
    SearchKey length = lengths_[step];
    if (view.weights != nullptr) length *= std::max(view.weights[from], map_.weight(to));
    if (isTooExpensive(cost + length, worker)) return;
    const auto column = static_cast<std::uint32_t>(to.column),
               row = static_cast<std::uint32_t>(to.row);
    worker.sent.push_back({row / kSide * across_ + column / kSide,
                           {cost + length, TileLayout::insideOf(column, row), step}});
  }
}

template <class Label>
bool TiledDijkstra<Label>::isTooExpensive(SearchKey key, Worker& worker) const {
  if (key < scale_.largest) return false;
  worker.too_expensive = true;
  return true;
}

template class TiledDijkstra<std::uint32_t>;
template class TiledDijkstra<std::uint64_t>;

}  // namespace grid_path_planner::planners
