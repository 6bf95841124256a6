// A colour camera in a simulated world, in clear or turbid water.
//
//   ImageCamera camera(world, options);
//   std::vector<std::uint8_t> rgb;
//   camera.render(map_from_base * camera.baseFromOptical(), frame_number, rgb);
//   const std::uint8_t* pixel = &rgb[3 * (row * options.width + column)];
//
// A pixel is the mean over its area, centred at whole numbers, of what rays meet: the colour of the surface
// (<diffuse> of the world file) in the light of a headlight (Lambert) and of the surroundings, with blotches,
// through the water between and with noise. One ray is cast for each pixel, and sixteen where a neighbour meets
// another surface: edges are at the right place to a 30th of a pixel. Where a ray meets nothing is endless water,
// black without water.
//
// Guaranteed: the same world, options, pose and frame number give the same image, bit for bit. Not
// modelled: shadows, lenses, motion during the exposure, colours of mesh files.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/simulation/depth_camera.h"
#include "grid_path_planner/simulation/world.h"
#include "simulation/camera/image_camera_options.h"
#include "simulation/camera/surface_noise.h"
#include "simulation/camera/water.h"

namespace grid_path_planner::simulation {

class RayScene;
struct RayHit;

class ImageCamera {
 public:
  // Throws InputError for options outside their limits. The world is not needed afterwards.
  explicit ImageCamera(const World& world, const ImageCameraOptions& options = {});
  ~ImageCamera();
  ImageCamera(ImageCamera&&) noexcept;
  ImageCamera& operator=(ImageCamera&&) noexcept;

  const ImageCameraOptions& options() const { return options_; }
  CameraIntrinsics intrinsics() const;
  // The optical frame in base_link.
  Eigen::Isometry3d baseFromOptical() const;

  // Fills `rgb` with red, green, blue of width x height pixels, row by row from the top left. Throws Stopped.
  void render(const Eigen::Isometry3d& map_from_optical, std::uint64_t frame,
              std::vector<std::uint8_t>& rgb, const base::StopToken& stop = {}) const;

 private:
  struct View;

  Eigen::Array3f colourOf(const View& view, const RayHit& hit, const Eigen::Vector3f& ray) const;
  void castOncePerPixel(const View& view, const base::StopToken& stop,
                        std::vector<Eigen::Array3f>& colours,
                        std::vector<std::uint32_t>& surfaces) const;
  void findEdges(const std::vector<std::uint32_t>& surfaces, int row,
                 std::vector<std::uint8_t>& edges) const;
  Eigen::Array3f meanOverPixel(const View& view, int column, int row) const;

  ImageCameraOptions options_;
  Water water_;
  SurfaceNoise blotches_;
  std::vector<Eigen::Vector3f> rays_;    // of length 1, optical frame, row by row
  std::vector<Eigen::Array3f> diffuse_;  // by surface, 0 to 255
  std::unique_ptr<const RayScene> scene_;
};

}  // namespace grid_path_planner::simulation
