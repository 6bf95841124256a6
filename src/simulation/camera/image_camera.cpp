#include "simulation/camera/image_camera.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulation/camera/pinhole.h"
#include "simulation/range_noise.h"
#include "simulation/ray_scene.h"

namespace grid_path_planner::simulation {

namespace {

constexpr float kEndOfRays = 1e4f;    // m
constexpr int kSamples = 16;          // in a pixel with an edge
constexpr double kBlotchSize = 0.05;  // m

// No two samples have a row or a column of a 16 x 16 raster in common (Hammersley's set): an edge along
// the pixels' rows is met by all of them at different heights.
constexpr std::array<int, kSamples> kBitReversed = {0, 8, 4, 12, 2, 10, 6, 14,
                                                    1, 9, 5, 13, 3, 11, 7, 15};

double shareOfPixel(int sixteenth) {
  return (sixteenth + 0.5) / kSamples - 0.5;
}

Water waterOf(const ImageCameraOptions& o) {
  Water water;
  water.attenuation =
      Eigen::Array3d(o.attenuation_red, o.attenuation_green, o.attenuation_blue).cast<float>();
  water.colour = Eigen::Array3d(o.water_red, o.water_green, o.water_blue).cast<float>();
  return water;
}

void putPixels(const std::vector<Eigen::Array3f>& colours, const ImageCameraOptions& options,
               std::uint64_t frame, std::vector<std::uint8_t>& rgb) {
  const RangeNoise noise(options.seed, frame);
  const auto deviation = static_cast<float>(options.noise);
  rgb.resize(3 * colours.size());
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const float value = colours[i / 3][i % 3] + deviation * noise.deviation(i);
    rgb[i] = static_cast<std::uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f));
  }
}

}  // namespace

// From where an image is taken.
struct ImageCamera::View {
  Eigen::Vector3f origin;
  Eigen::Matrix3f turn;
};

ImageCamera::ImageCamera(const World& world, const ImageCameraOptions& options)
    : options_(options), water_(waterOf(options)), blotches_(options.seed, kBlotchSize) {
  base::checkOptionLimits(options);
  rays_ = raysOf(intrinsics(), options.width, options.height);
  for (const TriangleMesh& mesh : world.visible()) diffuse_.push_back(255.0f * mesh.colour.array());
  scene_ = std::make_unique<const RayScene>(world.visible());
}

ImageCamera::~ImageCamera() = default;
ImageCamera::ImageCamera(ImageCamera&&) noexcept = default;
ImageCamera& ImageCamera::operator=(ImageCamera&&) noexcept = default;

CameraIntrinsics ImageCamera::intrinsics() const {
  return intrinsicsOf(options_.width, options_.height, options_.horizontal_fov);
}

Eigen::Isometry3d ImageCamera::baseFromOptical() const {
  return options_.mounting.pose() * opticalFrame();
}

Eigen::Array3f ImageCamera::colourOf(const View& view, const RayHit& hit,
                                     const Eigen::Vector3f& ray) const {
  if (hit.surface == RayScene::kNothing)
    return water_.seenThrough(Eigen::Array3f::Zero(), hit.range);
  const Eigen::Vector3f direction = view.turn * ray;
  const auto ambient = static_cast<float>(options_.ambient);
  float light = ambient + (1.0f - ambient) * std::abs(hit.normal.dot(direction));
  if (options_.surface_noise > 0.0)
    light *= 1.0f + static_cast<float>(options_.surface_noise) *
                        blotches_.at(view.origin + hit.range * direction);
  return water_.seenThrough(light * diffuse_[hit.surface], hit.range);
}

void ImageCamera::castOncePerPixel(const View& view, const base::StopToken& stop,
                                   std::vector<Eigen::Array3f>& colours,
                                   std::vector<std::uint32_t>& surfaces) const {
  base::StopPoll poll(stop);
  colours.resize(rays_.size());
  surfaces.resize(rays_.size());
  RayHit hits[RayScene::kPacket];
  for (std::size_t first = 0; first < rays_.size(); first += RayScene::kPacket) {
    poll();
    const std::size_t count = std::min(RayScene::kPacket, rays_.size() - first);
    scene_->hits(view.origin, view.turn, &rays_[first], count, kEndOfRays, hits);
    for (std::size_t i = 0; i < count; ++i) {
      colours[first + i] = colourOf(view, hits[i], rays_[first + i]);
      surfaces[first + i] = hits[i].surface;
    }
  }
}

// Whether one of the up to eight neighbours of each pixel of a row meets another surface.
void ImageCamera::findEdges(const std::vector<std::uint32_t>& surfaces, int row,
                            std::vector<std::uint8_t>& edges) const {
  const int width = options_.width;
  const std::uint32_t* here = &surfaces[static_cast<std::size_t>(row) * width];
  const std::uint32_t* above = row > 0 ? here - width : here;
  const std::uint32_t* below = row + 1 < options_.height ? here + width : here;
  edges.assign(width, 0);
  std::uint32_t left = 0;  // what differs in the column before
  for (int c = 0; c < width; ++c) {
    const std::uint32_t column = (above[c] ^ here[c]) | (below[c] ^ here[c]);
    const std::uint32_t beside = c > 0 ? here[c - 1] ^ here[c] : 0;
    edges[c] = (left | column | beside) != 0;
    if (c > 0) edges[c - 1] |= (column | beside) != 0;
    left = column;
  }
}

Eigen::Array3f ImageCamera::meanOverPixel(const View& view, int column, int row) const {
  const CameraIntrinsics pinhole = intrinsics();
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  RayHit hits[RayScene::kPacket];
  Eigen::Vector3f rays[RayScene::kPacket];
  for (int first = 0; first < kSamples; first += RayScene::kPacket) {
    for (int i = 0; i < static_cast<int>(RayScene::kPacket); ++i)
      rays[i] = rayThrough(pinhole, column + shareOfPixel(first + i),
                           row + shareOfPixel(kBitReversed[first + i]));
    scene_->hits(view.origin, view.turn, rays, RayScene::kPacket, kEndOfRays, hits);
    for (std::size_t i = 0; i < RayScene::kPacket; ++i) sum += colourOf(view, hits[i], rays[i]);
  }
  return sum / static_cast<float>(kSamples);
}

void ImageCamera::render(const Eigen::Isometry3d& map_from_optical, std::uint64_t frame,
                         std::vector<std::uint8_t>& rgb, const base::StopToken& stop) const {
  const View view = {map_from_optical.translation().cast<float>(),
                     map_from_optical.linear().cast<float>()};
  std::vector<Eigen::Array3f> colours;
  std::vector<std::uint32_t> surfaces;
  castOncePerPixel(view, stop, colours, surfaces);
  base::StopPoll poll(stop, 1);
  std::vector<std::uint8_t> edges;
  for (int row = 0; row < options_.height; ++row) {
    poll();
    findEdges(surfaces, row, edges);
    for (int column = 0; column < options_.width; ++column)
      if (edges[column] != 0)
        colours[row * options_.width + column] = meanOverPixel(view, column, row);
  }
  putPixels(colours, options_, frame, rgb);
}

}  // namespace grid_path_planner::simulation
