// How a start that is too near to something, or in it, is left: in line of sight, never nearer, through nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/planning/path_planner.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/kept_distance.h"

namespace grid_path_planner::planning {

using base::Status;
using costmap::Outside;
using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;
using path::Pose;
using test::AsciiMap;
using test::contains;

namespace {

constexpr double kEscapeRounding = 1e-6;  // m

using Point = Eigen::Vector2d;

Pose standingAt(const Point& point) {
  Pose pose;
  pose.position << point, 0.0;
  return pose;
}

PlannerOptions escaping(double radius, double start_escape_radius) {
  PlannerOptions options;
  options.costmap.radius = radius;
  options.start_escape_radius = start_escape_radius;
  return options;
}

Plan planFrom(const OccupancyGrid& map, const Point& start, const Point& goal,
              const PlannerOptions& options) {
  PathPlanner planner(options);
  planner.setMap(std::make_shared<const OccupancyGrid>(map));
  return planner.plan({standingAt(start), standingAt(goal), false});
}

Point secondPose(const Plan& plan) {
  return plan.path.poses.size() < 2 ? Point(NAN, NAN) : plan.path.poses[1].position.head<2>();
}

void expectPoint(const Point& expected, const Point& point) {
  EXPECT_NEAR(expected.x(), point.x(), 1e-9);
  EXPECT_NEAR(expected.y(), point.y(), 1e-9);
}

std::vector<std::string> sameRows(int count, const std::string& row) {
  return std::vector<std::string>(static_cast<std::size_t>(count), row);
}

// The wall is from x 1.0 to 1.1 m.
OccupancyGrid closedWall() {
  return AsciiMap(sameRows(9, "..........#.........."), 0.1).map;
}

// It was left straight through the wall, for the cell from which the goal is reached.
TEST(StartEscape, NoWallIsCrossed) {
  const PlannerOptions options = escaping(0.5, 0.8);
  const Point start(0.85, 0.45);
  const Plan away = planFrom(closedWall(), start, {0.15, 0.45}, options);
  ASSERT_EQ(Status::FOUND, away.status) << away.message;
  expectPoint({0.45, 0.45}, secondPose(away));
  const Plan across = planFrom(closedWall(), start, {1.95, 0.45}, options);
  EXPECT_EQ(Status::UNREACHABLE, across.status) << across.message;
}

// With the kernel the segment went to the middle of the first block, past the cell.
TEST(StartEscape, NoKernelMovesTheEndOfTheLine) {
  PlannerOptions options = escaping(0.5, 0.8);
  for (const int kernel : {2, 3, 5}) {
    options.costmap.kernel = kernel;
    const Plan plan = planFrom(closedWall(), {0.85, 0.45}, {0.15, 0.45}, options);
    ASSERT_EQ(Status::FOUND, plan.status) << plan.message;
    expectPoint({0.45, 0.45}, secondPose(plan));
  }
}

// A thin wall has a half on either side.
TEST(StartEscape, AStartInAWallLeavesItByTheHalfInWhichItIs) {
  const PlannerOptions options = escaping(0.2, 0.6);
  const Point left(0.15, 0.45), right(1.95, 0.45);
  for (const double x : {1.001, 1.02, 1.049}) {
    const Plan found = planFrom(closedWall(), {x, 0.45}, left, options);
    ASSERT_EQ(Status::FOUND, found.status) << found.message;
    expectPoint({0.75, 0.45}, secondPose(found));
    EXPECT_EQ(Status::UNREACHABLE, planFrom(closedWall(), {x, 0.45}, right, options).status);
  }
  for (const double x : {1.051, 1.08, 1.099}) {
    EXPECT_EQ(Status::UNREACHABLE, planFrom(closedWall(), {x, 0.45}, left, options).status);
    EXPECT_EQ(Status::FOUND, planFrom(closedWall(), {x, 0.45}, right, options).status);
  }
  for (const Point& goal : {left, right})
    EXPECT_EQ(Status::FOUND, planFrom(closedWall(), {1.05, 0.45}, goal, options).status)
        << "both edges are as near";
}

// A lane to the left, too narrow for the vehicle; the wall's end is 0.15 m away, and the room to the right 0.18 m.
TEST(StartEscape, AStartInAWallIsLeftByItsNearestEdgeOnly) {
  std::vector<std::string> lines = sameRows(10, ".....##...##........");
  for (int row = 0; row < 10; ++row) lines.emplace_back(20, '.');
  const OccupancyGrid map = AsciiMap(lines, 0.1).map;
  const PlannerOptions options = escaping(0.3, 0.7);
  const Point goal(1.75, 1.75);
  EXPECT_EQ(Status::FOUND, planFrom(map, {1.18, 0.85}, goal, options).status);
  const Plan plan = planFrom(map, {1.02, 0.85}, goal, options);
  EXPECT_EQ(Status::START_OCCUPIED, plan.status);
  EXPECT_EQ(
      "start (1.02, 0.85) is in an occupied cell, with no passable cell within the "
      "start_escape_radius of 0.7 m on a straight line that leaves the occupied cells by the "
      "nearest "
      "edge and touches none again",
      plan.message);
}

TEST(StartEscape, ACornerIsLeftByTheShortestLine) {
  std::vector<std::string> lines = sameRows(16, "#...............");
  lines[0] = "################";
  const OccupancyGrid map = AsciiMap(lines, 0.1).map;
  const Plan plan = planFrom(map, {0.25, 0.25}, {1.45, 1.45}, escaping(0.5, 0.8));
  ASSERT_EQ(Status::FOUND, plan.status) << plan.message;
  expectPoint({0.65, 0.65}, secondPose(plan));
  EXPECT_TRUE(contains(plan.message, "the path leaves it for a passable cell 0.5657 m away"))
      << plan.message;
}

// In the middle of a door of four cells the line to every centre comes nearer to one of its sides.
TEST(StartEscape, ADoorIsLeftAlongItsMiddle) {
  for (const int width : {3, 4}) {
    std::vector<std::string> lines = sameRows(5, ".........###.........");
    for (int row = 0; row < width; ++row) lines.emplace_back(21, '.');
    for (int row = 0; row < 5; ++row) lines.push_back(lines[0]);
    const OccupancyGrid map = AsciiMap(lines, 0.1).map;
    const Point start(1.05, 0.5 + 0.05 * width);
    for (const double goal : {0.25, 1.85}) {
      const Plan plan = planFrom(map, start, {goal, 0.2}, escaping(0.3, 0.8));
      ASSERT_EQ(Status::FOUND, plan.status) << plan.message;
      expectPoint({goal < 1.0 ? 0.55 : 1.55, start.y()}, secondPose(plan));
    }
  }
}

// What the vehicle itself left in the map.
TEST(StartEscape, CellsAroundTheVehicleAreLeftAndAPoleBesideIsNotTouched) {
  std::vector<std::string> lines = sameRows(20, "....................");
  for (int row = 8; row < 11; ++row) lines[static_cast<std::size_t>(row)].replace(8, 3, "###");
  const OccupancyGrid alone = AsciiMap(lines, 0.1).map;
  const Plan plan = planFrom(alone, {0.95, 0.95}, {0.15, 0.95}, escaping(0.3, 0.8));
  ASSERT_EQ(Status::FOUND, plan.status) << plan.message;
  EXPECT_NEAR(0.5, (secondPose(plan) - Point(0.95, 0.95)).norm(), 1e-9);
  lines[9][6] = lines[9][12] = lines[6][9] = lines[12][9] = '#';
  const OccupancyGrid poles = AsciiMap(lines, 0.1).map;
  const Plan between = planFrom(poles, {0.95, 0.95}, {0.15, 0.15}, escaping(0.3, 1.2));
  ASSERT_EQ(Status::FOUND, between.status) << between.message;
  OccupancyGrid only_poles = poles;
  for (int row = 8; row < 11; ++row)
    for (int column = 8; column < 11; ++column) only_poles[Cell{column, row}] = 0;
  EXPECT_GT(test::leastDistance({{0.95, 0.95}, secondPose(between)}, only_poles, {}, 1.0), 0.01);
}

TEST(StartEscape, UnknownCellsAroundAStartAreLeft) {
  std::vector<std::string> lines = sameRows(24, "........................");
  for (int row = 9; row < 14; ++row) lines[static_cast<std::size_t>(row)].replace(9, 5, "?????");
  const OccupancyGrid map = AsciiMap(lines, 0.1).map;
  PlannerOptions options = escaping(0.3, 0.8);
  options.costmap.outside = Outside::FREE;
  options.costmap.unknown_is_passable = false;
  for (const Point& start : {Point(1.15, 1.15), Point(1.11, 1.15), Point(1.15, 1.27)}) {
    const Plan plan = planFrom(map, start, {2.25, 2.25}, options);
    ASSERT_EQ(Status::FOUND, plan.status) << plan.message;
    EXPECT_LE((secondPose(plan) - start).norm(), 0.61);
  }
  options.start_escape_radius = 0.0;
  EXPECT_EQ(Status::START_OCCUPIED, planFrom(map, {1.15, 1.15}, {2.25, 2.25}, options).status);
}

// Unknown cells behind a wall, whose nearest edge is the wall.
TEST(StartEscape, UnknownCellsAreNotLeftThroughAWall) {
  const OccupancyGrid map = AsciiMap(sameRows(9, ".......#????????????"), 0.1).map;
  PlannerOptions options = escaping(0.0, 0.9);
  options.costmap.unknown_is_passable = false;
  const Plan plan = planFrom(map, {0.95, 0.45}, {0.15, 0.45}, options);
  EXPECT_EQ(Status::START_OCCUPIED, plan.status) << plan.message;
  EXPECT_TRUE(contains(plan.message, "is in an unknown cell and unknown_is_passable is false"))
      << plan.message;
}

TEST(StartEscape, SaysHowNearNoLineComes) {
  std::vector<std::string> lines = sameRows(15, "...............");
  for (const int row : {5, 9}) lines[static_cast<std::size_t>(row)].replace(5, 5, "#####");
  for (int row = 6; row < 9; ++row) {
    lines[static_cast<std::size_t>(row)][5] = '#';
    lines[static_cast<std::size_t>(row)][9] = '#';
  }
  const OccupancyGrid map = AsciiMap(lines, 0.1).map;
  const Plan plan = planFrom(map, {0.75, 0.75}, {0.15, 0.15}, escaping(0.3, 0.8));
  EXPECT_EQ(Status::START_OCCUPIED, plan.status);
  EXPECT_EQ(
      "start (0.75, 0.75) is nearer than the radius of 0.3 m to an occupied cell, with no passable "
      "cell within the start_escape_radius of 0.8 m on a straight line that comes no nearer than "
      "0.15 m to an occupied cell",
      plan.message);
}

// Everything in cells and by samples of a line.
class EscapeReference {
 public:
  // How strictly a line is judged: one that only the lenient judge takes may be legal or not.
  enum class Judge { LENIENT, STRICT };

  EscapeReference(const OccupancyGrid& map, const PlannerOptions& options, const Point& start)
      : map_(map), start_(map.geometry().gridFromWorld(start)) {
    const costmap::CostmapOptions& costmap = options.costmap;
    const double side = map.geometry().resolution();
    kept_[0] = costmap.radius / side;
    kept_[1] = costmap.unknown_is_passable ? -1.0 : costmap.radius / side;
    if (costmap.outside == Outside::OCCUPIED) border_ = kept_[0];
    if (costmap.outside == Outside::UNKNOWN) border_ = std::max(0.0, kept_[1]);
    for (int row = 0; row < map.height(); ++row)
      for (int column = 0; column < map.width(); ++column) {
        const int value = map[Cell{column, row}];
        if (value != 0) cells_[value < 0 ? 1 : 0].push_back(Point(column, row));
      }
    for (const int of : {0, 1}) own_[of] = distance(of, start_);
    findEdges();
  }

  // Passable cells, nearest first, with their distances from the start.
  std::vector<std::pair<double, Point>> passableCells(double radius) const {
    std::vector<std::pair<double, Point>> cells;
    const double reach = radius / map_.geometry().resolution();
    for (int row = 0; row < map_.height(); ++row)
      for (int column = 0; column < map_.width(); ++column) {
        const Point centre(column + 0.5, row + 0.5);
        const double away = (centre - start_).norm();
        if (away <= reach + 1e-9 && passable(centre)) cells.emplace_back(away, centre);
      }
    std::sort(cells.begin(), cells.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    return cells;
  }

  bool legal(const Point& to, Judge judge) const {
    const double border = std::min(border_, toBorder(start_));
    return toBorder(to) >= border - 1e-9 && legalFor(0, to, judge) && legalFor(1, to, judge);
  }

 private:
  static constexpr double kStep = 0.02, kTolerance = 0.05;  // cells

  static double toSquare(const Point& corner, const Point& at) {
    const Point outside =
        (corner - at).cwiseMax(at - corner - Point(1.0, 1.0)).cwiseMax(Point(0.0, 0.0));
    return outside.norm();
  }

  double distance(int of, const Point& at) const {
    double least = 1e9;
    for (const Point& corner : cells_[of]) least = std::min(least, toSquare(corner, at));
    return least;
  }

  double toBorder(const Point& at) const {
    return std::min({at.x(), at.y(), map_.width() - at.x(), map_.height() - at.y()});
  }

  bool passable(const Point& centre) const {
    for (const int of : {0, 1})
      if (kept_[of] >= 0.0 &&
          (distance(of, centre) < kept_[of] - 1e-6 || distance(of, centre) == 0.0))
        return false;
    return toBorder(centre) >= border_ - 1e-6;
  }

  // The nearest points of squares in which nothing is kept from.
  void findEdges() {
    double least = 1e9;
    std::vector<std::pair<double, Point>> points;
    for (int row = 0; row < map_.height(); ++row)
      for (int column = 0; column < map_.width(); ++column) {
        const int value = map_[Cell{column, row}];
        if (value > 0 || (value < 0 && kept_[1] >= 0.0)) continue;
        const Point corner(column, row);
        const Point point = start_.cwiseMax(corner).cwiseMin(corner + Point(1.0, 1.0));
        points.emplace_back((point - start_).norm(), point);
        least = std::min(least, points.back().first);
      }
    depth_ = least;
    for (const auto& [away, point] : points)
      if (away < least + 1e-6) edges_.push_back(point);
  }

  bool legalFor(int of, const Point& to, Judge judge) const {
    if (kept_[of] < 0.0) return true;
    const double least = std::min(own_[of], kept_[of]);
    return least > 1e-6 ? stays(of, to, least, judge) : leaves(of, to, judge);
  }

  bool stays(int of, const Point& to, double least, Judge judge) const {
    const double length = (to - start_).norm();
    for (double at = 0.0; at <= length; at += kStep) {
      const double more = judge == Judge::STRICT ? 0.05 * at : -1e-6;
      if (distance(of, start_ + (to - start_) * at / length) < std::min(kept_[of], least + more))
        return false;
    }
    return true;
  }

  bool leaves(int of, const Point& to, Judge judge) const {
    const double length = (to - start_).norm();
    const double tolerance = judge == Judge::STRICT ? -kTolerance : kTolerance;
    std::optional<double> left;
    for (double at = 0.0; at <= length; at += kStep) {
      const Point point = start_ + (to - start_) * at / length;
      const double away = distance(of, point);
      if (!left && away > 0.0) {
        left = at;
        if (!nearEdge(point, tolerance)) return false;
      }
      if (!left || at < *left + 0.2) continue;
      if (judge == Judge::STRICT ? away < kTolerance : away == 0.0 && deep(of, point)) return false;
    }
    return left.has_value();
  }

  bool nearEdge(const Point& point, double tolerance) const {
    if (own_[0] > 0.0 && (own_[1] > 0.0 || kept_[1] < 0.0)) return true;
    return std::any_of(edges_.begin(), edges_.end(), [&](const Point& edge) {
      return (point - edge).norm() <= depth_ + tolerance;
    });
  }

  // Whether a point in a cell is more than grazing it.
  bool deep(int of, const Point& at) const {
    for (const Point& corner : cells_[of]) {
      const Point in = (at - corner).cwiseMin(corner + Point(1.0, 1.0) - at);
      if (in.minCoeff() > kTolerance) return true;
    }
    return false;
  }

  const OccupancyGrid& map_;
  const Point start_;
  double kept_[2] = {0.0, 0.0};  // of occupied cells, and of unknown ones; below 0: not asked
  double own_[2] = {0.0, 0.0};   // of the start
  double border_ = 0.0;
  std::vector<Point> cells_[2];  // corners
  std::vector<Point> edges_;
  double depth_ = 0.0;
};

// Walls, and single cells of both classes.
OccupancyGrid randomWalls(std::mt19937& random, const GridGeometry& geometry) {
  OccupancyGrid map(geometry);
  const auto column = [&] { return static_cast<int>(random() % geometry.width()); };
  const auto row = [&] { return static_cast<int>(random() % geometry.height()); };
  for (int i = 0; i < 5; ++i) {
    const bool upright = random() % 2 == 0, thick = random() % 3 == 0;
    const Cell from{column(), row()};
    const auto value = static_cast<std::int8_t>(random() % 3 == 0 ? -1 : 100);
    for (int k = 0; k < 8; ++k)
      for (int wide = 0; wide <= int(thick); ++wide) {
        const Cell cell{from.column + (upright ? wide : k), from.row + (upright ? k : wide)};
        if (geometry.contains(cell)) map[cell] = value;
      }
  }
  for (int i = 0; i < 8; ++i)
    map[Cell{column(), row()}] = static_cast<std::int8_t>(i < 5 ? 100 : -1);
  return map;
}

struct EscapeQuestion {
  OccupancyGrid map;
  PlannerOptions options;
  Point start;
  Point goal;
};

EscapeQuestion randomEscape(std::mt19937& random) {
  const auto anyOf = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random() % 10007) / 10007.0;
  };
  const GridGeometry geometry(22, 20, 0.1, {anyOf(-3.0, 3.0), anyOf(-3.0, 3.0), anyOf(-3.0, 3.0)});
  EscapeQuestion question{randomWalls(random, geometry), escaping(0.0, anyOf(0.2, 1.0)), {}, {}};
  PlannerOptions& options = question.options;
  if (random() % 4 != 0) options.costmap.radius = anyOf(0.05, 0.4);
  options.costmap.unknown_is_passable = random() % 2 == 0;
  options.costmap.outside = choicesOf(Outside{})[random() % 3].second;
  options.costmap.kernel = 1 + static_cast<int>(random() % 3);
  const auto anywhere = [&] {
    return geometry.worldFromGrid({anyOf(0.01, 21.99), anyOf(0.01, 19.99)});
  };
  question.start = anywhere();
  question.goal = anywhere();
  options.tolerance = 5.0;
  return question;
}

bool tellsEscape(const Plan& plan) {
  return contains(plan.message, "the path leaves it for a passable cell");
}

// What is nearer leads to no goal.
void expectShortest(const EscapeQuestion& question, const EscapeReference& reference,
                    double length) {
  PlannerOptions options = question.options;
  options.costmap.kernel = 1;
  options.tolerance = 0.0;
  for (const auto& [away, centre] : reference.passableCells(options.start_escape_radius)) {
    if (away * 0.1 > length - kEscapeRounding) return;
    if (!reference.legal(centre, EscapeReference::Judge::STRICT)) continue;
    const Point from = question.map.geometry().worldFromGrid(centre);
    const Plan plan = planFrom(question.map, from, question.goal, options);
    EXPECT_NE(Status::FOUND, plan.status) << "from " << from.transpose() << ", which is nearer";
  }
}

TEST(StartEscape, IsTheShortestLineThatComesNoNearer) {
  std::mt19937 random(49);
  std::map<std::string, int> counts;
  for (int trial = 0; trial < 4000; ++trial) {
    const EscapeQuestion question = randomEscape(random);
    const Plan plan = planFrom(question.map, question.start, question.goal, question.options);
    SCOPED_TRACE("trial " + std::to_string(trial) + ": " + plan.message);
    const EscapeReference reference(question.map, question.options, question.start);
    if (plan.found() && tellsEscape(plan)) {
      const Point second = secondPose(plan);
      EXPECT_TRUE(reference.legal(question.map.geometry().gridFromWorld(second),
                                  EscapeReference::Judge::LENIENT));
      const bool unknown = !question.options.costmap.unknown_is_passable;
      const double radius = question.options.costmap.radius;
      for (const test::KeptFrom& from :
           {test::KeptFrom{true, false, false}, test::KeptFrom{false, unknown, false}}) {
        const double at_start = test::leastDistance({question.start}, question.map, from, radius);
        EXPECT_GE(test::leastDistance({question.start, second}, question.map, from, radius),
                  at_start - kEscapeRounding);
        if (at_start == 0.0 && radius > 0.0) ++counts["inside"];
      }
      const Point last = plan.path.poses.back().position.head<2>();
      if (last == question.goal)
        expectShortest(question, reference, (second - question.start).norm());
      ++counts["found"];
    }
    if (plan.status == Status::START_OCCUPIED) {
      for (const auto& [away, centre] :
           reference.passableCells(question.options.start_escape_radius))
        EXPECT_FALSE(reference.legal(centre, EscapeReference::Judge::STRICT)) << centre.transpose();
      ++counts["refused"];
    }
  }
  RecordProperty("found", counts["found"]);
  EXPECT_GT(counts["found"], 400);
  EXPECT_GT(counts["inside"], 100);
  EXPECT_GT(counts["refused"], 400);
}

}  // namespace
}  // namespace grid_path_planner::planning
