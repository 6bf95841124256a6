// Rectangles of cells, and links between places, drawn on a picture's map.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "canvas.h"
#include "grid_path_planner/path/picture.h"

namespace grid_path_planner {

// Tinted and outlined; the outline is left out where there is no room.
void drawRectangles(Canvas& canvas, const PictureLayout& layout, const GridGeometry& geometry,
                    const std::vector<CellRect>& rectangles);

// From 1, in the middle of each; left out where there is no room.
void drawNumbers(Canvas& canvas, const PictureLayout& layout, const GridGeometry& geometry,
                 const std::vector<CellRect>& rectangles);

// Lines between dots.
void drawLinks(Canvas& canvas, const PictureLayout& layout,
               const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& links);

// What a legend shows for them: 2 `size` high, 4 wide at most.
void drawRectangleSymbol(Canvas& canvas, const Eigen::Vector2d& at, double size);
void drawLinkSymbol(Canvas& canvas, const Eigen::Vector2d& at, double size);

}  // namespace grid_path_planner
