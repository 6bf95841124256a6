// Which of many disjoint rectangles lie where, while they come and go: an R-tree (Guttman 1984),
// Boost.Geometry's.
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
  // About, of one of many rectangles.
  static constexpr std::size_t kBytes = 25;

  RectangleIndex();
  // Numbered by their place in the list; made in bulk, which gives a better tree. Throws Stopped.
  explicit RectangleIndex(const std::vector<grid::CellRect>& rectangles,
                          const base::StopToken& stop = base::StopToken());
  ~RectangleIndex();
  RectangleIndex(RectangleIndex&&) noexcept;
  RectangleIndex& operator=(RectangleIndex&&) noexcept;

  void add(const grid::CellRect& rect, std::uint32_t number);
  // Precondition: it was added.
  void remove(const grid::CellRect& rect, std::uint32_t number);

  std::optional<std::uint32_t> at(grid::Cell cell) const;
  // The numbers of those that hold a cell of `rect`, ascending.
  std::vector<std::uint32_t> meeting(const grid::CellRect& rect) const;

  std::size_t size() const;
  // About: the tree tells only its size.
  std::size_t bytes() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace grid_path_planner::planners
