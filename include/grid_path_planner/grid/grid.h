// A map of values: a geometry and one value a cell, row-major, row 0 first.
#pragma once

#include <cassert>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/grid/grid_geometry.h"

namespace grid_path_planner::grid {

template <class T>
class Grid {
 public:
  Grid() = default;
  explicit Grid(const GridGeometry& geometry, T value = T())
      : geometry_(geometry), values_(geometry.size(), value) {}
  // Throws InputError where values.size() is not width x height.
  Grid(const GridGeometry& geometry, std::vector<T> values)
      : geometry_(geometry), values_(std::move(values)) {
    if (values_.size() != geometry_.size())
      throw base::InputError("a map of " + std::to_string(geometry.width()) + "x" +
                             std::to_string(geometry.height()) + " cells needs " +
                             std::to_string(geometry.size()) + " values, got " +
                             std::to_string(values_.size()));
  }

  const GridGeometry& geometry() const { return geometry_; }
  int width() const { return geometry_.width(); }
  int height() const { return geometry_.height(); }
  bool contains(Cell cell) const { return geometry_.contains(cell); }

  // Precondition: contains(cell).
  const T& operator[](Cell cell) const { return (*this)[geometry_.index(cell)]; }
  T& operator[](Cell cell) { return (*this)[geometry_.index(cell)]; }
  const T& operator[](CellIndex index) const {
    assert(index.value() < values_.size());
    return values_[index.value()];
  }
  T& operator[](CellIndex index) {
    assert(index.value() < values_.size());
    return values_[index.value()];
  }

  const std::vector<T>& values() const { return values_; }
  std::vector<T>& values() { return values_; }
  const T* row(int row) const { return values_.data() + static_cast<std::size_t>(row) * width(); }
  T* row(int row) { return values_.data() + static_cast<std::size_t>(row) * width(); }

  friend bool operator==(const Grid& a, const Grid& b) {
    return a.geometry_ == b.geometry_ && a.values_ == b.values_;
  }

 private:
  GridGeometry geometry_;
  std::vector<T> values_;
};

}  // namespace grid_path_planner::grid
