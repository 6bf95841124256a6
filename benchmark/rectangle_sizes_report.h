// The drawings of the rectangle map's tables, and the tables of counts and bytes, for
// rectangle_tables.cpp.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/planners/decomposition.h"
#include "grid_path_planner/planners/map_sizes.h"
#include "grid_path_planner/planners/rectangle_graph.h"

namespace grid_path_planner::benchmark {

using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::CostmapBuilder;
using costmap::CostmapOptions;
using costmap::Outside;
using grid::MapFileOptions;
using grid::OccupancyGrid;
using grid::readMapFile;
using planners::largestFirst;
using planners::MapSizes;
using planners::mapSizes;
using planners::RectangleGraph;
using planners::Touching;

struct Drawing {
  const char* name;
  double side;            // m
  double from_x, from_y;  // m; the path across the map
  double to_x, to_y;
};

constexpr Drawing kIndoor{"indoor", 40, 6, 37, 30, 4.5};
constexpr Drawing kCampus{"campus", 160, 4, 4, 156, 156};
constexpr Drawing kComplex{"complex", 64, 2, 2, 62, 62};
constexpr Drawing kSimple{"simple", 64, 2, 2, 62, 62};

inline OccupancyGrid render(const std::string& folder, const Drawing& drawing, int cells) {
  MapFileOptions options;
  options.resolution = drawing.side / cells;
  return readMapFile(folder + "/" + drawing.name + ".yaml", options);
}

inline std::shared_ptr<const CostGrid> costmapOf(const OccupancyGrid& map,
                                                 Connectivity connectivity = Connectivity::EIGHT) {
  CostmapOptions options;
  options.motion.connectivity = connectivity;
  options.outside = Outside::FREE;
  CostmapBuilder builder(options);
  builder.setMap(std::make_shared<const OccupancyGrid>(map));
  return builder.downsampled(StopToken());
}

inline RectangleGraph rectanglesOf(const OccupancyGrid& map) {
  const auto costmap = costmapOf(map);
  return RectangleGraph(map.geometry(),
                        largestFirst(costmap->bitMaps(StopToken()), {}, StopToken()),
                        Touching::BORDERS);
}

struct Resolution {
  int cells;
  int published_cells;       // 0: not published
  int published_rectangles;  // 0: not published
};

inline void printCounts(const std::string& folder, const Drawing& drawing,
                        const std::vector<Resolution>& resolutions) {
  std::printf(
      "| cells a side | free cells | growth | rectangles | growth | published: free cells | growth "
      "| rectangles | growth |\n|---|---|---|---|---|---|---|---|---|\n");
  std::vector<double> before(4, 0.0);
  for (const Resolution& resolution : resolutions) {
    const RectangleGraph map = rectanglesOf(render(folder, drawing, resolution.cells));
    const std::vector<double> now = {double(map.freeCells()), double(map.rectangles().size()),
                                     double(resolution.published_cells),
                                     double(resolution.published_rectangles)};
    std::printf("| %d |", resolution.cells);
    for (std::size_t i = 0; i < now.size(); ++i) {
      std::printf(" %.0f |", now[i]);
      if (before[i] > 0.0)
        std::printf(" ×%.2f |", now[i] / before[i]);
      else
        std::printf(" |");
    }
    std::printf("\n");
    before = now;
  }
  std::printf("\n");
}

// Table 2.3 of Park 2013: four numbers of 16 bits a rectangle.
struct PublishedBytes {
  int cells;  // a side
  int entire_map;
  int empty_cells;
  int rectangles;
};

constexpr std::size_t kBytesOfPublishedRectangle = 8;
constexpr PublishedBytes kPublishedBytes[] = {{10, 13, 154, 80},
                                              {50, 313, 3838, 764},
                                              {250, 7813, 94776, 3128},
                                              {1250, 195313, 2365330, 32936}};

inline void printBytes(const std::string& folder, const Drawing& drawing) {
  std::printf(
      "| cells a side | free cells | rectangles | entire map in bits | empty cells | rectangles, 8 "
      "bytes each | rectangles, listed | rectangles, our file | PNG | bits in zlib | published: "
      "entire map | empty cells | rectangles "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const PublishedBytes& published : kPublishedBytes) {
    const RectangleGraph map = rectanglesOf(render(folder, drawing, published.cells));
    const MapSizes sizes = mapSizes(map);
    std::printf("| %d | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %d | %d | %d |\n",
                published.cells, map.freeCells(), map.rectangles().size(), sizes.entire_map,
                sizes.empty_cells, kBytesOfPublishedRectangle * map.rectangles().size(),
                sizes.rectangles, sizes.file, sizes.png, sizes.zlib, published.entire_map,
                published.empty_cells, published.rectangles);
  }
  std::printf("\n");
}

}  // namespace grid_path_planner::benchmark
