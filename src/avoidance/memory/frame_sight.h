// What a frame tells the memory: hits at its points, and the voxels that its rays passed.
//
// With a pinhole, each voxel of the memory inside the picture is looked up in the pixel that sees its
// centre: some 70,000 voxels instead of 76,800 rays of 50 voxels. Without one, the measured rays are
// traversed, one for each voxel that they hit.
#pragma once

#include <cstddef>
#include <vector>

#include "avoidance/memory/voxel_memory.h"
#include "grid_path_planner/avoidance/frame.h"
#include "grid_path_planner/avoidance/pilot_options.h"

namespace grid_path_planner::avoidance {

// Heights between which points count: m, map frame.
struct HeightBand {
  double low, high;
};

class FrameSight {
 public:
  // The window of the memory must be where the frame was taken, and beginFrame be called.
  void see(const Frame& frame, const PilotOptions& options, const HeightBand& band,
           VoxelMemory& memory);

  // Whether the last frame had a pinhole that its points do not agree with; then only measured rays cleared.
  bool pinholeDisagrees() const { return pinhole_disagrees_; }

 private:
  bool pinholeFits(const Frame& frame) const;
  void hits(const Frame& frame, const PilotOptions& options, const HeightBand& band,
            VoxelMemory& memory);
  void fillDepths(const Frame& frame, const PilotOptions& options);
  void fillNoReturns(const Frame& frame, double clears);
  void crossPicture(const Frame& frame, const PilotOptions& options, VoxelMemory& memory) const;
  bool rayPasses(const Frame& frame, double column, double row,
                 const Eigen::Vector3d& centre) const;
  bool anyRayPasses(const Frame& frame, const Eigen::Vector3d& centre) const;
  void crossRow(const Frame& frame, const Eigen::Vector3d& first, const Eigen::Vector3d& along,
                const Voxel& from, int count, VoxelMemory& memory) const;
  void crossRays(const Frame& frame, const PilotOptions& options, VoxelMemory& memory);

  bool pinhole_disagrees_ = false;
  std::vector<float> depths_;  // m along z up to which a pixel's ray is free; 0: not known
  std::vector<float> ranges_;  // m along the ray, of pixels that clear without return; else 0
  std::vector<unsigned char> found_;  // whether a pixel or its neighbours in the row measured
  std::vector<std::size_t> rays_;     // pixels whose rays are traversed
  SlotBits ray_ends_;                 // where they end
};

}  // namespace grid_path_planner::avoidance
