#include "support/ascii_map.h"

#include <stdexcept>

namespace grid_path_planner::test {

using grid::Cell;
using grid::GridGeometry;
using grid::Origin;

namespace {

std::int8_t occupancyOf(char letter) {
  switch (letter) {
    case '.':
    case 'S':
    case 'G':
      return 0;
    case '#':
      return 100;
    case '?':
      return -1;
    default:
      throw std::invalid_argument(std::string("no such letter in a map: ") + letter);
  }
}

}  // namespace

AsciiMap::AsciiMap(const std::vector<std::string>& lines, double resolution, const Origin& origin)
    : map(GridGeometry(static_cast<int>(lines.at(0).size()), static_cast<int>(lines.size()),
                       resolution, origin)) {
  for (int row = 0; row < map.height(); ++row) {
    if (lines[row].size() != lines[0].size())
      throw std::invalid_argument("the lines of a map differ in length");
    for (int column = 0; column < map.width(); ++column) {
      const char letter = lines[row][column];
      map[Cell{column, row}] = occupancyOf(letter);
      if (letter == 'S') start = {column, row};
      if (letter == 'G') goal = {column, row};
    }
  }
}

}  // namespace grid_path_planner::test
