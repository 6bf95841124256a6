#include "ros/input/foreign_rules.h"

#include <gtest/gtest.h>
#include <ros/console.h>

#include <vector>

namespace grid_path_planner::nodes {
namespace {

// What is logged meanwhile.
class Log : public ros::console::LogAppender {
 public:
  Log() { ros::console::register_appender(this); }
  ~Log() override { ros::console::deregister_appender(this); }
  void log(ros::console::Level, const char* line, const char*, const char*, int) override {
    lines.emplace_back(line);
  }

  std::vector<std::string> lines;
};

MapEvent mapOf(const std::string& publisher, double w) {
  auto map = boost::make_shared<nav_msgs::OccupancyGrid>();
  map->info.width = map->info.height = 1;
  map->info.resolution = 1.0f;
  map->info.origin.orientation.w = w;
  map->data = {0};
  auto header = boost::make_shared<ros::M_string>();
  (*header)["callerid"] = publisher;
  (*header)["topic"] = "/projected_map";
  return {map, header, ros::Time(1)};
}

// octomap_server's maps come several times a second.
TEST(ForeignRules, AnOriginWithoutAnOrientationIsToldOnceAPublisher) {
  const Log log;
  for (int i = 0; i < 3; ++i)
    for (const char* publisher : {"/octomap_server", "/other"}) tellTraits(mapOf(publisher, 0.0));
  tellTraits(mapOf("/map_server", 1.0));
  EXPECT_EQ(log.lines,
            (std::vector<std::string>{
                "/projected_map of /octomap_server: its origin has no orientation: yaw 0 is taken",
                "/projected_map of /other: its origin has no orientation: yaw 0 is taken"}));
}

TEST(ForeignRules, AMapWithoutCellsIsNoneYetAndToldOnce) {
  const Log log;
  auto header = boost::make_shared<ros::M_string>();
  (*header)["callerid"] = "/octomap_server";
  (*header)["topic"] = "/projected_map";
  const MapEvent empty(boost::make_shared<nav_msgs::OccupancyGrid>(), header, ros::Time(1));
  EXPECT_TRUE(isNotYet(empty));
  EXPECT_TRUE(isNotYet(empty));
  EXPECT_FALSE(isNotYet(mapOf("/octomap_server", 1.0)));
  EXPECT_EQ(log.lines,
            std::vector<std::string>{"/projected_map of /octomap_server: a map without cells is "
                                     "none yet, and the map before it stays"});
}

// move_base's costmap as the planner's map: what is 99 there was inflated once more without a word.
TEST(ForeignRules, AnInflatedMapIsToldOnce) {
  const Log log;
  auto map = boost::make_shared<nav_msgs::OccupancyGrid>(*mapOf("", 1.0).getConstMessage());
  map->info.width = 5;
  map->data = {50, 99, 100, 99, 50};
  auto header = boost::make_shared<ros::M_string>();
  (*header)["callerid"] = "/move_base";
  (*header)["topic"] = "/costmap";
  for (int i = 0; i < 3; ++i) tellTraits({map, header, ros::Time(1)});
  ASSERT_EQ(log.lines.size(), 1u);
  EXPECT_EQ(log.lines[0].find("/costmap of /move_base: it is inflated, as costmap_2d's maps are"),
            0u);
}

TEST(MapFit, TellsOnceWhereTheThresholdsDoNotFit) {
  const Log log;
  const auto grid = std::make_shared<grid::OccupancyGrid>(grid::GridGeometry(2, 1, 1.0),
                                                          std::vector<std::int8_t>{38, 57});
  MapFit fit;
  EXPECT_EQ(fit.problem(nullptr, {}), "");
  for (int i = 0; i < 3; ++i) EXPECT_NE(fit.problem(grid, {}), "");
  EXPECT_EQ(log.lines.size(), 1u);
  EXPECT_EQ(fit.problem(grid, {45, 50}), "");
  EXPECT_NE(fit.problem(grid, {}), "");
  EXPECT_EQ(log.lines.size(), 2u);
}

TEST(ForeignRules, NamesOfStrangersAreNotLogged) {
  const Log log;
  tellTraits(mapOf("$(reboot)\x1b[2J", 0.0));
  EXPECT_EQ(log.lines, std::vector<std::string>{"/projected_map of : its origin has no "
                                                "orientation: yaw 0 is taken"});
}

TEST(ToldOnce, EachThingIsNewOnceAndMemoryIsBounded) {
  ToldOnce told;
  EXPECT_TRUE(told.isNew("a"));
  EXPECT_TRUE(told.isNew("b"));
  EXPECT_FALSE(told.isNew("a"));
  for (std::size_t i = 0; i < ToldOnce::kMost; ++i) told.isNew(std::to_string(i));
  EXPECT_TRUE(told.isNew("a")) << "it was forgotten";
}

}  // namespace
}  // namespace grid_path_planner::nodes
