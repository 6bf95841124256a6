#include "vision/marker_layout.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::vision {
namespace {

using Eigen::Vector3d;
using test::contains, test::errorText, test::TemporaryFolder;

const std::string kHead = "family: 36h11\ntag_size: 0.2\nplate_size: 0.25\n";

MarkerLayout layoutOf(const std::string& text) {
  const TemporaryFolder folder;
  return readMarkerLayout(folder.write("layout.yaml", text));
}

//      z  0 . . 1        what who stands before the front of the shipped panel sees:
//      |  . . . .        x to the right, z up, the markers' own x and y the same,
//      +--x              their z towards the viewer, who is at negative y
TEST(MarkerLayout, TheShippedOneIsThePanelOfTheWorld) {
  const MarkerLayout layout = readMarkerLayout("config/panel_markers.yaml");
  EXPECT_EQ(layout.panel_from_tag.size(), 14u);
  const Corners front = layout.cornersOf(0);
  EXPECT_TRUE(front[0].isApprox(Vector3d(-1.4, -0.056, 0.9), 1e-6));
  EXPECT_TRUE(front[1].isApprox(Vector3d(-1.2, -0.056, 0.9), 1e-6));
  EXPECT_TRUE(front[2].isApprox(Vector3d(-1.2, -0.056, 0.7), 1e-6));
  EXPECT_TRUE(front[3].isApprox(Vector3d(-1.4, -0.056, 0.7), 1e-6));
  const Corners back = layout.cornersOf(8);
  EXPECT_TRUE(back[0].isApprox(Vector3d(-1.2, 0.056, 0.9), 1e-6))
      << "seen from behind, x runs left";
  EXPECT_FALSE(layout.has(14));
}

// Where wheels, levers and hot stab leave room on the front, and behind those of the corners on the back.
TEST(MarkerLayout, TheShippedOneHasEightMarkersOnTheFrontAndSixOnTheBack) {
  const MarkerLayout layout = readMarkerLayout("config/panel_markers.yaml");
  EXPECT_EQ(layout.tag_size, 0.2);
  const std::pair<double, double> front[] = {// right and up from the board's centre, m
                                             {-1.3, 0.8},   {-0.15, 0.8},  {1.3, 0.8},
                                             {-1.3, -0.8},  {-0.15, -0.8}, {1.3, -0.8},
                                             {-0.5, -0.15}, {0.65, -0.05}};
  for (int id = 0; id < 14; ++id) {
    const auto& [right, up] = front[id < 8 ? id : id - 8];
    const Vector3d& place = layout.panel_from_tag.at(id).translation();
    EXPECT_NEAR(place.x(), right, 1e-12) << id;
    EXPECT_NEAR(place.z(), up, 1e-12) << id;
    EXPECT_EQ(place.y() < 0.0, id < 8) << id;
  }
}

TEST(MarkerLayout, AMistakeIsToldWithFileAndLine) {
  const std::pair<std::string, const char*> mistakes[] = {
      {"markers: []\n", "layout.yaml:1: has no 'family' (36h11)"},
      {"family: 25h9\ntag_size: 0.2\nplate_size: 0.25\nmarkers: []\n",
       "layout.yaml:1: family must be 36h11, got '25h9'"},
      {"family: 36h11\ntag_size: 0\nplate_size: 0.25\nmarkers: []\n",
       "layout.yaml:2: tag_size must be above 0 and at most 100 m, got 0"},
      {"family: 36h11\ntag_size: 0.2\nplate_size: 0.1\nmarkers: []\n",
       "layout.yaml:3: plate_size must be above tag_size"},
      {kHead + "markers: []\n", "layout.yaml:4: markers must be a list of at least one"},
      {kHead + "markers:\n  - {id: 587, position: [0, 0, 0], rpy: [0, 0, 0]}\n",
       "layout.yaml:5: the family 36h11 has markers 0 to 586, got 587"},
      {kHead + "markers:\n  - {id: 1, position: [0, 0, 0], rpy: [0, 0, 0]}\n"
               "  - {id: 1, position: [1, 0, 0], rpy: [0, 0, 0]}\n",
       "layout.yaml:6: there are two markers 1"},
      {kHead + "markers:\n  - {id: 1, position: [0, 0], rpy: [0, 0, 0]}\n",
       "layout.yaml:5: position must be a list of three numbers from -1000 to 1000"},
      {kHead + "markers:\n  - {id: 1, position: [0, 0, 1e9], rpy: [0, 0, 0]}\n",
       "layout.yaml:5: position must be a list of three numbers from -1000 to 1000"},
      {kHead + "markers:\n  - {id: 1, position: [0, .nan, 0], rpy: [0, 0, 0]}\n",
       "layout.yaml:5: position must be a list of three numbers"},
      {kHead + "markers:\n  - {id: 1, position: [0, 0, 0], yaw: 1}\n", "layout.yaml:5: "},
  };
  for (const auto& [text, sentence] : mistakes) {
    const std::string error = errorText([&text = text] { layoutOf(text); });
    EXPECT_TRUE(contains(error, sentence)) << error;
  }
}

}  // namespace
}  // namespace grid_path_planner::vision
