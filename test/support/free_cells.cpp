#include "support/free_cells.h"

#include <algorithm>
#include <stdexcept>

namespace grid_path_planner::test {

using base::StopToken;
using costmap::BitMaps;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;

namespace {

GridGeometry geometryUpTo(std::mt19937& random, int largest_side) {
  std::uniform_int_distribution<int> side(1, largest_side);
  const int width = side(random);
  return GridGeometry(width, side(random), 1.0);
}

}  // namespace

FreeCells freeCells(const std::vector<std::string>& lines) {
  FreeCells free(
      GridGeometry(static_cast<int>(lines.at(0).size()), static_cast<int>(lines.size()), 1.0));
  for (int row = 0; row < free.height(); ++row) {
    const std::string& line = lines[static_cast<std::size_t>(row)];
    if (line.size() != lines[0].size()) throw std::invalid_argument("lines of different lengths");
    for (int column = 0; column < free.width(); ++column) {
      const char letter = line[static_cast<std::size_t>(column)];
      free[Cell{column, row}] = letter == '1' || letter == '.' ? 1 : 0;
    }
  }
  return free;
}

FreeCells publishedExample() {
  return freeCells({"1100111111",  //
                    "1100111000",  //
                    "1110111000",  //
                    "1111111111",  //
                    "1100000111",  //
                    "1100000111",  //
                    "1100000100",  //
                    "1111111100",  //
                    "0000111100",  //
                    "1111111100"});
}

FreeCells randomFreeCells(std::mt19937& random, int largest_side, double free) {
  FreeCells cells(geometryUpTo(random, largest_side));
  std::bernoulli_distribution draw(free);
  for (std::uint8_t& cell : cells.values()) cell = draw(random) ? 1 : 0;
  return cells;
}

FreeCells randomBlocks(std::mt19937& random, int largest_side) {
  FreeCells cells(geometryUpTo(random, largest_side), 1);
  std::uniform_int_distribution<int> count(0, 12), side(1, 1 + largest_side / 5);
  std::uniform_int_distribution<int> column(0, cells.width() - 1), row(0, cells.height() - 1);
  for (int blocks = count(random); blocks > 0; --blocks) {
    const CellRect block =
        CellRect{column(random), row(random), side(random), side(random)}.intersection(
            cells.geometry().rect());
    fillCells(cells, block, 0);
  }
  return cells;
}

BitMaps bitMapsOf(const FreeCells& free) {
  Grid<std::uint16_t> weights(free.geometry());
  for (std::size_t i = 0; i < free.values().size(); ++i) weights.values()[i] = free.values()[i];
  return BitMaps(weights, StopToken());
}

void fillCells(FreeCells& cells, const CellRect& rect, std::uint8_t value) {
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      cells[Cell{column, row}] = value;
}

bool isPartition(const FreeCells& free, const std::vector<CellRect>& rectangles) {
  FreeCells left = free;
  for (const CellRect& rect : rectangles) {
    if (rect.empty()) return false;
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      for (int column = rect.column; column < rect.column + rect.width; ++column) {
        if (!left.contains({column, row})) return false;
        std::uint8_t& cell = left[Cell{column, row}];
        if (cell == 0) return false;
        cell = 0;
      }
  }
  return std::count(left.values().begin(), left.values().end(), 0) ==
         static_cast<std::ptrdiff_t>(left.values().size());
}

}  // namespace grid_path_planner::test
