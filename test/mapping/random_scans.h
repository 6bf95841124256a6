// Scans and trees for laws: everything a sensor or a broken driver may send.
#pragma once

#include <octomap/OcTree.h>

#include <cmath>
#include <limits>
#include <random>

#include "grid_path_planner/mapping/octree_options.h"
#include "grid_path_planner/mapping/scan.h"

namespace grid_path_planner::test {

inline octomap::point3d randomPoint(std::mt19937& random, float extent) {
  std::uniform_real_distribution<float> along(-extent, extent);
  const float x = along(random), y = along(random);
  return {x, y, along(random)};
}

// Hits around the origin, many of them in few voxels, on the axes and the corners of voxels, at the
// origin itself, some absurd.
inline mapping::Scan randomScan(std::mt19937& random, const mapping::OctreeOptions& options) {
  const float step = static_cast<float>(options.resolution);
  const float kNan = std::numeric_limits<float>::quiet_NaN();
  const float kInfinity = std::numeric_limits<float>::infinity();
  mapping::Scan scan;
  scan.origin = random() % 4 == 0 ? octomap::point3d(0, 0, 0) : randomPoint(random, 20 * step);
  const auto add = [&](const octomap::point3d& point) {
    (random() % 5 == 0 ? scan.clear_only : scan.hits).push_back(point);
  };
  const int points = 1 + static_cast<int>(random() % 200);
  const float extent = step * static_cast<float>(1 << random() % 7);
  for (int i = 0; i < points; ++i) {
    octomap::point3d offset = randomPoint(random, extent);
    if (random() % 6 == 0) offset(random() % 3) = 0.0f;
    if (random() % 6 == 0)
      for (unsigned axis = 0; axis < 3; ++axis)
        offset(axis) = step * std::floor(offset(axis) / step);
    add(scan.origin + offset);
    if (random() % 5 == 0) add(scan.origin + offset);
  }
  if (random() % 4 == 0) add(scan.origin);
  if (random() % 4 == 0) add({kNan, 0, 0});
  if (random() % 4 == 0) add({0, kInfinity, 0});
  if (random() % 4 == 0) add({0, 0, -1e30f});
  if (random() % 4 == 0) add({40000 * step, step, step});
  return scan;
}

// A picture of what lies around: many rays close together, so that they fill the box around them.
inline mapping::Scan denseScan(std::mt19937& random, const mapping::OctreeOptions& options) {
  const float step = static_cast<float>(options.resolution);
  mapping::Scan scan;
  scan.origin = randomPoint(random, 20 * step);
  const octomap::point3d ahead = randomPoint(random, 30 * step);
  for (int row = 0; row < 25; ++row)
    for (int column = 0; column < 40; ++column) {
      const octomap::point3d aside(step * column, step * row, 0.1f * step * column);
      const float range = 0.5f + 0.001f * static_cast<float>(random() % 1000);
      const octomap::point3d point = scan.origin + (ahead + aside) * range;
      (random() % 8 == 0 ? scan.clear_only : scan.hits).push_back(point);
    }
  return scan;
}

inline mapping::OctreeOptions randomOptions(std::mt19937& random) {
  mapping::OctreeOptions options;
  const double resolutions[] = {0.05, 0.1, 0.07, 0.25, 1.0};
  options.resolution = resolutions[random() % 5];
  if (random() % 2) options.max_range = options.resolution * (1 + random() % 40);
  if (random() % 2) options.hit = 0.95;
  if (random() % 2) options.miss = 0.2;
  return options;
}

}  // namespace grid_path_planner::test
