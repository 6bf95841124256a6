#include "grid_path_planner/path/path_image.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/path_through.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::path {

using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

using test::AsciiMap;
using test::contains;
using test::contentOf;
using test::errorText;
using test::pathThrough;
using test::TemporaryFolder;

using Colour = std::array<int, 3>;

Colour pixelAt(const Picture& picture, const Eigen::Vector2d& pixel) {
  const int x = static_cast<int>(pixel.x()), y = static_cast<int>(pixel.y());
  const std::uint8_t* rgb = &picture.rgb[3 * (static_cast<std::size_t>(y) * picture.width + x)];
  return {rgb[0], rgb[1], rgb[2]};
}

int lightness(const Colour& colour) {
  return (colour[0] + colour[1] + colour[2]) / 3;
}
bool isGreen(const Colour& c) {
  return c[1] > c[0] + 60 && c[1] > c[2] + 30;
}
bool isOrange(const Colour& c) {
  return c[0] > c[1] + 60 && c[1] > c[2] + 30;
}
bool isBlue(const Colour& c) {
  return c[2] > c[0] + 60 && c[2] > c[1] + 30;
}

PictureContent along(const Path& path, const std::vector<Cell>& expanded = {}) {
  return {path, expanded, {}, {}};
}

// A picture that is asked about places of the map.
struct Drawn {
  Drawn(const OccupancyGrid& map, const PictureContent& content, const PictureOptions& options = {})
      : layout(map.geometry(), options), picture(drawPicture(map, {}, content, options)) {}
  explicit Drawn(const OccupancyGrid& map, const Path& path = {},
                 const std::vector<Cell>& expanded = {}, const PictureOptions& options = {})
      : Drawn(map, along(path, expanded), options) {}
  Colour at(double x, double y) const { return pixelAt(picture, layout.pixelAt({x, y})); }
  // Whether the legend, the margin below the map, has a pixel like this.
  template <class Like>
  bool legendShows(Like&& like) const {
    const CellRect area = layout.mapArea();
    for (int y = area.row + area.height + 2; y < layout.height(); ++y)
      for (int x = 0; x < layout.width(); ++x)
        if (like(pixelAt(picture, Eigen::Vector2d(x, y)))) return true;
    return false;
  }

  PictureLayout layout;
  Picture picture;
};

TEST(Picture, FreeIsLightUnknownGreyAndOccupiedDark) {
  const AsciiMap map({"...",  //
                      ".?.",  //
                      "..#"});
  const Drawn drawn(map.map);
  EXPECT_GT(lightness(drawn.at(0.5, 0.5)), 230);
  EXPECT_GT(lightness(drawn.at(2.5, 0.5)), 230);
  EXPECT_NEAR(lightness(drawn.at(1.5, 1.5)), 190, 20);
  EXPECT_LT(lightness(drawn.at(2.5, 2.5)), 70);
}

TEST(Picture, UpIsUp) {
  // Row 0 is the first line of the ASCII map and the lowest of the picture.
  const AsciiMap map({"#..",  //
                      "..."});
  const Drawn drawn(map.map);
  const CellRect area = drawn.layout.mapArea();
  const Eigen::Vector2d lower_left(area.column + 5, area.row + area.height - 5);
  const Eigen::Vector2d upper_left(area.column + 5, area.row + 5);
  EXPECT_LT(lightness(pixelAt(drawn.picture, lower_left)), 70);
  EXPECT_GT(lightness(pixelAt(drawn.picture, upper_left)), 230);
}

TEST(Picture, StartGoalAndPathAreMarked) {
  const AsciiMap map({"..........",  //
                      "..........",  //
                      "####......"});
  const Drawn drawn(map.map, pathThrough({{0.5, 0.5}, {8.5, 0.5}, {8.5, 2.5}}));
  EXPECT_TRUE(isGreen(drawn.at(0.5, 0.5)));
  EXPECT_TRUE(isOrange(drawn.at(8.5, 2.5)));
  EXPECT_TRUE(isBlue(drawn.at(4.0, 0.5)));
  EXPECT_TRUE(isBlue(drawn.at(8.5, 1.2)));
  EXPECT_TRUE(isBlue(drawn.at(8.5, 0.5)));
  EXPECT_GT(lightness(drawn.at(4.4, 1.6)), 230);
}

TEST(Picture, PathsAcrossObstaclesShow) {
  const Drawn drawn(AsciiMap({"####################"}).map, pathThrough({{1.5, 0.5}, {18.5, 0.5}}));
  EXPECT_TRUE(isBlue(drawn.at(10.0, 0.5)));
  // Between the path and the obstacle is a light outline.
  const Eigen::Vector2d middle = drawn.layout.pixelAt({10.0, 0.5});
  int lightest = 0;
  for (int up = 0; up < 20; ++up)
    lightest =
        std::max(lightest, lightness(pixelAt(drawn.picture, middle - Eigen::Vector2d(0, up))));
  EXPECT_GT(lightest, 230);
}

TEST(Picture, GoalPointsWhereTheVehicleLooks) {
  const AsciiMap map({".....", ".....", ".....", ".....", "....."});
  for (const double yaw : {0.0, M_PI / 2, 2.5, -M_PI / 2}) {
    const Drawn drawn(map.map, pathThrough({{2.5, 2.5}}, yaw));
    // From the goal on, ahead and behind: how far the marker reaches.
    const auto reach = [&](double angle) {
      double r = 0.0;
      while (lightness(drawn.at(2.5 + r * std::cos(angle), 2.5 + r * std::sin(angle))) < 240 ||
             r < 0.05)
        r += 0.002;
      return r;
    };
    EXPECT_GT(reach(yaw), 1.4 * reach(yaw + M_PI)) << yaw;
  }
}

// A map that is turned in the world is drawn straight, and its path and heading with it.
TEST(Picture, ATurnedMapGivesTheSamePicture) {
  const std::vector<std::string> lines = {"......", "..#...", "......"};
  const AsciiMap straight(lines);
  const AsciiMap turned(lines, 1.0, {0.0, 0.0, M_PI / 2});
  const Picture a =
      drawPicture(straight.map, {}, along(pathThrough({{0.5, 0.5}, {5.5, 0.5}}, 0.0)));
  const Picture b =
      drawPicture(turned.map, {}, along(pathThrough({{-0.5, 0.5}, {-0.5, 5.5}}, M_PI / 2)));
  EXPECT_EQ(a.rgb, b.rgb);
}

TEST(Picture, ExpandedCellsAreTintedAndLaterOnesStronger) {
  const Drawn drawn(AsciiMap({"?...."}).map, {}, {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {-1, 7}});
  const auto yellowness = [&](double x) { return drawn.at(x, 0.5)[0] - drawn.at(x, 0.5)[2]; };
  EXPECT_GT(yellowness(1.5), 40);
  EXPECT_GT(yellowness(3.5), yellowness(1.5) + 20);
  EXPECT_LT(yellowness(4.5), 10);
  // An unknown cell stays darker than the free ones, though it was expanded first.
  EXPECT_GT(yellowness(0.5), 5);
  EXPECT_LT(lightness(drawn.at(0.5, 0.5)), lightness(drawn.at(1.5, 0.5)) - 10);
}

TEST(Picture, TheLegendShowsWhatIsDrawnAndNothingElse) {
  const AsciiMap map({"....", "...."});
  const auto isRed = [](const Colour& c) { return c[0] > c[1] + 60 && c[2] > c[1] + 10; };
  PictureContent content;
  const auto shown = [&] {
    const Drawn drawn(map.map, content);
    const Colour rectangle = drawn.at(0.3, 0.3), early = drawn.at(1.5, 1.5);
    const auto is = [](const Colour& colour) {
      return [colour](const Colour& each) { return each == colour; };
    };
    const Colour free = Drawn(map.map).at(0.3, 0.3);
    return std::array<bool, 4>{
        drawn.legendShows(isBlue), early != free && drawn.legendShows(is(early)),
        rectangle != free && drawn.legendShows(is(rectangle)), drawn.legendShows(isRed)};
  };
  EXPECT_EQ(shown(), (std::array<bool, 4>{false, false, false, false}));
  content.expanded = {{1, 1}};
  EXPECT_EQ(shown(), (std::array<bool, 4>{false, true, false, false}));
  content.rectangles = {{0, 0, 1, 1}};
  EXPECT_EQ(shown(), (std::array<bool, 4>{false, true, true, false}));
  content.links = {{{2.5, 0.5}, {3.5, 0.5}}};
  EXPECT_EQ(shown(), (std::array<bool, 4>{false, true, true, true}));
  content.path = pathThrough({{2.5, 1.5}, {3.5, 1.5}});
  EXPECT_TRUE(shown()[0]);
}

TEST(Picture, SmallMapsAreEnlargedByAWholeFactor) {
  const PictureLayout layout(GridGeometry(30, 7, 0.1));
  EXPECT_EQ(layout.enlarged(), 115);  // 805 pixels high
  EXPECT_EQ(layout.mapArea().width, 30 * 115);
  EXPECT_EQ(layout.mapArea().height, 7 * 115);
  EXPECT_EQ(PictureLayout(GridGeometry(1006, 1674, 0.03)).enlarged(), 1);
  // The longer side sets the limit.
  EXPECT_EQ(PictureLayout(GridGeometry(1000, 1, 1.0)).enlarged(), 4);
}

TEST(Picture, LargeMapsAreReducedByAWholeFactor) {
  const PictureLayout layout(GridGeometry(9000, 5, 1.0));
  EXPECT_EQ(layout.reduced(), 3);
  EXPECT_EQ(layout.enlarged(), 1);
  EXPECT_EQ(layout.mapArea().width, 3000);
  EXPECT_EQ(layout.mapArea().height, 2);
}

TEST(Picture, AThinWallSurvivesReduction) {
  OccupancyGrid map(GridGeometry(300, 300, 1.0));
  for (int row = 0; row < 300; ++row) map[Cell{151, row}] = 100;
  const Drawn drawn(map, {}, {}, {10, 100});
  EXPECT_EQ(drawn.layout.reduced(), 3);
  EXPECT_LT(lightness(drawn.at(151.5, 200.0)), 70);
  EXPECT_GT(lightness(drawn.at(148.5, 200.0)), 230);
}

TEST(Picture, SizesAreThoseOfTheLayout) {
  const OccupancyGrid map(GridGeometry(20, 10, 1.0));
  const Picture picture = drawPicture(map, {}, {}, {50, 200});
  const PictureLayout layout(map.geometry(), {50, 200});
  EXPECT_EQ(layout.mapArea().width, 100);
  EXPECT_EQ(picture.width, layout.width());
  EXPECT_EQ(picture.height, layout.height());
  EXPECT_EQ(picture.rgb.size(), std::size_t(3) * picture.width * picture.height);
}

TEST(Picture, ASingleCellAndALongMapCanBeDrawn) {
  EXPECT_NO_THROW(
      drawPicture(OccupancyGrid(GridGeometry(1, 1, 0.05)), {}, along(pathThrough({{0, 0}}))));
  EXPECT_NO_THROW(drawPicture(OccupancyGrid(GridGeometry(1, 20000, 1e-3)), {}, {}));
}

TEST(Picture, PathsThatLeaveTheMapAreCutOff) {
  const AsciiMap map({"..........", "..........", ".........."});
  const Drawn drawn(map.map, pathThrough({{-1e6, 1.5}, {5.5, 1.5}, {1e300, 1.5}}));
  EXPECT_TRUE(isBlue(drawn.at(1.0, 1.5)));
  EXPECT_TRUE(isBlue(drawn.at(9.0, 1.5)));
}

TEST(Picture, BadInputIsRefused) {
  const AsciiMap map({"..."});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(contains(errorText([&] {
                         drawPicture(map.map, {}, along(pathThrough({{0, 0}, {nan, 0}})));
                       }),
                       "pose 2"));
  EXPECT_TRUE(contains(errorText([&] {
                         drawPicture(map.map, {}, along(pathThrough({{0, 0}}, nan)));
                       }),
                       "pose 1"));
  EXPECT_TRUE(contains(errorText([&] { drawPicture(OccupancyGrid(), {}, {}); }), "without cells"));
  for (const PictureOptions options : {PictureOptions{0, 100}, {200, 100}, {100, 20000}})
    EXPECT_TRUE(contains(errorText([&] { drawPicture(map.map, {}, {}, options); }), "sides"));
}

TEST(PictureFile, IsAPngOfTheRightSize) {
  const TemporaryFolder folder;
  const std::string file = folder.path("map.png");
  const AsciiMap map({"....", ".#.."});
  writePicture(file, map.map, {}, along(pathThrough({{0.5, 0.5}, {3.5, 0.5}}), {{1, 0}}));
  const std::string bytes = contentOf(file);
  ASSERT_GT(bytes.size(), 24u);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value * 256 + std::uint8_t(bytes[i]);
    return value;
  };
  const PictureLayout layout(map.map.geometry());
  EXPECT_EQ(number(16), layout.width());
  EXPECT_EQ(number(20), layout.height());
  EXPECT_EQ(folder.names(), std::vector<std::string>{"map.png"});
}

TEST(PictureFile, IsTheSameEveryTime) {
  const TemporaryFolder folder;
  const AsciiMap map({"....", ".#.?"});
  for (const std::string name : {"a.png", "b.png"})
    writePicture(folder.path(name), map.map, {},
                 along(pathThrough({{0.5, 0.5}, {3.2, 1.1}}), {{1, 0}}));
  EXPECT_EQ(contentOf(folder.path("a.png")), contentOf(folder.path("b.png")));
}

TEST(PictureFile, OtherFormatsGoByTheExtension) {
  const TemporaryFolder folder;
  const AsciiMap map({"...."});
  writePicture(folder.path("a.JPG"), map.map, {}, {});
  writePicture(folder.path("a.ppm"), map.map, {}, {});
  EXPECT_EQ(contentOf(folder.path("a.JPG")).substr(0, 2), "\xff\xd8");
  EXPECT_EQ(contentOf(folder.path("a.ppm")).substr(0, 2), "P6");
}

TEST(PictureFile, UnknownExtensionsAreRefused) {
  const TemporaryFolder folder;
  const AsciiMap map({"...."});
  for (const std::string name : {"a.docx", "a", ".", "a.", "b.png/a"}) {
    const std::string file = folder.path(name);
    EXPECT_EQ(errorText([&] { writePicture(file, map.map, {}, {}); }),
              file + ": no picture is written with this extension, use .png");
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(PictureFile, APlaceThatCannotBeWrittenIsNamed) {
  const TemporaryFolder folder;
  const AsciiMap map({"...."});
  const std::string file = folder.write("file", "not a folder") + "/map.png";
  EXPECT_EQ(errorText([&] { writePicture(file, map.map, {}, {}); }),
            file + ": cannot be written: Not a directory");
}

TEST(Picture, RectanglesAreTintedOutlinedAndNumbered) {
  const AsciiMap map({"....",  //
                      "....",  //
                      "..##"});
  PictureContent content;
  content.rectangles = {{0, 0, 4, 2}, {0, 2, 2, 1}, {3, 2, 9, 9}, {7, 7, 1, 1}};
  const Drawn drawn(map.map, content);
  const Drawn plain(map.map);
  const Colour first = drawn.at(0.3, 0.3), second = drawn.at(0.3, 2.3);
  EXPECT_NE(first, plain.at(0.3, 0.3));
  EXPECT_NE(first, second);
  EXPECT_GT(lightness(first), 170);
  EXPECT_EQ(drawn.at(3.7, 1.7), first) << "all of it is tinted";
  EXPECT_EQ(drawn.at(2.5, 2.5), plain.at(2.5, 2.5)) << "what is in none is as it was";
  EXPECT_NE(drawn.at(3.5, 2.3), plain.at(3.5, 2.3)) << "one that leaves the map is cut";
  EXPECT_LT(lightness(drawn.at(1.999, 2.5)), 130) << "an outline";
  int dark = 0;
  for (double x = 1.9; x < 2.1; x += 0.004)
    for (double y = 0.9; y < 1.1; y += 0.004) dark += lightness(drawn.at(x, y)) < 100 ? 1 : 0;
  EXPECT_GT(dark, 5) << "a number in the middle";
}

TEST(Picture, LinksAreLinesBetweenDots) {
  const AsciiMap map({"....", "...."});
  PictureContent content;
  content.links = {{{0.5, 0.5}, {3.5, 1.5}}};
  const Drawn drawn(map.map, content);
  const Drawn plain(map.map);
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    const double x = 0.5 + 3.0 * share, y = 0.5 + share;
    EXPECT_NE(drawn.at(x, y), plain.at(x, y)) << share;
  }
  EXPECT_EQ(drawn.at(3.5, 0.5), plain.at(3.5, 0.5));
}

}  // namespace
}  // namespace grid_path_planner::path
