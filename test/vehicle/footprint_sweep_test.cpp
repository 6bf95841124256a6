// Where a footprint meets cells while it drives and turns: pictures, and random motions against Boost.Geometry's areas of
// polygons at many places along them.
#include "vehicle/sweep.h"

#include <gtest/gtest.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>
#include <random>

#include "support/ascii_map.h"

namespace grid_path_planner::vehicle {

using base::StopToken;
using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;
using test::AsciiMap;

namespace {

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point>;
using Eigen::Vector2d;

FootprintSweep sweepOf(const Footprint& footprint, const OccupancyGrid& map, bool outside = false) {
  FootprintObstacles obstacles;
  obstacles.outside = outside;
  obstacles.first = [&map](const grid::RowSpan& span) {
    int column = span.first;
    while (column < span.end && map[Cell{column, span.row}] < 65) ++column;
    return column;
  };
  return FootprintSweep(footprint, map.geometry(), obstacles);
}

// 3 m long, 1 m wide, about its middle.
Footprint longVehicle() {
  return Footprint::fromText("footprint", "[[1.5, 0.5], [1.5, -0.5], [-1.5, -0.5], [-1.5, 0.5]]");
}

Motion turnAt(double x, double y, double from, double turn) {
  return {{x, y}, {x, y}, from, turn, 0};
}

// Along the corridor it fits to the millimetre; across it does not, and turning it meets the walls.
TEST(FootprintSweep, aLongVehicleInACorridor) {
  const AsciiMap picture({"#######",  //
                          ".......",  //
                          "#######"});
  const Footprint vehicle = longVehicle();
  const FootprintSweep sweep = sweepOf(vehicle, picture.map);
  EXPECT_FALSE(sweep.first({{1.5, 1.5}, {5.5, 1.5}, 0.0, 0.0, 0}, StopToken()));
  EXPECT_FALSE(sweep.first({{1.5, 1.5}, {5.5, 1.5}, M_PI, 0.0, 0}, StopToken()));
  EXPECT_TRUE(sweep.standing({3.5, 1.5}, M_PI / 2));
  const auto contact = sweep.first(turnAt(3.5, 1.5, 0.0, M_PI), StopToken());
  ASSERT_TRUE(contact);
  EXPECT_TRUE(contact->on_the_spot);
  EXPECT_LT(contact->yaw, 0.3);
}

// Free at both headings, not between: only what is swept tells.
TEST(FootprintSweep, aPillarBetweenTwoHeadings) {
  const AsciiMap picture({".....",  //
                          ".....",  //
                          ".....",  //
                          ".#...",  //
                          "....."});
  const Footprint vehicle =
      Footprint::fromText("footprint", "[[0.4, 0.4], [0.4, -0.4], [-2, -0.4], [-2, 0.4]]");
  const FootprintSweep sweep = sweepOf(vehicle, picture.map);
  EXPECT_FALSE(sweep.standing({2.5, 2.5}, 0.0));
  EXPECT_FALSE(sweep.standing({2.5, 2.5}, -M_PI / 2));
  EXPECT_TRUE(sweep.first(turnAt(2.5, 2.5, 0.0, -M_PI / 2), StopToken()));
  EXPECT_FALSE(sweep.first(turnAt(2.5, 2.5, 0.0, M_PI), StopToken()));
}

// A thin pillar that fits between two places of the footprint on a long straight line.
TEST(FootprintSweep, aPillarBesideALongLine) {
  OccupancyGrid map(GridGeometry(1000, 20, 0.1));
  map[Cell{500, 12}] = 100;
  const Footprint vehicle =
      Footprint::fromText("footprint", "[[0.3, 0.25], [0.3, -0.25], [-0.3, -0.25], [-0.3, 0.25]]");
  const FootprintSweep sweep = sweepOf(vehicle, map);
  const auto contact = sweep.first({{1.0, 1.0}, {99.0, 1.0}, 0.0, 0.0, 0}, StopToken());
  ASSERT_TRUE(contact);
  EXPECT_EQ((Cell{500, 12}), contact->cell);
  EXPECT_NEAR(50.0, contact->position.x(), 1.0);
  EXPECT_FALSE(sweep.first({{1.0, 0.95}, {99.0, 0.95}, 0.0, 0.0, 0}, StopToken())) << "grazes it";
}

TEST(FootprintSweep, outsideCountsWhereItIsAsked) {
  const OccupancyGrid map(GridGeometry(5, 5, 1.0));
  const Footprint vehicle = longVehicle();
  EXPECT_FALSE(sweepOf(vehicle, map).standing({0.5, 2.5}, 0.0));
  const auto cell = sweepOf(vehicle, map, true).standing({0.5, 2.5}, 0.0);
  ASSERT_TRUE(cell);
  EXPECT_EQ(-1, cell->column);
  EXPECT_TRUE(sweepOf(vehicle, map, true).standing({2.5, 4.5}, M_PI / 2));
  EXPECT_FALSE(sweepOf(vehicle, map, true).standing({1.5, 2.5}, 0.0));
}

TEST(FootprintSweep, hugeOnASmallMapIsQuick) {
  OccupancyGrid map(GridGeometry(50, 50, 0.001));
  const Footprint vehicle =
      Footprint::fromText("footprint", "[[1000, 900], [-1000, 900], [-1000, -900], [1000, -900]]");
  EXPECT_FALSE(sweepOf(vehicle, map).standing({0.02, 0.02}, 0.3));
  map[Cell{3, 4}] = 100;
  EXPECT_TRUE(sweepOf(vehicle, map).standing({0.02, 0.02}, 0.3));
  EXPECT_TRUE(sweepOf(vehicle, map).first(turnAt(0.02, 0.02, 0.0, 1.0), StopToken()));
}

Polygon placedPolygon(const Footprint& footprint, double grown, const Vector2d& at, double yaw) {
  Polygon polygon;
  for (const Vector2d& corner : footprint.corners()) {
    const Vector2d p = corner * grown;
    bg::append(polygon.outer(), Point(at.x() + std::cos(yaw) * p.x() - std::sin(yaw) * p.y(),
                                      at.y() + std::sin(yaw) * p.x() + std::cos(yaw) * p.y()));
  }
  bg::append(polygon.outer(), polygon.outer().front());
  bg::correct(polygon);
  return polygon;
}

// Areas that the footprint shares with occupied cells at `samples` places of the motion, the largest; and how near it
// comes.
struct Reference {
  double area = 0.0;
  double distance = 1e9;
};

Reference referenceOf(const Footprint& footprint, const OccupancyGrid& map, const Motion& motion,
                      int samples) {
  Reference reference;
  for (int i = 0; i <= samples; ++i) {
    const double share = static_cast<double>(i) / samples;
    const Polygon polygon =
        placedPolygon(footprint, 1.0,
                      map.geometry().gridFromWorld(motion.from + share * (motion.to - motion.from)),
                      motion.yaw + share * motion.turn - map.geometry().origin().yaw);
    for (int row = 0; row < map.height(); ++row)
      for (int column = 0; column < map.width(); ++column) {
        if (map[Cell{column, row}] < 65) continue;
        const bg::model::box<Point> cell(Point(column, row), Point(column + 1, row + 1));
        std::vector<Polygon> shared;
        bg::intersection(polygon, cell, shared);
        for (const Polygon& part : shared)
          reference.area = std::max(reference.area, bg::area(part));
        reference.distance = std::min(reference.distance, bg::distance(polygon, cell));
      }
  }
  return reference;
}

Footprint randomFootprint(std::mt19937& random) {
  std::uniform_real_distribution<double> radius(0.3, 3.0);
  const int corners = 3 + static_cast<int>(random() % 5);
  for (;;) {
    std::vector<Vector2d> polygon;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * M_PI * (i + 0.1 * (random() % 10)) / corners;
      polygon.push_back(radius(random) * Vector2d(std::cos(angle), std::sin(angle)));
    }
    try {
      return Footprint("footprint", polygon);
    } catch (const base::InputError&) {
    }
  }
}

// Never a cell missed that is entered at a sampled place; none found where the footprint stays a twentieth of a cell away.
TEST(FootprintSweep, randomMotionsAgainstBoostGeometry) {
  const unsigned seed = 17013;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(2.0, 10.0), angle(-M_PI, M_PI);
  int met = 0, free = 0;
  for (int i = 0; i < 400; ++i) {
    const grid::Origin origin{-3.0, 2.0, random() % 2 == 0 ? 0.0 : 0.7};
    OccupancyGrid map(GridGeometry(12, 12, 1.0, origin));
    for (unsigned cells = 1 + random() % 5; cells > 0; --cells)
      map[Cell{static_cast<int>(random() % 12), static_cast<int>(random() % 12)}] = 100;
    const Footprint footprint = randomFootprint(random);
    Motion motion{
        map.geometry().worldFromGrid({place(random), place(random)}), {}, angle(random), 0.0, 0};
    motion.to = random() % 3 == 0 ? motion.from
                                  : map.geometry().worldFromGrid({place(random), place(random)});
    if (random() % 2 == 0 || motion.onTheSpot()) motion.turn = angle(random);
    const Reference reference = referenceOf(footprint, map, motion, 60);
    const bool found = sweepOf(footprint, map).first(motion, StopToken()).has_value();
    if (reference.area > 1e-5) {
      ASSERT_TRUE(found) << "missed, case " << i;
      ++met;
    }
    // Between samples corners move by less than a fifth of a cell at most.
    const double between = ((motion.to - motion.from).norm() +
                            std::abs(motion.turn) * footprint.circumscribedRadius()) /
                           120;
    if (reference.distance > 0.05 + between) {
      ASSERT_FALSE(found) << "refused, case " << i;
      ++free;
    }
  }
  EXPECT_GT(met, 60);
  EXPECT_GT(free, 60);
}

}  // namespace
}  // namespace grid_path_planner::vehicle
