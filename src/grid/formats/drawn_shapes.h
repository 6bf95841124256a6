// Obstacles of a drawing, drawn row by row: a cell is occupied where its centre lies in one or on its
// rim. What that takes follows the rows and cells that an obstacle covers, not the product of its
// corners and the cells around them.
//
//   Canvas canvas(map, resolution, file, limits);
//   canvas.drawCircle({10, 8}, 1.5);
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::grid {

// Points are in metres, from the lower left corner of the map, within 1e9 m. Drawing throws InputError
// naming the file where its time is over. All but the limits are set for as long as this lives.
class Canvas {
 public:
  Canvas(OccupancyGrid& map, double resolution, const std::string& file, base::ReadLimits& limits);

  // Even-odd. Precondition: three corners at least.
  void drawPolygon(const std::vector<Eigen::Vector2d>& corners);
  void drawCircle(const Eigen::Vector2d& centre, double radius);
  // All that is no further than `reach` from a line through `points`.
  void drawWall(const std::vector<Eigen::Vector2d>& points, double reach);

 private:
  class Box;

  Box boxAround(const std::vector<Eigen::Vector2d>& points, double reach) const;
  Eigen::Vector2d centreOf(int column, int row) const;
  template <class Holds>
  int firstColumnNot(const Box& box, int row, const Holds& holds) const;
  void addEdge(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Box& box,
               std::vector<bool>& toggles);
  void addLevelEdge(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Box& box);
  void drawSegment(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double reach);

  OccupancyGrid& map_;
  const double resolution_;
  const std::string& file_;
  base::ReadLimits& limits_;
  base::ReadPoll poll_;
};

}  // namespace grid_path_planner::grid
