#include "grid_path_planner/rectangles/rectangle_keeper.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "grid_path_planner/rectangles/decomposition.h"

namespace grid_path_planner {
namespace {

// How many updates after it was begun a new decomposition is taken over: at ten a second more time
// than it takes.
std::size_t updatesUntilTakenOver(const GridGeometry& geometry) {
  return std::max<std::size_t>(64, geometry.size() >> 14);
}

RectangleGraph decomposed(const CostGrid& map, const StopToken& stop, std::size_t memory) {
  DecompositionLimits limits;
  limits.bytes = memory;
  std::vector<CellRect> rectangles = largestFirst(map.bitMaps(stop), limits, stop);
  rectangles.shrink_to_fit();
  if (RectangleGraph::bytesFor(rectangles.size()) > memory) throw DecompositionTooLarge();
  return RectangleGraph(map.geometry(), std::move(rectangles), Touching::BORDERS, stop);
}

}  // namespace

void RectangleKeeper::prepare(std::shared_ptr<const CostGrid> map, const StopToken& stop,
                              std::size_t memory) {
  making_.stop();
  begun_ = false;
  map_ = std::move(map);
  rectangles_ = RectangleGraph();
  rectangles_ = decomposed(*map_, stop, memory);
  decomposed_ = rectangles_.count();
  edited_ = 0;
}

void RectangleKeeper::update(std::shared_ptr<const CostGrid> map, const CellRect& changed,
                             const StopToken& stop, std::size_t memory) {
  map_ = std::move(map);
  edit(changed, stop);
  if (begun_) {
    since_begin_.push_back(changed);
    if (since_begin_.size() >= updatesUntilTakenOver(map_->geometry())) takeOver(stop);
  } else if (edited_ > kRedoAfter * std::max(decomposed_, kLeastRectangles)) {
    begin(memory);
  }
}

BackgroundWork RectangleKeeper::work() const {
  BackgroundWork work;
  work.pending = begun_;
  work.time_s = time_s_;
  return work;
}

void RectangleKeeper::finish(const StopToken& stop) {
  if (begun_) takeOver(stop);
}

void RectangleKeeper::edit(const CellRect& changed, const StopToken& stop) {
  edited_ += rectangles_.edit(map_->bitMaps(stop).rows, changed, stop).added.size();
}

void RectangleKeeper::begin(std::size_t memory) {
  edited_ = 0;
  begun_ = true;
  since_begin_.clear();
  const std::size_t left = memory - std::min(memory, rectangles_.bytes());
  making_.start([map = map_, left](const StopToken& stop) mutable {
    const auto begin = StopToken::Clock::now();
    Made made;
    try {
      made.rectangles = std::make_unique<RectangleGraph>(decomposed(*map, stop, left));
    } catch (const DecompositionTooLarge&) {
    }
    map.reset();  // whoever changes the map next may have it
    made.time_s = std::chrono::duration<double>(StopToken::Clock::now() - begin).count();
    return made;
  });
}

void RectangleKeeper::takeOver(const StopToken& stop) {
  making_.wait(stop);
  begun_ = false;
  const std::shared_ptr<const Made> made = making_.take();
  if (!made || !made->rectangles) return;  // for want of memory: the edited ones are as right
  time_s_ = made->time_s;
  rectangles_ = std::move(*made->rectangles);
  decomposed_ = rectangles_.count();
  edited_ = 0;
  for (const CellRect& changed : since_begin_) edit(changed, stop);
}

}  // namespace grid_path_planner
