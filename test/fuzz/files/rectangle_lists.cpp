// The lists of a rectangle file as they are before they are deflated: what deflate makes of damaged
// bytes hardly ever reaches them.
#include "grid/formats/rectangle_lists.h"

#include <sstream>

#include "fuzz/fuzz_target.h"

namespace grid_path_planner::fuzz {
namespace {

constexpr char kBetween = '\xff';  // lists; such bytes begin no number that is not too long

std::string inputOf(std::size_t count, grid::RectangleOrder order,
                    const std::vector<grid::CellRect>& rectangles) {
  std::string input = {static_cast<char>(order), static_cast<char>(count)};
  for (const std::string& list : grid::listsOf(rectangles, grid::GridGeometry(40, 30, 1.0), order))
    input += list + kBetween;
  return input;
}

std::vector<std::string> seedsOfLists() {
  const std::vector<grid::CellRect> two = {{0, 0, 4, 3}, {5, 0, 2, 3}};
  return {
      inputOf(2, grid::RectangleOrder::LARGEST_FIRST, two),
      inputOf(2, grid::RectangleOrder::BY_POSITION, two),
      inputOf(3, grid::RectangleOrder::AS_LISTED, {{9, 9, 1, 1}, {0, 0, 30, 3}, {0, 20, 9, 9}})};
}

FUZZ_TARGET(rectangle_lists, seedsOfLists) {
  if (input.size() < 2) return;
  const auto order = static_cast<grid::RectangleOrder>(static_cast<unsigned char>(input[0]) % 3);
  std::vector<std::string> lists(grid::numberOfLists(order));
  std::istringstream parts(input.substr(2));
  for (std::string& list : lists) std::getline(parts, list, kBetween);
  mayRefuse([&] {
    grid::rectanglesOf(lists, static_cast<unsigned char>(input[1]), grid::GridGeometry(40, 30, 1.0),
                       order);
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
