// A frame that is shifted or mirrored gives the path that is shifted or mirrored.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "grid_path_planner/avoidance/pilot.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kColumns = 80, kRows = 60;
constexpr double kFocal = 60.0;

// Poles at random before a far wall, as a level camera at the origin that looks along x sees them.
Frame frameOfPoles(std::mt19937& random) {
  std::uniform_real_distribution<> ahead(2.5, 7.0), aside(-3.0, 3.0);
  std::vector<Eigen::Vector2d> poles;
  for (int i = 0; i < 6; ++i) poles.emplace_back(ahead(random), aside(random));
  Frame frame;
  frame.width = kColumns;
  frame.height = kRows;
  frame.pinhole = Pinhole{kFocal, kFocal, 0.5 * (kColumns - 1), 0.5 * (kRows - 1)};
  frame.map_from_sensor.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const double right = (column - frame.pinhole->cx) / kFocal;
      double depth = 9.0;
      for (const Eigen::Vector2d& pole : poles)
        if (std::abs(-right * pole.x() - pole.y()) < 0.15) depth = std::min(depth, pole.x());
      for (const double value : {right * depth, (row - frame.pinhole->cy) / kFocal * depth, depth})
        frame.points.push_back(static_cast<float>(value));
    }
  return frame;
}

Frame shiftedBy(Frame frame, const Vector3d& shift) {
  frame.map_from_sensor.pretranslate(shift);
  return frame;
}

// Left is right: the columns in the other order, y negated.
Frame mirrored(const Frame& frame) {
  Frame other = frame;
  for (int row = 0; row < frame.height; ++row)
    for (int column = 0; column < frame.width; ++column) {
      const auto from = static_cast<std::size_t>(3 * (row * frame.width + column));
      const auto to = static_cast<std::size_t>(3 * (row * frame.width + frame.width - 1 - column));
      other.points[to] = -frame.points[from];
      other.points[to + 1] = frame.points[from + 1];
      other.points[to + 2] = frame.points[from + 2];
    }
  return other;
}

// The pilot after it saw the frame twice from `start`, flying to `goal`.
std::unique_ptr<Pilot> pilotThatSaw(Frame frame, Search search, const Vector3d& start,
                                    const Vector3d& goal) {
  PilotOptions options;
  options.search = search;
  options.elevation = search == Search::GRID;
  options.smooth_weight = 0.7;  // equal weights cost the same in all directions between two
  auto pilot = std::make_unique<Pilot>(options);
  pilot->setRoute({goal});
  for (int i = 0; i < 3; ++i) {
    frame.time = 0.1 * i;
    PilotInput input;
    input.time = frame.time;
    input.pose = VehiclePose{start, 0.0};
    input.frame = &frame;
    pilot->update(input);
  }
  return pilot;
}

double lengthOfPath(const std::vector<Vector3d>& path) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) length += (path[i + 1] - path[i]).norm();
  return length;
}

// By whole turns of the ring of voxels, so that ties are broken alike; what lies on the border of two voxels or
// bins is rounded otherwise elsewhere, which may change a path in ten.
TEST(Symmetry, AShiftedFrameGivesTheShiftedPath) {
  std::mt19937 random(5);
  const Vector3d shift(25.6, -51.2, 12.8), start(0.03, 0.04, 0.05), goal(8.03, 0.41, 0.05);
  int paths = 0, same = 0;
  for (int round = 0; round < 10; ++round)
    for (const Search search : {Search::GRID, Search::TREE}) {
      const Frame frame = shiftedBy(frameOfPoles(random), start);
      const auto here = pilotThatSaw(frame, search, start, goal);
      const auto there = pilotThatSaw(shiftedBy(frame, shift), search, start + shift, goal + shift);
      same += here->path().size() == there->path().size() &&
              std::equal(here->path().begin(), here->path().end(), there->path().begin(),
                         [&](const Vector3d& a, const Vector3d& b) {
                           return (a + shift - b).norm() < 1e-4;
                         });
      EXPECT_EQ(here->path().empty(), there->path().empty()) << "round " << round;
      paths += here->path().empty() ? 0 : 1;
    }
  EXPECT_GT(paths, 10);
  EXPECT_GE(same, 18) << "of 20";
}

// The tree's costs have no ties here; the grid's paths of equal cost are many, so their lengths are compared.
TEST(Symmetry, AMirroredFrameGivesTheMirroredPath) {
  std::mt19937 random(6);
  const Vector3d start(0.03, 0.0, 0.05), goal(8.03, 0.41, 0.05);
  const auto mirror = [](const Vector3d& p) { return Vector3d(p.x(), -p.y(), p.z()); };
  int paths = 0;
  for (int round = 0; round < 10; ++round)
    for (const Search search : {Search::GRID, Search::TREE}) {
      const Frame frame = shiftedBy(frameOfPoles(random), start);
      const auto one = pilotThatSaw(frame, search, start, goal);
      const auto other = pilotThatSaw(mirrored(frame), search, start, mirror(goal));
      ASSERT_EQ(one->path().empty(), other->path().empty()) << "round " << round;
      EXPECT_NEAR(lengthOfPath(one->path()), lengthOfPath(other->path()),
                  0.03 * lengthOfPath(one->path()))
          << "round " << round;
      if (search == Search::GRID || one->path().empty()) continue;
      ++paths;
      ASSERT_EQ(one->path().size(), other->path().size()) << "round " << round;
      for (std::size_t i = 0; i < one->path().size(); ++i)
        EXPECT_LT((mirror(one->path()[i]) - other->path()[i]).norm(), 1e-3) << "round " << round;
    }
  EXPECT_GT(paths, 3);
}

}  // namespace
}  // namespace grid_path_planner::avoidance
