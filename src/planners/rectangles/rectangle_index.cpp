#include "planners/rectangles/rectangle_index.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <boost/iterator/transform_iterator.hpp>
#include <utility>

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using grid::Cell, grid::CellRect;

namespace {

namespace bg = boost::geometry;

using Point = bg::model::d2::point_xy<int>;
using Box = bg::model::box<Point>;
using Value = std::pair<Box, std::uint32_t>;

// From the first to the last cell: boxes intersect if they share a cell, neighbours do not.
Box boxOf(const CellRect& rect) {
  return {Point(rect.column, rect.row),
          Point(rect.column + rect.width - 1, rect.row + rect.height - 1)};
}

// Makes a value when the tree reads it, and polls the stop token.
struct ValueOf {
  const std::vector<CellRect>* rectangles;
  StopPoll* poll;

  Value operator()(std::uint32_t number) const {
    (*poll)();
    return {boxOf((*rectangles)[number]), number};
  }
};

}  // namespace

// Nodes are four fifths full.
static_assert(RectangleIndex::kBytes == sizeof(Value) * 5 / 4);

struct RectangleIndex::Tree {
  bg::index::rtree<Value, bg::index::quadratic<16>> values;
};

RectangleIndex::RectangleIndex() : tree_(std::make_unique<Tree>()) {}

RectangleIndex::RectangleIndex(const std::vector<CellRect>& rectangles, const StopToken& stop)
    : RectangleIndex() {
  StopPoll poll(stop);
  const auto at = [&](std::size_t number) {
    return boost::make_transform_iterator(
        boost::make_counting_iterator(static_cast<std::uint32_t>(number)),
        ValueOf{&rectangles, &poll});
  };
  tree_->values = decltype(tree_->values)(at(0), at(rectangles.size()));
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
  const std::vector<std::uint32_t> numbers = overlapping({cell.column, cell.row, 1, 1});
  return numbers.empty() ? std::nullopt : std::make_optional(numbers.front());
}

std::vector<std::uint32_t> RectangleIndex::overlapping(const CellRect& rect) const {
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
  return size() * kBytes;
}

}  // namespace grid_path_planner::planners
