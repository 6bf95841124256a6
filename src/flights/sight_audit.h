// Whether a vehicle stays in space that its camera has seen, by the true rays: what the law "no unseen
// space is entered" is checked with, apart from anything that the pilot remembers.
//
//   SightAudit audit(world, camera_options, 0.3, start, 1.5);
//   audit.see(map_from_optical);                  // every frame
//   if (!audit.seen(position)) ++entered;
//
// The true ranges of every frame are kept at a quarter of the camera's width and height, and a point is
// seen where one of the four rays about it reaches it in any frame up to now: at 10 m that is as good as 0.2 m.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "grid_path_planner/simulation/depth_camera.h"

namespace grid_path_planner::flights {

class SightAudit {
 public:
  // Of a ball of `radius` metres; what lies within `start_clear` of `start` counts as seen.
  SightAudit(const simulation::World& world, const simulation::DepthCameraOptions& camera,
             double radius, const Eigen::Vector3d& start, double start_clear);

  void see(const Eigen::Isometry3d& map_from_optical);

  // Whether middle and surface of the ball about `centre` (in 26 directions) were seen.
  bool seen(const Eigen::Vector3d& centre);

 private:
  struct View {
    Eigen::Isometry3d optical_from_map;
    std::vector<float> ranges;  // m, row by row
  };

  bool seenPoint(const Eigen::Vector3d& point, std::size_t& newest) const;
  bool seenIn(const View& view, const Eigen::Vector3d& point) const;

  simulation::DepthCamera camera_;
  simulation::CameraIntrinsics pinhole_;
  Eigen::Vector3d start_;
  double start_clear_;
  std::vector<Eigen::Vector3d> sphere_;  // m: the ball's points
  std::vector<std::size_t> last_seen_;   // of each of them: the view that saw the last one
  std::vector<View> views_;
  std::vector<float> points_;
};

}  // namespace grid_path_planner::flights
