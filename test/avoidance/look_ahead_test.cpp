// The look-ahead tree and the single direction, as the configurations of the published study fly them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "avoidance/drawn_world.h"
#include "avoidance/search/look_ahead_tree.h"
#include "avoidance/simulated_flight.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;

// A memory of points, each of which was seen twice.
class Thicket {
 public:
  Thicket() {
    memory_.moveTo(Vector3d::Zero());
    memory_.beginFrame(0);
  }
  void add(const Vector3d& point) {
    memory_.hit(point);
    memory_.hit(point);
    points_.push_back(point);
  }
  const std::vector<Vector3d>& points() const { return points_; }
  OpenSpace space(const PilotOptions& options) const {
    OpenSpace space;
    space.refresh(memory_, options.d_safe, {-100.0, 100.0});
    return space;
  }

 private:
  VoxelMemory memory_;
  std::vector<Vector3d> points_;
};

double nearestTo(const Vector3d& place, const std::vector<Vector3d>& points) {
  double least = 1e9;
  for (const Vector3d& point : points) least = std::min(least, (place - point).norm());
  return least;
}

Thicket randomThicket(unsigned seed, double free_radius) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<> place(-6.0, 6.0);
  Thicket thicket;
  for (int i = 0; i < 150; ++i) {
    // One point at most in a voxel, in its middle, so that the memory's mean is that point.
    const Vector3d point = centreOf(voxelAt({place(random), place(random), 0.3 * place(random)}));
    if (point.norm() > free_radius) thicket.add(point);
  }
  return thicket;
}

// A search that came to the same place over and over used up its nodes in a dead end.
TEST(LookAhead, ExpandsNoPlaceTwice) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const PilotOptions options;
    const Thicket thicket = randomThicket(seed, 1.0);
    LookAheadTree tree(options);
    tree.search(thicket.space(options), options, Vector3d::Zero(), {9.0, 1.0, 0.0}, {}, {});
    const std::vector<Vector3d>& expanded = tree.expanded();
    ASSERT_GT(expanded.size(), 2u);
    for (std::size_t i = 0; i < expanded.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE((expanded[i] - expanded[j]).norm(), options.spacing) << "seed " << seed;
  }
}

// The law that the vehicle flies by asks for d_safe of what odometry's noise moves about: a path without a
// margin was left standing 0.1 m before its first corner.
TEST(LookAhead, SafeStepsKeepMoreThanTheLawAsksFor) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    PilotOptions options;
    options.rules = Rules::SAFE;
    const Thicket thicket = randomThicket(seed, 0.8);
    LookAheadTree tree(options);
    tree.search(thicket.space(options), options, Vector3d::Zero(), {9.0, 1.0, 0.0}, {}, {});
    ASSERT_GT(tree.nodes().size(), 4u);
    for (const TreeNode& node : tree.nodes()) {
      if (node.parent < 0) continue;
      const Vector3d from = tree.nodes()[node.parent].position;
      for (const double share : {0.25, 0.5, 0.75, 1.0})
        EXPECT_GE(nearestTo(from + share * (node.position - from), thicket.points()),
                  options.d_safe + 0.04)
            << "seed " << seed;
    }
  }
}

TEST(LookAhead, AStepFromATightPlaceLeavesIt) {
  PilotOptions options;
  options.rules = Rules::SAFE;
  Thicket thicket;
  thicket.add(centreOf(voxelAt({0.1, 0.45, 0.05})));
  const double tight = thicket.points()[0].norm();
  ASSERT_LT(tight, options.d_safe);
  LookAheadTree tree(options);
  tree.search(thicket.space(options), options, Vector3d::Zero(), {9.0, 0.0, 0.0}, {}, {});
  int steps = 0;
  for (const TreeNode& node : tree.nodes()) {
    if (node.parent != 0) continue;
    ++steps;
    EXPECT_GT(nearestTo(0.2 * node.position, thicket.points()), tight + 0.02);
    EXPECT_GE(nearestTo(node.position, thicket.points()), options.d_safe + 0.04);
  }
  EXPECT_GT(steps, 2);
}

double distanceToSegment(const Vector3d& place, const Vector3d& from, const Vector3d& to) {
  double least = 1e9;
  for (int i = 0; i <= 1000; ++i)
    least = std::min(least, (from + i / 1000.0 * (to - from) - place).norm());
  return least;
}

// A place that was given up closed only the steps that ended at it: the vehicle stood before one 0.3 m ahead,
// and every path led through it again.
TEST(LookAhead, StepsKeepFromClosedPlacesOrLeaveThem) {
  std::mt19937 random(11);
  std::uniform_real_distribution<> coordinate(-3.0, 3.0);
  for (int i = 0; i < 10; ++i) {
    const PilotOptions options;
    std::vector<Vector3d> closed = {{0.3, 0.0, 0.0}};
    for (int k = 0; k < 5; ++k) closed.emplace_back(coordinate(random), coordinate(random), 0.0);
    LookAheadTree tree(options);
    tree.search(Thicket().space(options), options, Vector3d::Zero(), {9.0, 0.0, 0.0}, {}, closed);
    ASSERT_GT(tree.nodes().size(), 4u);
    for (const TreeNode& node : tree.nodes()) {
      if (node.parent < 0) continue;
      const Vector3d from = tree.nodes()[node.parent].position;
      for (const Vector3d& place : closed)
        EXPECT_GE(distanceToSegment(place, from, node.position),
                  std::min(0.5, (from - place).norm()) - 1e-5);
    }
  }
}

// A single direction is a metre long. What was looked at, and braked for, beyond it lay towards the waypoint
// after the present one: the vehicle flew north looking east, and stood where nothing was seen there.
TEST(LookAhead, ASingleDirectionIsLookedAlong) {
  FlightSetup setup;
  setup.world = worldOf(drawnMeshes({}, 1.0));
  setup.options = flyingOptions();
  setup.options.search = Search::DIRECTION;
  setup.options.memory = 15.0;
  setup.options.recover = false;
  setup.start = {0.0, 0.0, 1.5};
  setup.waypoints = {{12.0, 0.0, 1.5}, {12.0, 12.0, 1.5}};
  double aside = 0.0;  // rad, of the first leg
  setup.each = [&](const PilotInput& input, const PilotAnswer& answer, const auto&, const Pilot&) {
    if (answer.waypoint == 0) aside = std::max(aside, std::abs(input.pose->yaw));
  };
  const FlightResult result = fly(setup);
  EXPECT_EQ(result.status, PilotStatus::ARRIVED) << result.sentence;
  EXPECT_EQ(result.contacts, 0);
  EXPECT_LT(aside, 0.25);
  EXPECT_LT(result.metres, 1.1 * 24.0);
}

// From the root at least the least F of what stayed open; nowhere less than the straight line; until forgotten.
TEST(LookAhead, ASearchThatUsedUpItsNodesLearns) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    PilotOptions options;
    options.search = Search::TREE;
    options.nodes = 12;
    const Thicket thicket = randomThicket(seed, 1.0);
    const OpenSpace space = thicket.space(options);
    const Vector3d goal(9.0, 1.0, 0.0);
    LookAheadTree tree(options);
    tree.search(space, options, Vector3d::Zero(), goal, {}, {});
    double least = 1e9;  // F of what is open
    for (const TreeNode& node : tree.nodes())
      if (node.parent >= 0 && nearestTo(node.position, tree.expanded()) >= options.spacing)
        least = std::min(least, node.total);
    ASSERT_LT(least, 1e9) << "seed " << seed;
    EXPECT_GE(tree.estimate(options, Vector3d::Zero(), goal), least - 1e-9) << "seed " << seed;
    for (const Vector3d& place : tree.expanded())
      EXPECT_GE(tree.estimate(options, place, goal), 30.0 * (place - goal).norm() - 1e-9);
    tree.learned().forget();
    EXPECT_EQ(tree.estimate(options, Vector3d::Zero(), goal), 30.0 * goal.norm());
  }
}

// The goal lies behind a wall with a path around either end, where the nodes do not suffice to come round: the
// vehicle flew 100 m to and fro.
TEST(LookAhead, ALongWallIsFlownAround) {
  std::vector<simulation::TriangleMesh> meshes = drawnMeshes({}, 1.0);
  meshes.push_back(boxAt("wall", {8.0, -8.0, 0.0}, {8.3, 8.0, kDrawnHeight}));
  FlightSetup setup;
  setup.world = worldOf(std::move(meshes));
  setup.options = flyingOptions();
  setup.options.search = Search::TREE;
  setup.options.memory = 15.0;
  setup.options.recover = false;
  setup.waypoints = {{14.0, 0.0, 1.5}};
  setup.seconds = 60.0;
  for (const int seed : {1, 2}) {
    setup.seed = seed;
    const FlightResult result = fly(setup);
    EXPECT_EQ(result.status, PilotStatus::ARRIVED) << result.sentence;
    EXPECT_EQ(result.contacts, 0);
    EXPECT_LT(result.metres, 50.0);
  }
}

}  // namespace
}  // namespace grid_path_planner::avoidance
