// An index of disjoint rectangles by place, with insertion and removal: the R-tree (Guttman 1984) of
// Boost.Geometry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::planners {

class RectangleIndex {
 public:
  // About, for each of many rectangles.
  static constexpr std::size_t kBytes = 25;

  RectangleIndex();
  // Numbered by their place in the list; bulk loading gives a better tree. Throws Stopped.
  explicit RectangleIndex(const std::vector<grid::CellRect>& rectangles,
                          const base::StopToken& stop = base::StopToken());
  ~RectangleIndex();
  RectangleIndex(RectangleIndex&&) noexcept;
  RectangleIndex& operator=(RectangleIndex&&) noexcept;

  void add(const grid::CellRect& rect, std::uint32_t number);
  // Precondition: it was added.
  void remove(const grid::CellRect& rect, std::uint32_t number);

  std::optional<std::uint32_t> at(grid::Cell cell) const;
  // The numbers of those that overlap `rect`, ascending.
  std::vector<std::uint32_t> overlapping(const grid::CellRect& rect) const;

  std::size_t size() const;
  // About: the tree has no exact number.
  std::size_t bytes() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace grid_path_planner::planners
