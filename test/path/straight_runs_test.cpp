#include "path/straight_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>

namespace grid_path_planner::path {
namespace {

using Polyline = std::vector<Eigen::Vector2d>;

TEST(StraightRuns, TurnsAndEndsStay) {
  const Polyline path = {{0, 0}, {1, 0}, {2, 0}, {3, 1}, {4, 2}, {4, 3}, {4, 2}, {4, 1}};
  EXPECT_EQ(withoutCollinearPoints(path, 100.0),
            (Polyline{{0, 0}, {2, 0}, {4, 2}, {4, 3}, {4, 1}}));
}

TEST(StraightRuns, NoneIsLongerThanAsked) {
  const Polyline path = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}};
  EXPECT_EQ(withoutCollinearPoints(path, 2.0), (Polyline{{0, 0}, {2, 0}, {4, 0}, {5, 0}}));
  EXPECT_EQ(withoutCollinearPoints({{0, 0}, {9, 0}, {10, 0}}, 2.0),
            (Polyline{{0, 0}, {9, 0}, {10, 0}}));
}

TEST(StraightRuns, FewPointsAndNoSteps) {
  EXPECT_EQ(withoutCollinearPoints({}, 2.0), Polyline());
  EXPECT_EQ(withoutCollinearPoints({{1, 2}}, 2.0), (Polyline{{1, 2}}));
  EXPECT_EQ(withoutCollinearPoints({{1, 2}, {1, 2}}, 2.0), (Polyline{{1, 2}, {1, 2}}));
  EXPECT_EQ(withoutCollinearPoints({{0, 0}, {1, 0}, {1, 0}, {2, 0}}, 9.0),
            (Polyline{{0, 0}, {1, 0}, {1, 0}, {2, 0}}));
}

double distanceToSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double length = along.squaredNorm();
  const double share = length > 0.0 ? std::clamp((point - a).dot(along) / length, 0.0, 1.0) : 0.0;
  return (point - a - share * along).norm();
}

// Steps between cells as planners take them, on a map that lies anywhere, at any angle.
TEST(StraightRunsLaw, EveryPointLiesOnTheSegmentThatTakesItsPlace) {
  std::mt19937 random(1471);
  std::size_t points = 0, left = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::uniform_real_distribution<double> place(-500.0, 500.0), angle(0.0, 7.0);
    const Eigen::Vector2d origin(place(random), place(random));
    const double yaw = angle(random), resolution = trial % 2 == 0 ? 0.05 : 1.0;
    const double longest = (1 + trial % 40) * resolution;
    Polyline path;
    Eigen::Vector2d cell(0.5, 0.5), step(1.0, 0.0);
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector2d at = resolution * cell;
      path.push_back(origin + Eigen::Vector2d(std::cos(yaw) * at.x() - std::sin(yaw) * at.y(),
                                              std::sin(yaw) * at.x() + std::cos(yaw) * at.y()));
      if (random() % 5 == 0) step = Eigen::Vector2d(int(random() % 3) - 1, int(random() % 3) - 1);
      cell += step;
    }
    const Polyline rest = withoutCollinearPoints(path, longest);
    points += path.size();
    left += rest.size();
    std::size_t segment = 0;
    for (const Eigen::Vector2d& point : path) {
      while (segment + 2 < rest.size() &&
             distanceToSegment(point, rest[segment], rest[segment + 1]) > 1e-9 * longest)
        ++segment;
      ASSERT_LE(distanceToSegment(point, rest[segment], rest[segment + 1]), 1e-9 * longest)
          << "trial " << trial;
    }
  }
  EXPECT_LT(2 * left, points) << "straight runs were not found";
}

}  // namespace
}  // namespace grid_path_planner::path
