#include "planners/tables/tiled_dijkstra.h"

namespace grid_path_planner::planners {

using base::Stopped, base::StopReason, base::StopToken, base::ZeroedArray;
using costmap::CostGrid;
using grid::Cell, grid::CellRect;

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
    lengths_[step] = (step < 4 ? scale.straight : diagonalKey(scale, map.motion().diagonal_cost)) *
                     (map.uniform() ? map.minWeight() : 1);
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

// Classes and weights, and buckets half as wide as a step of the tile's mean weight.
template <class Label>
void TiledDijkstra<Label>::make(std::size_t index) {
  const View view = viewOf(index);
  const CellRect rect = CellRect{static_cast<int>(index % across_ * kSide),
                                 static_cast<int>(index / across_ * kSide), kSide, kSide}
                            .intersection(map_.geometry().rect());
  const CostGrid::Weight* weights = map_.weights().values().data();
  std::size_t at = 0, passable = 0, sum = 0;
  int column = 0;
  forEachEight(map_, rect, StopToken(),
               [&](std::size_t first, int number, const SimdNeighbourhood& cells) {
                 storeBytes(rules_.neighbourhoodClasses(cells), number, view.classes + at);
                 if (view.weights != nullptr)
                   std::copy_n(weights + first, number, view.weights + at);
                 for (std::size_t i = first; i < first + static_cast<std::size_t>(number); ++i) {
                   passable += weights[i] != CostGrid::kBlocked ? 1 : 0;
                   sum += weights[i];
                 }
                 at += static_cast<std::size_t>(number);
                 column += number;
                 if (column < rect.width) return;
                 at += kSide - static_cast<std::size_t>(column);
                 column = 0;
               });
  const SearchKey width = scale_.straight * (sum / std::max<std::size_t>(passable, 1)) / 2;
  tiles_[index].bucket_shift = 63U - static_cast<unsigned>(__builtin_clzll(width));
  tiles_[index].made = true;
}

template <class Label>
void TiledDijkstra<Label>::search(std::size_t index, Worker& worker) {
  if (!tiles_[index].made) make(index);
  const View view = viewOf(index);
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
  const SearchKey cost = keyOf(view.labels[from]);
  for (std::uint32_t moves = rules_.after(view.steps[from], view.classes[from]); moves != 0;
       moves &= moves - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(moves));
    // In the tile, -1 or kSide: wrapped around, both have bits that no number in the tile has.
    const std::uint32_t column = from % kSide + static_cast<std::uint32_t>(kSteps[step].column);
    const std::uint32_t row = from / kSide + static_cast<std::uint32_t>(kSteps[step].row);
    const std::uint32_t to = TileLayout::insideOf(column, row);
    const bool inside = (column | row) < kSide;
    SearchKey length = lengths_[step];
    std::size_t tile = index;
    if (!inside) {
      const auto west_column = static_cast<std::uint32_t>(index % across_ * kSide);
      const auto low_row = static_cast<std::uint32_t>(index / across_ * kSide);
      const std::uint32_t map_column = west_column + column, map_row = low_row + row;
      tile = map_row / kSide * across_ + map_column / kSide;
      if (view.weights != nullptr)
        length *= std::max(view.weights[from],
                           map_.weight({static_cast<int>(map_column), static_cast<int>(map_row)}));
    } else if (view.weights != nullptr) {
      length *= std::max(view.weights[from], view.weights[to]);
    }
    const Offer offer{cost + length, to, step};
    if (offer.key >= scale_.largest) {
      worker.too_expensive = true;
      return;
    }
    if (inside)
      relax(view, offer, worker.open);
    else
      worker.sent.push_back({tile, offer});
  }
}

template class TiledDijkstra<std::uint32_t>;
template class TiledDijkstra<std::uint64_t>;

}  // namespace grid_path_planner::planners
