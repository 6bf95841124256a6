#include "grid_path_planner/planners/rectangle_graph.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "planners/rectangles/free_changes.h"
#include "planners/rectangles/rectangle_index.h"
#include "planners/rectangles/rectangle_union.h"

namespace grid_path_planner::planners {

using base::InputError, base::StopPoll, base::StopToken;
using costmap::BitMap;
using grid::Cell, grid::CellRect, grid::GridGeometry;

namespace {

// Rectangles within kNear cells of those that changed are cut anew with them; where these are fewer
// than kFew, those within kFar cells; never more than kMostRedone. Chosen by
// benchmark/rectangle_repair.
constexpr int kNear = 4, kFar = 16;
constexpr std::size_t kFew = 5, kMostRedone = 12;

std::string nameOf(const std::vector<CellRect>& rectangles, std::size_t number) {
  const CellRect& rect = rectangles[number];
  std::ostringstream out;
  out << "rectangle " << number << " [" << rect.column << ", " << rect.row << ", " << rect.width
      << ", " << rect.height << "]";
  return out.str();
}

// Without sums, which may overflow: the numbers may come from a file.
bool inside(const GridGeometry& geometry, const CellRect& rect) {
  return rect.column >= 0 && rect.row >= 0 && rect.column < geometry.width() &&
         rect.row < geometry.height() && rect.width <= geometry.width() - rect.column &&
         rect.height <= geometry.height() - rect.row;
}

void checkInside(const GridGeometry& geometry, const std::vector<CellRect>& rectangles) {
  for (std::size_t i = 0; i < rectangles.size(); ++i) {
    if (rectangles[i].empty()) throw InputError(nameOf(rectangles, i) + " holds no cell");
    if (!inside(geometry, rectangles[i]))
      throw InputError(nameOf(rectangles, i) + " leaves the map of " +
                       std::to_string(geometry.width()) + "x" + std::to_string(geometry.height()) +
                       " cells");
  }
}

void checkDisjoint(const RectangleIndex& index, const std::vector<CellRect>& rectangles,
                   const StopToken& stop) {
  StopPoll poll(stop);
  for (std::size_t i = 0; i < rectangles.size(); ++i) {
    poll();
    for (const std::uint32_t other : index.overlapping(rectangles[i]))
      if (other != i)
        throw InputError(nameOf(rectangles, i) + " overlaps " + nameOf(rectangles, other));
  }
}

std::int64_t areaOf(const CellRect& rect) {
  return std::int64_t{rect.width} * rect.height;
}

void sortUnique(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

bool contains(const std::vector<std::uint32_t>& ascending, std::uint32_t number) {
  return std::binary_search(ascending.begin(), ascending.end(), number);
}

}  // namespace

// Replaces rectangles of a map by others, and records which.
class RectangleGraph::Replacement {
 public:
  explicit Replacement(RectangleGraph& map) : map_(map) {}

  // `old`: numbers, ascending. All rectangles that touch one of `fresh` are in `around`, in `old` or
  // neighbours of `old`.
  void replace(std::vector<std::uint32_t> old, std::vector<CellRect> fresh,
               std::vector<std::uint32_t> around) {
    removeCommon(old, fresh);
    for (const std::uint32_t number : old)
      for (const Connection& connection : map_.connections_.of(number))
        around.push_back(connection.to);
    sortUnique(around);
    const auto is_old = [&old](std::uint32_t number) { return contains(old, number); };
    around.erase(std::remove_if(around.begin(), around.end(), is_old), around.end());
    // The larger rectangles get the smaller numbers.
    std::for_each(old.rbegin(), old.rend(), [this](std::uint32_t number) { remove(number); });
    std::stable_sort(fresh.begin(), fresh.end(),
                     [](const CellRect& a, const CellRect& b) { return areaOf(a) > areaOf(b); });
    for (const CellRect& rect : fresh) {
      const std::uint32_t number = add(rect, around);
      around.insert(std::lower_bound(around.begin(), around.end(), number), number);
    }
  }

  RectangleEdit edit() {
    std::stable_sort(events_.begin(), events_.end(),
                     [](const Event& a, const Event& b) { return a.number < b.number; });
    RectangleEdit edit;
    for (std::size_t i = 0; i < events_.size(); ++i) {
      const Event& event = events_[i];
      if (i > 0 && events_[i - 1].number == event.number) continue;
      if (!event.added) edit.removed.push_back(event.number);
      if (!map_.rectangles_[event.number].empty()) edit.added.push_back(event.number);
    }
    return edit;
  }

 private:
  struct Event {
    std::uint32_t number;
    bool added;
  };

  // Rectangles in both lists stay as they are.
  void removeCommon(std::vector<std::uint32_t>& old, std::vector<CellRect>& fresh) const {
    const auto is_common = [&](std::uint32_t number) {
      const auto same = std::find(fresh.begin(), fresh.end(), map_.rectangles_[number]);
      if (same == fresh.end()) return false;
      fresh.erase(same);
      return true;
    };
    old.erase(std::remove_if(old.begin(), old.end(), is_common), old.end());
  }

  void remove(std::uint32_t number) {
    map_.connections_.remove(number);
    map_.index_->remove(map_.rectangles_[number], number);
    map_.rectangles_[number] = CellRect();
    map_.vacant_.push_back(number);
    events_.push_back({number, false});
  }

  std::uint32_t add(const CellRect& rect, const std::vector<std::uint32_t>& around) {
    auto number = static_cast<std::uint32_t>(map_.rectangles_.size());
    if (map_.vacant_.empty()) {
      map_.rectangles_.emplace_back();
    } else {
      number = map_.vacant_.back();
      map_.vacant_.pop_back();
    }
    map_.rectangles_[number] = rect;
    map_.index_->add(rect, number);
    touching_.clear();
    for (const std::uint32_t other : around)
      if (const auto connection =
              connectionBetween(rect, map_.rectangles_[other], other, map_.touching_))
        touching_.push_back(*connection);
    map_.connections_.add(number, touching_);
    events_.push_back({number, true});
    return number;
  }

  RectangleGraph& map_;
  std::vector<Event> events_;
  std::vector<Connection> touching_;
};

RectangleGraph::RectangleGraph() : index_(std::make_unique<RectangleIndex>()) {}

RectangleGraph::RectangleGraph(const GridGeometry& geometry, std::vector<CellRect> rectangles,
                               Touching touching, const StopToken& stop)
    : geometry_(geometry), touching_(touching), rectangles_(std::move(rectangles)) {
  checkInside(geometry_, rectangles_);
  index_ = std::make_unique<RectangleIndex>(rectangles_, stop);
  checkDisjoint(*index_, rectangles_, stop);
  connections_ = Connections(rectangles_, touching, stop);
}

RectangleGraph::~RectangleGraph() = default;
RectangleGraph::RectangleGraph(RectangleGraph&&) noexcept = default;
RectangleGraph& RectangleGraph::operator=(RectangleGraph&&) noexcept = default;

std::optional<std::uint32_t> RectangleGraph::at(Cell cell) const {
  return index_->at(cell);
}

std::size_t RectangleGraph::count() const {
  return rectangles_.size() - vacant_.size();
}

RectangleEdit RectangleGraph::edit(const BitMap& free, const CellRect& changed,
                                   const StopToken& stop) {
  const CellRect inside = changed.intersection(geometry_.rect());
  std::vector<CellRect> overlapped;
  for (const std::uint32_t number : index_->overlapping(inside))
    overlapped.push_back(rectangles_[number]);
  Replacement replacement(*this);
  StopPoll poll(stop, 8);
  for (const FreeChanges& each : groupedByPlace(freeChanges(free, overlapped, inside, stop))) {
    poll();
    repair(each, replacement, stop);
  }
  return replacement.edit();
}

void RectangleGraph::repair(const FreeChanges& changes, Replacement& replacement,
                            const StopToken& stop) {
  std::vector<std::uint32_t> touched, around;
  const auto append = [this](const CellRect& rect, std::vector<std::uint32_t>& numbers) {
    for (const std::uint32_t number : index_->overlapping(rect)) numbers.push_back(number);
  };
  for (const CellRect& rect : changes.lost) append(rect, touched);
  for (const CellRect& rect : changes.gained) {
    append({rect.column - 1, rect.row, rect.width + 2, rect.height}, touched);
    append({rect.column, rect.row - 1, rect.width, rect.height + 2}, touched);
    append(rect.grown(1), around);
  }
  sortUnique(touched);
  std::vector<CellRect> free = changes.gained;
  for (const std::uint32_t number : touched) free.push_back(rectangles_[number]);
  std::vector<CellRect> fresh = fewestRectangles(free, changes.lost, stop);

  // With rectangles nearby, where that gives no more in total: else edits would fragment the map.
  const std::vector<std::uint32_t> others = nearby(changes.hull(), touched);
  if (!others.empty()) {
    for (const std::uint32_t number : others) free.push_back(rectangles_[number]);
    std::vector<CellRect> wider = fewestRectangles(free, changes.lost, stop);
    if (wider.size() <= fresh.size() + others.size()) {
      fresh = std::move(wider);
      touched.insert(touched.end(), others.begin(), others.end());
      std::sort(touched.begin(), touched.end());
    }
  }
  replacement.replace(std::move(touched), std::move(fresh), std::move(around));
}

std::vector<std::uint32_t> RectangleGraph::nearby(const CellRect& changed,
                                                  const std::vector<std::uint32_t>& touched) const {
  std::vector<std::uint32_t> numbers = index_->overlapping(changed.grown(kNear));
  if (numbers.size() < kFew) numbers = index_->overlapping(changed.grown(kFar));
  const auto isTouched = [&touched](std::uint32_t number) { return contains(touched, number); };
  numbers.erase(std::remove_if(numbers.begin(), numbers.end(), isTouched), numbers.end());
  if (numbers.size() + touched.size() > kMostRedone)
    numbers.resize(kMostRedone - std::min(kMostRedone, touched.size()));
  return numbers;
}

std::size_t RectangleGraph::freeCells() const {
  std::size_t cells = 0;
  for (const CellRect& rect : rectangles_) cells += static_cast<std::size_t>(areaOf(rect));
  return cells;
}

std::size_t RectangleGraph::bytes() const {
  return rectangles_.capacity() * sizeof(CellRect) + vacant_.capacity() * sizeof(std::uint32_t) +
         connections_.bytes() + index_->bytes();
}

std::size_t RectangleGraph::bytesFor(std::size_t rectangles) {
  return rectangles * (sizeof(CellRect) + RectangleIndex::kBytes + Connections::kMakingBytes);
}

}  // namespace grid_path_planner::planners
