#include "support/random_footprints.h"

namespace grid_path_planner::test {

using grid::Cell, grid::GridGeometry, grid::OccupancyGrid;

OccupancyGrid randomRooms(std::mt19937& random, double yaw) {
  constexpr int kSide = 60, kRoom = 20;
  OccupancyGrid map(GridGeometry(kSide, kSide, 0.1, {-1.3, 0.7, yaw}));
  for (int wall = kRoom; wall < kSide; wall += kRoom) {
    for (int i = 0; i < kSide; ++i) map[Cell{wall, i}] = map[Cell{i, wall}] = 100;
    for (int room = 0; room < kSide; room += kRoom) {
      const int width = 4 + random() % 6;
      const int first = room + 2 + random() % (kRoom - width - 3);
      for (int i = first; i < first + width; ++i) {
        map[Cell{wall, i}] = 0;
        if (random() % 5 != 0) map[Cell{i, wall}] = 0;
      }
    }
  }
  for (unsigned clutter = random() % 30; clutter > 0; --clutter)
    map[Cell{static_cast<int>(random() % kSide), static_cast<int>(random() % kSide)}] = 100;
  return map;
}

std::vector<Eigen::Vector2d> randomVehicle(std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const double front = 0.1 + 0.5 * part(random), rear = 0.1 + 0.3 * part(random);
  const double left = 0.1 + 0.1 * part(random), right = 0.1 + 0.1 * part(random);
  std::vector<Eigen::Vector2d> corners = {
      {front, left}, {-rear, left}, {-rear, -right}, {front, -right}};
  if (random() % 2 == 0) corners.insert(corners.begin() + 1, {0.02, left * 0.6});  // a notch
  return corners;
}

}  // namespace grid_path_planner::test
