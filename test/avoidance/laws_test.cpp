// What holds at every command of every flight under the rules `safe`.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "avoidance/drawn_world.h"
#include "avoidance/search/look_ahead_tree.h"
#include "avoidance/simulated_flight.h"
#include "grid_path_planner/avoidance/flight_log.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;

// Poles at random, none near the start or the goal.
std::shared_ptr<const World> grove(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<> along(3.0, 12.0), across(-6.0, 6.0), radius(0.05, 0.4);
  std::vector<simulation::TriangleMesh> meshes = drawnMeshes({}, 1.0);
  for (int i = 0; i < 18; ++i) {
    const double x = along(random), y = across(random);
    meshes.push_back(simulation::cylinderMesh("pole", radius(random), kDrawnHeight)
                         .moved(Eigen::Isometry3d(Eigen::Translation3d(x, y, 2.5))));
  }
  return worldOf(std::move(meshes));
}

FlightSetup groveSetup(int seed, Search search, double memory) {
  FlightSetup setup;
  setup.world = grove(static_cast<unsigned>(seed));
  setup.options = flyingOptions();
  setup.options.search = search;
  setup.options.memory = memory;
  setup.start = {0.0, 0.1, 1.5};
  setup.waypoints = {{15.0, 0.0, 1.5}, {0.0, 0.0, 1.5}};
  setup.seed = seed;
  setup.seconds = 30.0;
  return setup;
}

struct Case {
  Search search;
  double memory;
};
constexpr Case kCases[] = {{Search::GRID, 3600.0}, {Search::TREE, 15.0}, {Search::DIRECTION, 0.0}};

double speedOf(const base::BodyVelocity& v) {
  return std::sqrt(v.surge * v.surge + v.sway * v.sway + v.heave * v.heave);
}

TEST(Laws, EverySpeedCanBeBrakedOnTheOpenPath) {
  for (const Case& one : kCases)
    for (int seed = 1; seed <= 4; ++seed) {
      FlightSetup setup = groveSetup(seed, one.search, one.memory);
      const PilotOptions& o = setup.options;
      setup.each = [o](const PilotInput&, const PilotAnswer& answer, const auto&, const Pilot&) {
        const double speed = speedOf(answer.velocity);
        const double tau = o.frame_period + o.response_time;
        EXPECT_LE(speed * tau + speed * speed / (2.0 * o.max_acceleration),
                  answer.clear_path + 1e-9);
        EXPECT_LE(speed, o.max_speed + 1e-9);
        EXPECT_LE(std::abs(answer.velocity.heave), o.max_climb + 1e-9);
        EXPECT_LE(std::abs(answer.velocity.yaw_rate), o.max_yaw_rate + 1e-9);
        if (answer.status != PilotStatus::FLYING) {
          EXPECT_LT(speed, 0.05) << answer.sentence;
        }
      };
      const FlightResult result = fly(setup);
      EXPECT_EQ(result.contacts, 0) << "seed " << seed << " " << result.touched;
      EXPECT_GT(result.metres, 5.0) << "it flew";
    }
}

// The path that was told is the one that is flown: from elsewhere, since the vehicle moved, but to the same
// end, and none where none is flown.
TEST(Laws, EveryChangeOfThePathIsTold) {
  for (const Case& one : kCases) {
    FlightSetup setup = groveSetup(2, one.search, one.memory);
    std::vector<Vector3d> told;
    int changes = 0;
    setup.each = [&](const PilotInput&, const PilotAnswer& answer, const auto&,
                     const Pilot& pilot) {
      if (answer.new_path) told = pilot.path();
      changes += answer.new_path;
      ASSERT_EQ(told.empty(), pilot.path().empty()) << answer.sentence;
      if (!told.empty()) {
        EXPECT_EQ(told.back(), pilot.path().back()) << answer.sentence;
      }
      EXPECT_TRUE(answer.status != PilotStatus::ARRIVED || told.empty());
    };
    fly(setup);
    EXPECT_GT(changes, 3);
  }
}

// The truth: the vehicle's ball lies in what rays of its own frames passed, or about the start. A grid
// finer than the pilot's, filled by the rays that the test traces itself.
class SeenSpace {
 public:
  void see(const Frame& frame, double no_return) {
    const Vector3d origin = frame.map_from_sensor.translation();
    for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel) {
      const int column = static_cast<int>(pixel) % frame.width;
      const int row = static_cast<int>(pixel) / frame.width;
      const Pinhole& p = *frame.pinhole;
      const Vector3d ray = Vector3d((column - p.cx) / p.fx, (row - p.cy) / p.fy, 1.0).normalized();
      const float* point = &frame.points[3 * pixel];
      const double range =
          std::isfinite(point[0]) ? Vector3d(point[0], point[1], point[2]).norm() : no_return;
      const Vector3d direction = frame.map_from_sensor.linear() * ray;
      for (double metres = 0.0; metres < range; metres += 0.05) mark(origin + metres * direction);
    }
  }
  void markBall(const Vector3d& centre, double radius) {
    for (double x = -radius; x <= radius; x += 0.1)
      for (double y = -radius; y <= radius; y += 0.1)
        for (double z = -radius; z <= radius; z += 0.1)
          if (Vector3d(x, y, z).norm() <= radius) mark(centre + Vector3d(x, y, z));
  }
  bool seen(const Vector3d& at) const {
    const std::size_t index = indexOf(at);
    return index < cells_.size() && cells_[index];
  }

 private:
  static constexpr double kCell = 0.3;
  static constexpr int kX = 160, kY = 160, kZ = 40;

  static std::size_t indexOf(const Vector3d& at) {
    const int x = static_cast<int>(std::floor(at.x() / kCell)) + 60;
    const int y = static_cast<int>(std::floor(at.y() / kCell)) + kY / 2;
    const int z = static_cast<int>(std::floor(at.z() / kCell)) + 10;
    if (x < 0 || x >= kX || y < 0 || y >= kY || z < 0 || z >= kZ) return kX * kY * kZ;
    return (static_cast<std::size_t>(z) * kY + y) * kX + x;
  }
  void mark(const Vector3d& at) {
    const std::size_t index = indexOf(at);
    if (index < cells_.size()) cells_[index] = true;
  }

  std::vector<bool> cells_ = std::vector<bool>(static_cast<std::size_t>(kX) * kY * kZ, false);
};

TEST(Laws, NothingIsEnteredThatRaysHaveNotPassed) {
  for (int seed = 1; seed <= 2; ++seed) {
    FlightSetup setup = groveSetup(seed, Search::GRID, 3600.0);
    setup.seconds = 16.0;
    SeenSpace space;
    space.markBall(setup.start, setup.options.start_clear + 0.3);
    setup.each = [&](const PilotInput& input, const PilotAnswer&,
                     const simulation::VehicleState& truth, const Pilot&) {
      if (input.frame != nullptr) space.see(*input.frame, 10.0);
      for (const Vector3d& side :
           {Vector3d(0.3, 0.0, 0.0), Vector3d(-0.3, 0.0, 0.0), Vector3d(0.0, 0.3, 0.0),
            Vector3d(0.0, -0.3, 0.0), Vector3d(0.0, 0.0, 0.3), Vector3d(0.0, 0.0, -0.3)})
        EXPECT_TRUE(space.seen(truth.position + side))
            << "seed " << seed << " at " << (truth.position + side).transpose();
    };
    EXPECT_GT(fly(setup).metres, 5.0) << "it flew";
  }
}

TEST(Laws, TheSameSeedFliesTheSameBits) {
  for (const Case& one : kCases) {
    FlightSetup setup = groveSetup(3, one.search, one.memory);
    setup.seconds = 7.0;
    const FlightResult first = fly(setup), second = fly(setup);
    EXPECT_GT(first.metres, 3.0) << "it flew";
    ASSERT_EQ(first.track.size(), second.track.size());
    for (std::size_t i = 0; i < first.track.size(); ++i)
      ASSERT_EQ(std::memcmp(first.track[i].data(), second.track[i].data(), 3 * sizeof(double)), 0);
  }
}

TEST(Laws, ALogIsRepeatedToTheBit) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("flight.log");
  FlightSetup setup = groveSetup(2, Search::GRID, 15.0);
  setup.seconds = 8.0;
  std::uint64_t updates = 0;
  {
    FlightLog log(file, setup.options, std::uint64_t{1} << 30);
    log.route(setup.waypoints);
    setup.each = [&](const PilotInput& input, const PilotAnswer& answer, const auto&,
                     const Pilot&) {
      log.update(input, answer);
      ++updates;
    };
    fly(setup);
  }
  const ReplayResult result = replayFlight(file);
  EXPECT_EQ(result.updates, updates);
  EXPECT_EQ(result.differing, 0u) << result.first_difference;
}

// The reference recomputes F from the positions alone.
TEST(Laws, EveryNodeOfTheTreeHasItsCost) {
  std::mt19937 random(7);
  std::uniform_real_distribution<> place(-4.0, 4.0);
  for (const bool accumulate : {true, false})
    for (int round = 0; round < 10; ++round) {
      PilotOptions options;
      options.accumulate = accumulate;
      VoxelMemory memory;
      memory.moveTo(Vector3d::Zero());
      memory.beginFrame(0);
      for (int i = 0; i < 60; ++i) {
        const Vector3d point(place(random), place(random), place(random));
        for (int twice = 0; twice < 2; ++twice)
          if (point.norm() > 1.0) memory.hit(point);
      }
      OpenSpace space;
      space.refresh(memory, options.d_safe, {-100.0, 100.0});
      LookAheadTree tree(options);
      const Vector3d goal(9.0, place(random), 1.0);
      const Angles before{30.0, 5.0};
      tree.search(space, options, Vector3d::Zero(), goal, before, {});
      const auto degrees = [](double a, double b) {
        return std::abs(std::remainder(a - b, 360.0));
      };
      const auto anglesTo = [](const Vector3d& direction) -> Vector3d {
        return Vector3d(std::atan2(direction.y(), direction.x()),
                        std::asin(direction.z() / direction.norm()), 0.0) *
               180.0 / M_PI;
      };
      const auto cost = [&](const Vector3d& direction, const Vector3d& to_goal,
                            const Vector3d& chosen) {
        double sum = 0.0;
        for (const Vector3d& other : {to_goal, chosen})
          sum +=
              3.0 * degrees(other.x(), direction.x()) + 30.0 * std::abs(other.y() - direction.y());
        return sum;
      };
      ASSERT_GT(tree.nodes().size(), 10u);
      for (const TreeNode& node : tree.nodes()) {
        if (node.parent < 0) continue;
        double sum = 0.0;
        const TreeNode* at = &node;
        for (; accumulate && at->parent >= 0; at = &tree.nodes()[at->parent]) {
          const TreeNode& from = tree.nodes()[at->parent];
          const Vector3d chosen =
              from.parent < 0 ? Vector3d(30.0, 5.0, 0.0)
                              : anglesTo(from.position - tree.nodes()[from.parent].position);
          sum +=
              cost(anglesTo(at->position - from.position), anglesTo(goal - from.position), chosen);
        }
        if (!accumulate) sum = cost(anglesTo(node.position), anglesTo(goal), {30.0, 5.0, 0.0});
        EXPECT_NEAR(node.total, sum + 30.0 * (node.position - goal).norm(), 1e-4);
      }
    }
}

TEST(Laws, LongerMemoryFreesNothingThatShorterHolds) {
  std::mt19937 random(5);
  std::uniform_real_distribution<> place(-6.0, 6.0);
  VoxelMemory shorter, longer;
  for (int frame = 0; frame < 60; ++frame) {
    const Vector3d hit(place(random), place(random), 1.0);
    const Vector3d passed(place(random), place(random), 1.0);
    for (VoxelMemory* memory : {&shorter, &longer}) {
      memory->moveTo(Vector3d(0.05 * frame, 0.0, 1.0));
      memory->beginFrame(100 * frame);
      memory->hit(hit);
      memory->hit(hit);
      if (memory->window().contains(voxelAt(passed))) memory->cross(slotOf(voxelAt(passed)));
    }
    shorter.forget(100 * frame - 500);
    longer.forget(100 * frame - 2000);
    for (int slot = 0; slot < kSlots; ++slot) {
      ASSERT_TRUE(longer.occupied(slot) || !shorter.occupied(slot));
      ASSERT_TRUE(longer.seen(slot) || !shorter.seen(slot));
    }
  }
}

TEST(Memory, OnePointIsNoiseTwoAreAThing) {
  VoxelMemory memory;
  memory.moveTo(Vector3d::Zero());
  const Vector3d point(1.1, 0.1, 0.1);
  const int slot = slotOf(voxelAt(point));
  memory.beginFrame(0);
  memory.hit(point);
  EXPECT_FALSE(memory.occupied(slot));
  memory.beginFrame(600);  // too late
  memory.hit(point);
  EXPECT_FALSE(memory.occupied(slot));
  memory.beginFrame(1000);
  memory.hit(point);
  EXPECT_TRUE(memory.occupied(slot));
  EXPECT_LT((memory.point(voxelAt(point)) - point).norm(), 1e-4);
}

TEST(Memory, RaysOfThreeFramesClearButAHitBeatsThem) {
  VoxelMemory memory;
  memory.moveTo(Vector3d::Zero());
  const Vector3d point(1.1, 0.1, 0.1);
  const int slot = slotOf(voxelAt(point));
  memory.beginFrame(0);
  memory.hit(point);
  memory.hit(point);
  memory.cross(slot);
  for (int frame = 1; frame <= 2; ++frame) {
    memory.beginFrame(100 * frame);
    memory.cross(slot);
    memory.cross(slot);  // many rays of a frame count once
    EXPECT_TRUE(memory.occupied(slot));
  }
  memory.beginFrame(300);
  memory.hit(point);
  memory.cross(slot);
  for (int frame = 4; frame <= 6; ++frame) {
    EXPECT_TRUE(memory.occupied(slot));
    memory.beginFrame(100 * frame);
    memory.cross(slot);
  }
  EXPECT_FALSE(memory.occupied(slot));
  EXPECT_TRUE(memory.seen(slot));
}

}  // namespace
}  // namespace grid_path_planner::avoidance
