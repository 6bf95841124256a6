// A straight piece of a path against rectangles, in the plane and in any one unit.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace grid_path_planner::path {

struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

// Closed and axis-parallel; `low` is nowhere above `high`.
struct Box {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
};

// The part of the segment that lies in the box; none where they do not meet.
std::optional<Segment> clipped(const Segment& segment, const Box& box);

// The least distance between the two: 0 where they meet.
double distanceBetween(const Segment& segment, const Box& box);

}  // namespace grid_path_planner::path
