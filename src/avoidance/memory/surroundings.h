// Frames into what is remembered about the vehicle, and that into where it may be.
//
//   surroundings.see(frame, now, options);                    // every frame
//   if (surroundings.refresh(position, options)) use(surroundings.space());
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "avoidance/memory/frame_sight.h"
#include "avoidance/memory/open_space.h"
#include "avoidance/memory/voxel_memory.h"
#include "grid_path_planner/avoidance/frame.h"
#include "grid_path_planner/avoidance/pilot.h"
#include "grid_path_planner/avoidance/pilot_options.h"

namespace grid_path_planner::avoidance {

class Surroundings {
 public:
  // A frame that cannot be used changes nothing; problem() says why.
  void see(const Frame& frame, double now, const PilotOptions& options);
  // The vehicle is here: what is too old is forgotten. Whether anything came since the last call.
  bool refresh(const Eigen::Vector3d& position, const PilotOptions& options);
  void forget();
  // What was seen is forgotten where it was stamped later than now, before the time was known.
  void forgetTheFuture(double now);

  const OpenSpace& space() const { return space_; }
  // Of the newest frame that could be used, at most the time at which it came; none: there was none.
  const std::optional<double>& frameTime() const { return frame_time_; }
  // What was wrong with the newest frame; empty: nothing.
  const std::string& problem() const { return problem_; }
  std::vector<RememberedPoint> points() const;

 private:
  std::string refusal(const Frame& frame, double now, const PilotOptions& options) const;
  std::int32_t milliseconds(double time) const;

  VoxelMemory memory_;
  FrameSight sight_;
  OpenSpace space_;
  std::optional<double> origin_;  // s, of the first frame
  std::optional<double> frame_time_;
  std::optional<double> band_middle_;  // m, height of the vehicle
  bool new_ = false;
  bool started_ = false;  // start_clear is done
  std::string problem_;
};

}  // namespace grid_path_planner::avoidance
