// The velocity that a vehicle has by its model from the commands that were sent to it, and those that it has not begun to
// follow.
//
//   CommandedVelocity commanded(vehicle);
//   commanded.advanceTo(now);
//   predict(commanded.velocity(), commanded.pending());
//   commanded.sent(command);
#pragma once

#include <deque>
#include <vector>

#include "vehicle/motion_model.h"

namespace grid_path_planner::vehicle {

// In force for so long.
struct TimedCommand {
  base::BodyVelocity command;
  double seconds = 0.0;
};

class CommandedVelocity {
 public:
  // Precondition: the description was checked.
  explicit CommandedVelocity(const Description& vehicle) : model_(vehicle) {}

  // Times in seconds. One that lies before the last, or more than kForgets after it, forgets all: the vehicle stands.
  void advanceTo(double time);
  // At the time of the last advanceTo().
  void sent(const base::BodyVelocity& command);

  const base::BodyVelocity& velocity() const { return state_.velocity; }
  // What the vehicle will follow in the dead time that begins now, in order.
  std::vector<TimedCommand> pending() const;

  static constexpr double kForgets = 2.0;  // s

 private:
  struct Sent {
    double followed_from;  // s
    base::BodyVelocity command;
  };

  MotionModel model_;
  PlanarState state_;  // only the velocity counts
  double time_ = 0.0;
  base::BodyVelocity followed_;
  std::deque<Sent> waiting_;
};

}  // namespace grid_path_planner::vehicle
