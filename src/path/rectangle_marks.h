// Rectangles of cells, and links between places, drawn on a picture's map.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "grid_path_planner/path/path_image.h"
#include "path/canvas.h"

namespace grid_path_planner::path {

// Tinted and outlined; the outline is left out where there is no room.
void drawRectangles(Canvas& canvas, const PictureLayout& layout, const grid::GridGeometry& geometry,
                    const std::vector<grid::CellRect>& rectangles);

// From 1, in the middle of each; left out where there is no room.
void drawNumbers(Canvas& canvas, const PictureLayout& layout, const grid::GridGeometry& geometry,
                 const std::vector<grid::CellRect>& rectangles);

// Lines between dots.
void drawLinks(Canvas& canvas, const PictureLayout& layout,
               const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& links);

// What a legend shows for them: 2 `size` high, 4 wide at most.
void drawRectangleSymbol(Canvas& canvas, const Eigen::Vector2d& at, double size);
void drawLinkSymbol(Canvas& canvas, const Eigen::Vector2d& at, double size);

}  // namespace grid_path_planner::path
