#include "grid_path_planner/rectangles/rectangle_index.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <utility>

namespace grid_path_planner {
namespace {

namespace bg = boost::geometry;

using Point = bg::model::d2::point_xy<int>;
using Box = bg::model::box<Point>;
using Value = std::pair<Box, std::uint32_t>;

// The first and the last cell: boxes that share a cell meet, neighbours do not.
Box boxOf(const CellRect& rect) {
  return {Point(rect.column, rect.row),
          Point(rect.column + rect.width - 1, rect.row + rect.height - 1)};
}

}  // namespace

struct RectangleIndex::Tree {
  bg::index::rtree<Value, bg::index::quadratic<16>> values;
};

RectangleIndex::RectangleIndex() : tree_(std::make_unique<Tree>()) {}

RectangleIndex::RectangleIndex(const std::vector<CellRect>& rectangles) : RectangleIndex() {
  std::vector<Value> values;
  values.reserve(rectangles.size());
  for (const CellRect& rect : rectangles)
    values.emplace_back(boxOf(rect), static_cast<std::uint32_t>(values.size()));
  tree_->values = decltype(tree_->values)(values.begin(), values.end());
}

RectangleIndex::~RectangleIndex() = default;
RectangleIndex::RectangleIndex(RectangleIndex&&) noexcept = default;
RectangleIndex& RectangleIndex::operator=(RectangleIndex&&) noexcept = default;

void RectangleIndex::add(const CellRect& rect, std::uint32_t number) {
  tree_->values.insert({boxOf(rect), number});
}

void RectangleIndex::remove(const CellRect& rect, std::uint32_t number) {
  tree_->values.remove({boxOf(rect), number});
}

std::optional<std::uint32_t> RectangleIndex::at(Cell cell) const {
  const std::vector<std::uint32_t> numbers = meeting({cell.column, cell.row, 1, 1});
  return numbers.empty() ? std::nullopt : std::make_optional(numbers.front());
}

std::vector<std::uint32_t> RectangleIndex::meeting(const CellRect& rect) const {
  std::vector<std::uint32_t> numbers;
  if (rect.empty()) return numbers;
  const auto keep = [&numbers](const Value& value) { numbers.push_back(value.second); };
  tree_->values.query(bg::index::intersects(boxOf(rect)),
                      boost::make_function_output_iterator(keep));
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::size_t RectangleIndex::size() const {
  return tree_->values.size();
}

std::size_t RectangleIndex::bytes() const {
  return size() * sizeof(Value) * 5 / 4;
}

}  // namespace grid_path_planner
