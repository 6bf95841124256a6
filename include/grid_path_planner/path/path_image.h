// A picture of a map with a path on it, for people.
//
//   writePicture("out/path.png", map, thresholds, {path, expanded});
//
// Free cells are light, unknown ones grey, occupied ones dark; expanded cells are tinted, from pale
// (early) to strong (late); the path is a blue line, its start a green disc and its goal an orange
// arrowhead in the goal's heading. Rectangles are tinted in turning colours, outlined
// and numbered from 1 where they are large enough for that; links are lines between dots, outlines
// thin lines below the path. A margin
// holds a scale bar in metres and a legend of what is drawn. The colours differ in lightness and
// are chosen to be told apart by colour-blind eyes. +x is to the right and +y up, in the map's own
// axes: the picture of a turned map is not turned. The same input gives the same file, byte for
// byte.
//
// Where several cells share a pixel, occupied wins over unknown and unknown over free.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::path {

struct PictureOptions {
  int smallest_side =
      800;  // pixels of the map, margin excluded: small maps are enlarged by a whole
            // factor until no side is below, or the other side would be too large
  int largest_side = 4096;  // pixels of the map: large maps are reduced by a whole factor
};

// Where the map lies in its picture.
class PictureLayout {
 public:
  // Throws InputError for a map without cells and for sides that are not 1 <= smallest <= largest
  // <= 16384.
  PictureLayout(const grid::GridGeometry& geometry, const PictureOptions& options = {});

  int width() const { return width_; }        // pixels, margin included
  int height() const { return height_; }      // pixels, margin included
  int enlarged() const { return enlarged_; }  // pixels a cell; 1 where the map is reduced
  int reduced() const { return reduced_; }    // cells a pixel; 1 where the map is enlarged
  // The map's own pixels: left, top, width and height.
  grid::CellRect mapArea() const { return map_area_; }
  int margin() const { return map_area_.row; }

  // Pixel of a world point: (0, 0) is the outer corner of the picture's upper left pixel.
  Eigen::Vector2d pixelAt(const Eigen::Vector2d& metres) const;

 private:
  grid::GridGeometry geometry_;
  int enlarged_ = 1;
  int reduced_ = 1;
  grid::CellRect map_area_;
  int width_ = 0;
  int height_ = 0;
};

// Red, green, blue, row by row from the top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

// What is drawn on the map.
struct PictureContent {
  Path path;
  std::vector<grid::Cell> expanded;
  std::vector<grid::CellRect> rectangles;
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> links;  // metres
  std::vector<std::vector<Eigen::Vector2d>> outlines = {};  // of the vehicle: corners, metres
};

// Throws InputError for a path with a position that is not finite. The part of a path that lies
// outside the picture is left out, expanded cells and rectangles
// outside the map are passed over.
Picture drawPicture(const grid::OccupancyGrid& map, const grid::OccupancyThresholds& thresholds,
                    const PictureContent& content, const PictureOptions& options = {});

// Draws and writes a PNG, or by the file's extension any other format that OpenCV writes. The old
// file stays whole where the new one cannot be written. Throws InputError naming the file.
void writePicture(const std::string& file, const grid::OccupancyGrid& map,
                  const grid::OccupancyThresholds& thresholds, const PictureContent& content,
                  const PictureOptions& options = {});

}  // namespace grid_path_planner::path
