#include "simulation/camera/image_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/option_laws.h"

namespace grid_path_planner::simulation {
namespace {

using Eigen::Array3f, Eigen::Isometry3d, Eigen::Vector3d, Eigen::Vector3f;

// Without water, noise and blotches, in even light: what is seen is the surfaces' colour.
ImageCameraOptions withoutWater() {
  ImageCameraOptions o;
  o.width = 64;
  o.height = 48;
  o.attenuation_red = o.attenuation_green = o.attenuation_blue = 0.0;
  o.noise = o.surface_noise = 0.0;
  o.ambient = 1.0;
  return o;
}

// Water whose red fades over metres, green slowly, blue not at all.
ImageCameraOptions wet() {
  ImageCameraOptions o = withoutWater();
  o.attenuation_red = 0.5;
  o.attenuation_green = 0.1;
  return o;
}

class Image {
 public:
  Image(const World& world, const ImageCameraOptions& options, std::uint64_t frame = 0)
      : width_(options.width) {
    const ImageCamera camera(world, options);
    camera.render(camera.baseFromOptical(), frame, rgb_);
  }

  Array3f at(int column, int row) const {
    const std::uint8_t* pixel = &rgb_[3 * (row * width_ + column)];
    return Array3f(pixel[0], pixel[1], pixel[2]);
  }
  const std::vector<std::uint8_t>& bytes() const { return rgb_; }

 private:
  int width_;
  std::vector<std::uint8_t> rgb_;
};

TriangleMesh painted(TriangleMesh mesh, const Vector3f& colour) {
  mesh.colour = colour;
  return mesh;
}

// A wall across x, `distance` ahead of the origin, turned about z, of colour 0.8, 0.4, 0.2.
World colouredWallAt(double distance, double turn = 0.0) {
  Isometry3d pose(Eigen::Translation3d(distance, 0.0, 0.0));
  pose.rotate(Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
  return World({painted(planeMesh("wall", Vector3d::UnitX(), {1000.0, 1000.0}).moved(pose),
                        {0.8f, 0.4f, 0.2f})});
}

bool isNear(const Array3f& a, const Array3f& b) {
  return (a - b).abs().maxCoeff() <= 0.51f;
}

TEST(ImageCameraOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<ImageCameraOptions>();
}

// 640 x 480 pixels that are 1.2 rad wide, level, in the water E*.
TEST(ImageCameraOptions, AreByDefaultThoseOfTheDocumentation) {
  const ImageCameraOptions o;
  EXPECT_EQ(o.rate, 5.0);
  EXPECT_EQ(o.width, 640);
  EXPECT_EQ(o.height, 480);
  EXPECT_EQ(o.horizontal_fov, 1.2);
  EXPECT_EQ(o.noise, 2.0);
  EXPECT_EQ(o.mounting.pitch, 0.0);
  EXPECT_EQ(Vector3d(o.attenuation_red, o.attenuation_green, o.attenuation_blue),
            Vector3d(0.45, 0.14, 0.10));
  EXPECT_EQ(Vector3d(o.water_red, o.water_green, o.water_blue), Vector3d(12.0, 62.0, 70.0));
}

TEST(ImageCamera, ASurfaceHasItsColour) {
  EXPECT_TRUE(isNear(Image(colouredWallAt(2.0), withoutWater()).at(0, 0), {204.0f, 102.0f, 51.0f}));
  EXPECT_TRUE(isNear(Image(World({}), withoutWater()).at(0, 0), Array3f::Zero()))
      << "nothing is black";
}

// E^0 at no distance, the water's own colour at infinity, and the published mixture between.
TEST(Water, IsNothingAtNoDistanceAndAllAtInfinity) {
  const Water water;
  const Array3f colour(200.0f, 100.0f, 50.0f);
  EXPECT_TRUE(water.seenThrough(colour, 0.0f).isApprox(colour));
  EXPECT_TRUE(water.seenThrough(colour, INFINITY).isApprox(water.colour));
  const Array3f seen = water.seenThrough(colour, 2.0f);
  EXPECT_NEAR(seen[0], 200.0 * std::exp(-0.9) + (1.0 - std::exp(-0.9)) * 12.0, 1e-3);
  const Water none{Array3f::Zero(), {9.0f, 9.0f, 9.0f}};
  EXPECT_TRUE(none.seenThrough(colour, INFINITY).isApprox(colour)) << "no 0 times infinity";
}

TEST(ImageCamera, WaterCountsAlongTheRay) {
  const ImageCameraOptions options = wet();
  const Image image(colouredWallAt(2.0), options);
  const CameraIntrinsics pinhole = ImageCamera(World({}), options).intrinsics();
  for (const int column : {0, 20, 40, 63}) {
    const double x = (column - pinhole.cx) / pinhole.fx, y = (7 - pinhole.cy) / pinhole.fy;
    const double range = 2.0 * std::sqrt(1.0 + x * x + y * y);
    EXPECT_NEAR(image.at(column, 7)[0],
                204.0 * std::exp(-0.5 * range) + (1.0 - std::exp(-0.5 * range)) * 12.0, 0.51);
  }
  EXPECT_TRUE(isNear(Image(World({}), options).at(0, 0), {12.0f, 62.0f, 0.0f}))
      << "endless water; blue has none";
}

TEST(ImageCamera, ASurfaceThatIsTurnedAwayIsDarker) {
  ImageCameraOptions options = withoutWater();
  options.ambient = 0.25;
  options.width = options.height = 1;
  EXPECT_TRUE(isNear(Image(colouredWallAt(2.0), options).at(0, 0), {204.0f, 102.0f, 51.0f}));
  const float light = 0.25f + 0.75f * std::cos(1.0f);
  EXPECT_TRUE(isNear(Image(colouredWallAt(2.0, 1.0), options).at(0, 0),
                     light * Array3f(204.0f, 102.0f, 51.0f)));
}

//     ......####      the pixel in which a black plate begins is as bright as its share of it
//     ......####
TEST(ImageCamera, AnEdgeIsWhereItIsToASixteenthOfAPixel) {
  ImageCameraOptions options = withoutWater();
  const CameraIntrinsics pinhole = ImageCamera(World({}), options).intrinsics();
  for (double edge = 40.0; edge < 41.0; edge += 0.07) {           // column where black begins
    const double left = -2.0 * (edge - pinhole.cx) / pinhole.fx;  // m, at a distance of 2 m
    const World world({painted(planeMesh("white", Vector3d::UnitX(), {9.0, 9.0})
                                   .moved(Isometry3d(Eigen::Translation3d(2.0 + 1e-4, 0.0, 0.0))),
                               {1.0f, 1.0f, 1.0f}),
                       painted(planeMesh("black", Vector3d::UnitX(), {4.0, 4.0})
                                   .moved(Isometry3d(Eigen::Translation3d(2.0, left - 2.0, 0.0))),
                               Vector3f::Zero())});
    const Image image(world, options);
    double white = 0.0;  // pixels, of the row from column 30 on
    for (int column = 30; column < 50; ++column) white += image.at(column, 24)[0] / 255.0;
    EXPECT_NEAR(30.0 - 0.5 + white, edge, 0.04);
  }
}

TEST(ImageCamera, TheSameSeedGivesTheSameBits) {
  ImageCameraOptions options;
  options.width = 80;
  options.height = 60;
  const World world = colouredWallAt(2.0);
  const Image first(world, options, 7);
  EXPECT_EQ(first.bytes(), Image(world, options, 7).bytes());
  EXPECT_NE(first.bytes(), Image(world, options, 8).bytes()) << "every image has its own noise";
  options.seed = 2;
  EXPECT_NE(first.bytes(), Image(world, options, 7).bytes());
}

TEST(ImageCamera, AnImageThatIsNoLongerWantedIsGivenUp) {
  const World world = colouredWallAt(2.0);
  const ImageCamera camera(world, withoutWater());
  base::StopSource stop;
  stop.cancel();
  std::vector<std::uint8_t> rgb;
  EXPECT_THROW(camera.render(camera.baseFromOptical(), 0, rgb, stop.token()), base::Stopped);
}

TEST(ImageCamera, TheNoiseHasItsStandardDeviation) {
  ImageCameraOptions options = withoutWater();
  options.noise = 2.0;
  const Image image(colouredWallAt(2.0), options);
  double sum = 0.0, squares = 0.0;
  const auto count = static_cast<double>(options.width * options.height);
  for (int i = 0; i < options.width * options.height; ++i) {
    const double value = image.bytes()[3 * i + 1] - 102.0;
    sum += value / count;
    squares += value * value / count;
  }
  EXPECT_NEAR(sum, 0.0, 0.15);
  EXPECT_NEAR(squares, 4.0 + 1.0 / 12.0, 0.3);  // and of rounding
}

TEST(SurfaceNoise, IsTheSameWhereverItIsSeenFromAndStaysWithinItsLimits) {
  const SurfaceNoise noise(1, 0.05);
  double sum = 0.0;
  for (int i = -2000; i < 2000; ++i) {
    const Vector3f point(0.013f * i, -0.007f * i, 0.5f);
    EXPECT_LE(std::abs(noise.at(point)), 1.0f);
    EXPECT_NEAR(noise.at(point), noise.at(point + Vector3f(1e-5f, 0.0f, 0.0f)), 0.01f);
    sum += noise.at(point) / 4000.0;
  }
  EXPECT_NEAR(sum, 0.0, 0.05);
  EXPECT_NE(noise.at({0.1f, 0.2f, 0.3f}), SurfaceNoise(2, 0.05).at({0.1f, 0.2f, 0.3f}));
}

TEST(World, AVisualHasItsDiffuseColour) {
  const World world = readWorld("worlds/panel_site.sdf");
  const auto colourOf = [&](const std::string& name) -> Vector3f {
    for (const TriangleMesh& mesh : world.visible())
      if (mesh.name == name) return mesh.colour;
    return Vector3f::Constant(-1.0f);
  };
  EXPECT_TRUE(colourOf("seabed::body::ground").isApprox(Vector3f(0.62f, 0.55f, 0.40f)));
  EXPECT_TRUE(colourOf("testing_panel::body::tag_7").isApprox(Vector3f(0.03f, 0.03f, 0.03f)));
}

}  // namespace
}  // namespace grid_path_planner::simulation
