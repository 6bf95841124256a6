#include "layers/layered_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "support/error_text.h"
#include "support/random_map.h"

namespace grid_path_planner::layers {
namespace {

using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;
using test::contains, test::errorText;

using Map = std::shared_ptr<OccupancyGrid>;

Map mapOf(const GridGeometry& geometry, std::vector<std::int8_t> values) {
  return std::make_shared<OccupancyGrid>(geometry, std::move(values));
}

const GridGeometry kRow(4, 1, 1.0);

LayeredMap rowOf(std::vector<std::int8_t> values) {
  LayeredMap map;
  map.configure({}, {});
  map.setBase(mapOf(kRow, std::move(values)));
  return map;
}

using Values = std::vector<std::int8_t>;

TEST(LayeredMap, ACellHasTheLargestValueThatAnySourceGives) {
  LayeredMap map = rowOf({-1, 0, 100, 0});
  map.setLive(mapOf(kRow, {0, 100, 0, -1}));
  EXPECT_EQ(map.merged().values(), (Values{0, 100, 100, 0}));
  map.use(Layer::LIVE, false);
  EXPECT_EQ(map.merged().values(), (Values{-1, 0, 100, 0}));
}

TEST(LayeredMap, WhatCameBeforeTheBaseWaitsForIt) {
  LayeredMap map;
  map.configure({}, {"map", {{"a", Zone::Kind::KEEP_OUT, 0.0, {{3, 0}, {4, 0}, {4, 1}}}}});
  map.setLive(mapOf(kRow, {-1, 100, -1, -1}));
  EXPECT_FALSE(map.hasBase());
  map.setBase(mapOf(kRow, {0, 0, 0, 0}));
  EXPECT_EQ(map.merged().values(), (Values{0, 100, 0, 100}));
  EXPECT_TRUE(map.takeNewGeometry());
}

TEST(LayeredMap, AnObstacleOfACoarserMapIsOneInEveryCellThatItTouches) {
  LayeredMap map = rowOf({0, 0, 0, 0});
  map.setLive(mapOf(GridGeometry(2, 1, 1.5, {0.5, 0.0, 0.0}), {0, 100}));
  EXPECT_EQ(map.merged().values(), (Values{0, 0, 100, 100}));
}

TEST(LayeredMap, AMapThatIsTurnedByAQuarterIsTheSameMap) {
  LayeredMap map;
  map.configure({}, {});
  map.setBase(mapOf(GridGeometry(3, 2, 1.0, {5, 0, M_PI / 2}), {0, 1, 2, 100, -1, 5}));
  EXPECT_EQ(map.merged().geometry(), GridGeometry(2, 3, 1.0, {3, 0, 0}));
  EXPECT_EQ(map.merged().values(), (Values{100, 0, -1, 1, 5, 2}));
}

Values randomValues(const GridGeometry& geometry, std::mt19937& random) {
  Values values(geometry.size());
  for (std::int8_t& value : values) value = std::array<std::int8_t, 4>{0, 0, -1, 100}[random() % 4];
  return values;
}

TEST(LayeredMap, AMapWithAYawKeepsEveryObstacleAndNoUnknownCellBecomesFree) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    const double yaw = std::uniform_real_distribution<double>(-7.0, 7.0)(random);
    const GridGeometry geometry(9, 14, 0.3, {-2.0, 1.0, yaw});
    const Map turned = mapOf(geometry, randomValues(geometry, random));
    LayeredMap map;
    map.configure({}, {});
    map.setBase(turned);
    const OccupancyGrid& level = map.merged();
    const auto classOf = [](std::int8_t value) { return value < 0 ? 1 : value >= 65 ? 2 : 0; };
    for (int i = 0; i < 2000; ++i) {  // by points, which know nothing of squares
      std::uniform_real_distribution<double> within(-0.2, 1.2);
      const Eigen::Vector2d point = geometry.worldFromGrid(
          {within(random) * geometry.width(), within(random) * geometry.height()});
      const auto there = level.geometry().cellAt(point);
      const auto source = geometry.cellAt(point);
      if (!there) {
        EXPECT_FALSE(source) << "the grid holds the whole map";
        continue;
      }
      const int least = source ? classOf((*turned)[*source]) : 1;
      EXPECT_GE(classOf(level[*there]), least) << "yaw " << yaw << " at " << point.transpose();
    }
    for (int row = 0; row < level.height(); ++row)  // and grows by no more than a cell's diagonal
      for (int column = 0; column < level.width(); ++column) {
        if (classOf(level[{column, row}]) != 2) continue;
        const Eigen::Vector2d centre = level.geometry().centre({column, row});
        double nearest = 1e9;
        for (int y = 0; y < geometry.height(); ++y)
          for (int x = 0; x < geometry.width(); ++x)
            if (classOf((*turned)[{x, y}]) == 2)
              nearest = std::min(nearest, (geometry.centre({x, y}) - centre).norm());
        EXPECT_LE(nearest, std::sqrt(2.0) * 0.3);
      }
  }
}

TEST(LayeredMap, MasksWithAYawTouchWhatLiesUnderThem) {
  LayeredMap map = rowOf({0, 0, 0, 0});
  map.setKeepOutMask(mapOf(GridGeometry(2, 1, 1.0, {1, 0, M_PI / 2}), {100, 0}));
  map.setSpeedMask(mapOf(GridGeometry(2, 1, 1.0, {3, 0, M_PI / 2}), {70, 0}));
  EXPECT_EQ(map.merged().values(), (Values{100, 0, 0, 0}));
  EXPECT_EQ(map.speedLimits().values(), (Values{0, 0, 30, 0}));
}

TEST(LayeredMap, ATurnedMapFollowsOccupiedMin) {
  MapLayersOptions options;
  LayeredMap map;
  map.configure(options, {});
  const GridGeometry square(2, 2, 1.0, {0, 0, M_PI / 4});
  map.setBase(mapOf(square, {50, 50, 50, 50}));
  const auto most = [&] {
    return *std::max_element(map.merged().values().begin(), map.merged().values().end());
  };
  EXPECT_EQ(map.merged().values().front(), -1)
      << "the map holds a part of it, and 50 is no obstacle";
  options.occupied_min = 40;
  map.configure(options, {});
  EXPECT_EQ(most(), 50);
  EXPECT_EQ(map.merged().values()[1], 50);
}

TEST(LayeredMap, ALongThinMapWithAYawIsRefusedAndChangesNothing) {
  LayeredMap map = rowOf({0, 0, 0, 0});
  const Map thin = mapOf(GridGeometry(4000, 1, 1.0, {0, 0, 0.5}), Values(4000, 100));
  EXPECT_TRUE(contains(errorText([&] { map.setLive(thin); }), "turned by 0.5 rad"));
  EXPECT_TRUE(contains(errorText([&] { map.setBase(thin); }), "turned by 0.5 rad"));
  EXPECT_EQ(map.merged().values(), (Values{0, 0, 0, 0}));
}

TEST(LayeredMap, ZonesThatCannotBeToldChangeNothing) {
  LayeredMap map = rowOf({0, 0, 0, 0});
  const std::vector<Eigen::Vector2d> all{{0, 0}, {4, 0}, {4, 1}, {0, 1}};
  EXPECT_TRUE(contains(errorText([&] {
                         map.configure({}, {"map",
                                            {{"a", Zone::Kind::KEEP_OUT, 0.0, all},
                                             {"b", Zone::Kind::SLOW, 1e-3, all}}});
                       }),
                       "zone 'b'"));
  EXPECT_EQ(map.merged().values(), (Values{0, 0, 0, 0}));
}

TEST(LayeredMap, MasksAndZonesLimitTheSpeed) {
  LayeredMap map = rowOf({0, 0, 0, 0});
  EXPECT_TRUE(map.takeNewSpeedLimits());
  map.configure({}, {"map", {{"a", Zone::Kind::SLOW, 0.4, {{0, 0}, {2, 0}, {2, 1}, {0, 1}}}}});
  map.setSpeedMask(mapOf(kRow, {0, 70, 20, 0}));
  EXPECT_EQ(map.speedLimits().values(), (Values{50, 30, 80, 0}));
  EXPECT_TRUE(map.takeNewSpeedLimits());
  map.setSpeedMask(mapOf(kRow, {0, 70, 20, 0}));
  EXPECT_FALSE(map.takeNewSpeedLimits()) << "nothing changed";
}

// What the parts amount to, cell by cell from the metres of their corners.
class Reference {
 public:
  explicit Reference(const OccupancyGrid& base) : base_(base) {}

  Values merged(const OccupancyGrid& live, const OccupancyGrid& mask) const {
    Values values;
    for (int row = 0; row < base_.height(); ++row)
      for (int column = 0; column < base_.width(); ++column) {
        int value = base_[Cell{column, row}];
        value = std::max(value, ofLive({column, row}, live));
        if (touches({column, row}, mask)) value = 100;
        values.push_back(static_cast<std::int8_t>(value));
      }
    return values;
  }

 private:
  template <class Visit>
  void overlapping(Cell cell, const OccupancyGrid& other, Visit visit) const {
    const double r = base_.geometry().resolution(), s = other.geometry().resolution();
    const Eigen::Vector2d low = base_.geometry().worldFromGrid({cell.column, cell.row});
    for (int row = 0; row < other.height(); ++row)
      for (int column = 0; column < other.width(); ++column) {
        const Eigen::Vector2d at = other.geometry().worldFromGrid({column, row});
        const double wide = std::min(low.x() + r, at.x() + s) - std::max(low.x(), at.x());
        const double high = std::min(low.y() + r, at.y() + s) - std::max(low.y(), at.y());
        if (wide > 1e-5 * r && high > 1e-5 * r) visit(other[Cell{column, row}], wide * high);
      }
  }
  int ofLive(Cell cell, const OccupancyGrid& live) const {
    const double r = base_.geometry().resolution();
    int most = -1;
    bool unknown = false;
    double known_area = 0.0;
    overlapping(cell, live, [&](int value, double area) {
      most = std::max(most, value);
      unknown = unknown || value < 0;
      known_area += area;
    });
    if (most >= 65) return most;
    return unknown || known_area < r * r * (1.0 - 1e-4) ? -1 : most;
  }
  bool touches(Cell cell, const OccupancyGrid& mask) const {
    bool touched = false;
    overlapping(cell, mask, [&](int value, double) { touched = touched || value >= 65; });
    return touched;
  }

  const OccupancyGrid& base_;
};

OccupancyGrid placed(const OccupancyGrid& map, double resolution, const grid::Origin& origin) {
  return OccupancyGrid(GridGeometry(map.width(), map.height(), resolution, origin), map.values());
}

// Changes in pieces come to what a map made anew has, and takeChanged() tells each.
TEST(LayeredMap, IsWhatItsPartsAmountToAfterEveryChange) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> place(-2.0, 2.0), size(0.3, 1.7);
  for (int round = 0; round < 60; ++round) {
    OccupancyGrid base = test::randomOccupancy(random, 12, 0.2, 0.3);
    const bool aligned = round % 3 == 0;
    const auto somewhere = [&] {
      return placed(
          test::randomOccupancy(random, 12, 0.2, 0.3), aligned ? 1.0 : size(random),
          aligned ? grid::Origin{2.0, -1.0, 0.0} : grid::Origin{place(random), place(random), 0.0});
    };
    OccupancyGrid live = somewhere();
    const OccupancyGrid mask = somewhere();
    LayeredMap map;
    map.configure({}, {});
    map.setBase(std::make_shared<OccupancyGrid>(base));
    map.setLive(std::make_shared<OccupancyGrid>(live));
    map.setKeepOutMask(std::make_shared<OccupancyGrid>(mask));
    Values told = map.merged().values();
    map.takeChanged();
    for (int change = 0; change < 5; ++change) {
      OccupancyGrid& changed = change % 2 == 0 ? live : base;
      const std::vector<CellRect> rects = test::randomRects(random, changed.geometry(), 5);
      for (const CellRect& rect : rects)
        for (int row = rect.row; row < rect.row + rect.height; ++row)
          for (int column = rect.column; column < rect.column + rect.width; ++column)
            if (changed.contains({column, row}))
              changed[Cell{column, row}] = static_cast<std::int8_t>(random() % 102) - 1;
      std::vector<CellRect> inside;
      for (const CellRect& rect : rects)
        inside.push_back(rect.intersection(changed.geometry().rect()));
      if (change % 2 == 0)
        map.setLive(std::make_shared<OccupancyGrid>(live), inside);
      else
        map.setBase(std::make_shared<OccupancyGrid>(base), inside);
      ASSERT_EQ(map.merged().values(), Reference(base).merged(live, mask)) << "round " << round;
      for (const CellRect& rect : map.takeChanged())
        for (int row = rect.row; row < rect.row + rect.height; ++row)
          for (int column = rect.column; column < rect.column + rect.width; ++column)
            told[base.geometry().index({column, row}).value()] = map.merged()[Cell{column, row}];
      ASSERT_EQ(map.merged().values(), told) << "round " << round;
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::layers
