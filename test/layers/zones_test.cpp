#include "layers/zones.h"

#include <gtest/gtest.h>

#include "layers/speed_limits.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::layers {
namespace {

using grid::Cell;
using grid::GridAlignment;
using grid::GridGeometry;
using grid::OccupancyGrid;
using test::contains, test::errorText;

class ZoneFile : public testing::Test {
 protected:
  Zones read(const std::string& text) const { return readZones(folder_.write("zones.yaml", text)); }
  std::string refusalOf(const std::string& text) const {
    return errorText([&] { read(text); });
  }
  static std::string inList(const std::string& zone) { return "zones:\n  - " + zone + "\n"; }

  const test::TemporaryFolder folder_;
};

TEST_F(ZoneFile, HoldsZonesOfBothKinds) {
  const Zones zones = read(
      "frame_id: odom\n"
      "zones:\n"
      "  - {name: quay, kind: keep_out, polygon: [[1, 1], [3, 1], [3, 2], [1, 2]]}\n"
      "  - {kind: slow, max_speed: 0.3, polygon: [[0, 0], [1, 0], [0, 1.5]]}\n");
  EXPECT_EQ(zones.frame_id, "odom");
  ASSERT_EQ(zones.zones.size(), 2U);
  EXPECT_EQ(zones.zones[0].name, "quay");
  EXPECT_EQ(zones.zones[0].kind, Zone::Kind::KEEP_OUT);
  EXPECT_EQ(zones.zones[1].name, "2");
  EXPECT_EQ(zones.zones[1].max_speed, 0.3);
  EXPECT_EQ(zones.zones[1].polygon[2], Eigen::Vector2d(0, 1.5));
  EXPECT_TRUE(read("zones: []\n").zones.empty());
}

TEST_F(ZoneFile, EveryMistakeIsToldWithItsLine) {
  EXPECT_TRUE(contains(refusalOf("zonez: []\n"), "zones.yaml:1"));
  EXPECT_TRUE(contains(refusalOf(inList("{kind: keepout, polygon: [[0, 0], [1, 0], [0, 1]]}")),
                       ":2: kind must be keep_out or slow, got 'keepout'"));
  EXPECT_TRUE(contains(refusalOf(inList("{kind: keep_out, polygon: [[0, 0], [1, 0]]}")),
                       "at least 3 points, got 2"));
  EXPECT_TRUE(contains(refusalOf(inList("{kind: keep_out, polygon: [[0, 0], [1], [0, 1]]}")),
                       "a point must be a list of x and y"));
  EXPECT_TRUE(contains(refusalOf(inList("{kind: keep_out, polygon: [[0, 0], [.nan, 0], [0, 1]]}")),
                       "a coordinate must be a number of metres"));
  EXPECT_TRUE(contains(refusalOf(inList("{kind: keep_out, polygon: [[0, 0], [2e6, 0], [0, 1]]}")),
                       "within 1e6 m of 0"));
  EXPECT_TRUE(
      contains(refusalOf(inList("{kind: slow, polygon: [[0, 0], [1, 0], [0, 1]]}")), "max_speed"));
  EXPECT_TRUE(
      contains(refusalOf(inList("{kind: slow, max_speed: 0, polygon: [[0, 0], [1, 0], [0, 1]]}")),
               "max_speed must be above 0"));
  EXPECT_TRUE(contains(
      refusalOf(inList("{kind: keep_out, max_speed: 1, polygon: [[0, 0], [1, 0], [0, 1]]}")),
      "a keep_out zone has no max_speed"));
}

TEST_F(ZoneFile, OfMoreThanTenThousandPointsIsRefused) {
  std::string many = "{kind: keep_out, polygon: [[0, 0]";
  for (int i = 0; i < 10000; ++i) many += ", [1, " + std::to_string(i) + "]";
  EXPECT_TRUE(contains(refusalOf(inList(many + "]}")), "at most 10000 points"));
}

Zones zonesOf(Zone::Kind kind, double speed, std::vector<Eigen::Vector2d> polygon) {
  return {"map", {{"a", kind, speed, std::move(polygon)}}};
}

TEST(KeepOutZones, AreOccupiedWhereverTheyTouchACell) {
  OccupancyGrid map(GridGeometry(4, 3, 0.5, {10.0, 20.0, 0.0}), -1);
  const auto outside = drawKeepOutZones(
      zonesOf(Zone::Kind::KEEP_OUT, 0.0, {{10.6, 20.1}, {11.1, 20.1}, {11.1, 20.4}}), map);
  EXPECT_TRUE(outside.empty());
  EXPECT_EQ(map.values(), (std::vector<std::int8_t>{-1, 100, 100, -1,  //
                                                    -1, -1, -1, -1,    //
                                                    -1, -1, -1, -1}));
}

TEST(KeepOutZones, ThatLieElsewhereAreNamed) {
  OccupancyGrid map(GridGeometry(4, 3, 0.5), 0);
  EXPECT_EQ(drawKeepOutZones(zonesOf(Zone::Kind::SLOW, 0.1, {{9, 9}, {10, 9}, {9, 10}}), map),
            std::vector<std::string>{"a"});
}

const std::vector<Eigen::Vector2d> kLeftHalf{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

std::int8_t limitAt(double zone_speed, double max_speed) {
  OccupancyGrid limits(GridGeometry(2, 1, 1.0), 0);
  addSlowZones(zonesOf(Zone::Kind::SLOW, zone_speed, kLeftHalf), max_speed, limits);
  EXPECT_EQ((limits[Cell{1, 0}]), 0);
  return limits[Cell{0, 0}];
}

TEST(SlowZones, ArePercentRoundedDown) {
  EXPECT_EQ(limitAt(0.4, 0.8), 50);
  EXPECT_EQ(limitAt(0.3, 0.8), 37);
  EXPECT_EQ(limitAt(0.56, 0.8), 70) << "0.56 / 0.8 is below 0.7 in doubles";
  EXPECT_EQ(limitAt(0.8, 0.8), 0) << "no limit";
  EXPECT_EQ(limitAt(5.0, 0.8), 0);
}

TEST(SlowZones, BelowOnePercentCannotBeTold) {
  EXPECT_TRUE(
      contains(errorText([] { checkSlowZones(zonesOf(Zone::Kind::SLOW, 0.005, kLeftHalf), 0.8); }),
               "less than 1 %"));
}

TEST(SpeedMask, MeansWhatItsScaleSays) {
  const OccupancyGrid mask(GridGeometry(5, 1, 1.0), {-1, 0, 60, 99, 1});
  EXPECT_EQ(limitsOfMask(mask, {100.0, -1.0}).values(),
            (std::vector<std::int8_t>{0, 0, 40, 1, 99}));
  EXPECT_EQ(limitsOfMask(mask, {0.0, 1.0}).values(), (std::vector<std::int8_t>{0, 0, 60, 99, 1}));
  EXPECT_EQ(limitsOfMask(mask, {0.0, 2.0}).values(), (std::vector<std::int8_t>{0, 0, 0, 0, 2}));
  EXPECT_THROW(limitsOfMask(mask, {50.0, -1.0}), base::InputError) << "60 comes to -10 %";
}

TEST(SpeedMask, OfTwoLimitsTheLowerHolds) {
  const OccupancyGrid fine(GridGeometry(4, 1, 0.5), {0, 30, 20, 0});
  OccupancyGrid limits(GridGeometry(2, 1, 1.0), {10, 50});
  addLimits(fine, GridAlignment(fine.geometry(), limits.geometry()), limits);
  EXPECT_EQ(limits.values(), (std::vector<std::int8_t>{10, 20}));
}

}  // namespace
}  // namespace grid_path_planner::layers
