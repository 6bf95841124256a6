#include "grid_path_planner/rectangles/rectangle_map.h"

#include <sstream>
#include <string>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/rectangles/rectangle_index.h"

namespace grid_path_planner {
namespace {

std::string nameOf(const std::vector<CellRect>& rectangles, std::size_t number) {
  const CellRect& rect = rectangles[number];
  std::ostringstream out;
  out << "rectangle " << number << " [" << rect.column << ", " << rect.row << ", " << rect.width
      << ", " << rect.height << "]";
  return out.str();
}

// Without sums that might overflow: the numbers may come from a file.
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

void checkDisjoint(const RectangleIndex& index, const std::vector<CellRect>& rectangles) {
  for (std::size_t i = 0; i < rectangles.size(); ++i)
    for (const std::uint32_t other : index.meeting(rectangles[i]))
      if (other != i)
        throw InputError(nameOf(rectangles, i) + " overlaps " + nameOf(rectangles, other));
}

}  // namespace

RectangleMap::RectangleMap() : index_(std::make_unique<RectangleIndex>()) {}

RectangleMap::RectangleMap(const GridGeometry& geometry, std::vector<CellRect> rectangles,
                           Touching touching)
    : geometry_(geometry), rectangles_(std::move(rectangles)) {
  checkInside(geometry_, rectangles_);
  index_ = std::make_unique<RectangleIndex>(rectangles_);
  checkDisjoint(*index_, rectangles_);
  connections_ = Connections(rectangles_, touching);
}

RectangleMap::~RectangleMap() = default;
RectangleMap::RectangleMap(RectangleMap&&) noexcept = default;
RectangleMap& RectangleMap::operator=(RectangleMap&&) noexcept = default;

std::optional<std::uint32_t> RectangleMap::at(Cell cell) const {
  return index_->at(cell);
}

std::size_t RectangleMap::freeCells() const {
  std::size_t cells = 0;
  for (const CellRect& rect : rectangles_)
    cells += static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height);
  return cells;
}

std::size_t RectangleMap::bytes() const {
  return rectangles_.capacity() * sizeof(CellRect) + connections_.bytes() + index_->bytes();
}

}  // namespace grid_path_planner
