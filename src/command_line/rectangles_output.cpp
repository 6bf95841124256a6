#include "command_line/rectangles_output.h"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <utility>
#include <vector>

#include "grid_path_planner/path/path_image.h"

namespace grid_path_planner::command_line {

using grid::CellRect, grid::GridGeometry, grid::OccupancyGrid;
using path::PictureContent, path::writePicture;
using planners::Connection, planners::MapSizes, planners::RectangleGraph, planners::RectangleWeight;

namespace {

// Up to kMostLines connections are printed; of more, the first kFewLines.
constexpr std::size_t kMostLines = 40;
constexpr std::size_t kFewLines = 10;

nlohmann::json jsonOf(const MapSizes& sizes) {
  return {{"entire_map", sizes.entire_map},
          {"empty_cells", sizes.empty_cells},
          {"rectangles", sizes.rectangles},
          {"file", sizes.file},
          {"png", sizes.png},
          {"zlib", sizes.zlib}};
}

std::string counted(std::size_t number, const std::string& thing) {
  return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
}

void printConnections(const RectangleGraph& map, RectangleWeight weight) {
  const std::size_t count = map.connections().count();
  const std::size_t shown = count <= kMostLines ? count : kFewLines;
  std::size_t number = 0;
  visitConnections(map, [&](std::uint32_t from, const Connection& step) {
    if (++number > shown) return;
    std::cout << from + 1 << " -> " << step.to + 1 << ": " << weightOf(map, weight, from, step)
              << '\n';
  });
  if (shown < count) std::cout << "... and " << count - shown << " more: --json tells them all\n";
}

// The middle of the border that two rectangles share, or their corner, in cells.
Eigen::Vector2d middleOfBorder(const CellRect& a, const CellRect& b) {
  const auto middle = [](int begin_a, int size_a, int begin_b, int size_b) {
    return 0.5 * (std::max(begin_a, begin_b) + std::min(begin_a + size_a, begin_b + size_b));
  };
  return {middle(a.column, a.width, b.column, b.width), middle(a.row, a.height, b.row, b.height)};
}

// From each rectangle's centre to the middles of its borders, which never leaves the rectangle.
std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> linksOf(const RectangleGraph& map) {
  const GridGeometry& geometry = map.geometry();
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> links;
  visitConnections(map, [&](std::uint32_t from, const Connection& step) {
    const CellRect &a = map.rectangles()[from], &b = map.rectangles()[step.to];
    links.emplace_back(geometry.worldFromGrid(centreOf(a)),
                       geometry.worldFromGrid(middleOfBorder(a, b)));
  });
  return links;
}

nlohmann::json weightsOf(const RectangleGraph& map, RectangleWeight weight) {
  nlohmann::json weights = nlohmann::json::array();
  visitConnections(map, [&](std::uint32_t from, const Connection& step) {
    weights.push_back({from, step.to, weightOf(map, weight, from, step)});
  });
  return weights;
}

}  // namespace

nlohmann::json jsonOf(const RectanglesRequest& request, const RectanglesResult& result) {
  nlohmann::json rectangles = nlohmann::json::array();
  for (const CellRect& rect : result.in_file)
    rectangles.push_back({rect.column, rect.row, rect.width, rect.height});
  nlohmann::json object = {{"cells", result.map.geometry().size()},
                           {"cells_in_rectangles", result.map.freeCells()},
                           {"count", result.in_file.size()},
                           {"connections", result.map.connections().count() / 2},
                           {"bytes", result.sizes.file},
                           {"sizes", jsonOf(result.sizes)},
                           {"time_ms", result.time_ms},
                           {"rectangles", std::move(rectangles)}};
  if (request.weight) object["weights"] = weightsOf(result.map, *request.weight);
  return object;
}

void print(const RectanglesRequest& request, const RectanglesResult& result) {
  const GridGeometry& geometry = result.map.geometry();
  const MapSizes& sizes = result.sizes;
  std::cout << request.map << ": " << geometry.width() << "x" << geometry.height() << " cells, "
            << result.map.freeCells() << " of them in "
            << counted(result.in_file.size(), "rectangle") << " with "
            << counted(result.map.connections().count() / 2, "connection") << ", cut in "
            << std::setprecision(3) << result.time_ms << " ms\n"
            << "bytes: " << sizes.file << " as a file, " << sizes.rectangles
            << " as a list of rectangles, " << sizes.empty_cells << " as a list of free cells; "
            << sizes.entire_map << " as bits, " << sizes.png << " as PNG, " << sizes.zlib
            << " as bits in zlib\n"
            << std::setprecision(6);
  if (request.weight) printConnections(result.map, *request.weight);
}

void draw(const std::string& file, const RectanglesRequest& request, const RectanglesResult& result,
          const OccupancyGrid& map) {
  PictureContent content;
  content.rectangles = result.map.rectangles();
  if (request.weight) content.links = linksOf(result.map);
  writePicture(file, map, {}, content);
}

}  // namespace grid_path_planner::command_line
