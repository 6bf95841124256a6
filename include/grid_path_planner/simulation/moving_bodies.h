// Bodies that move through a simulated world along timed polylines: people, vehicles, doors.
//
//   const auto bodies = std::make_shared<const MovingBodies>(std::vector<MovingBody>{
//       {"walker", BodyShape::CYLINDER, {0.3, 0.3, 0.9}, {{0.0, {5, -4, 0.9}}, {8.0, {5, 4, 0.9}}}}});
//   vehicle.setBodies(bodies);
//   camera.render(pose, frame, points, bodies->at(vehicle.time()));
//
// They are seen by the camera and felt as contacts. Guaranteed: where a body is depends on the time
// alone; before its first time and after its last it stands. Not modelled: turns of a body, what
// a touch does to body and vehicle (it is counted, nothing is stopped).
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/simulation/world.h"

namespace grid_path_planner::simulation {

enum class BodyShape { SPHERE, CYLINDER, BOX };  // a cylinder stands along z
const std::vector<std::pair<const char*, BodyShape>>& choicesOf(BodyShape);

struct TimedPosition {
  double time = 0.0;  // s
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

struct MovingBody {
  std::string name;
  BodyShape shape = BodyShape::SPHERE;
  Eigen::Vector3d half_size =
      Eigen::Vector3d::Constant(0.5);  // m; a sphere's and cylinder's x is the radius
  std::vector<TimedPosition> track;    // of the centre, times rising

  Eigen::Vector3d positionAt(double time) const;
};

// The bodies at one time.
class BodiesAt {
 public:
  BodiesAt() = default;
  BodiesAt(const std::vector<MovingBody>& bodies, double time);  // `bodies` outlive it

  bool empty() const { return bodies_.empty(); }
  // The nearest surface, if one is nearer than `reach` metres; distance 0 inside a body.
  std::optional<NearestSurface> nearest(const Eigen::Vector3d& from, double reach) const;
  // Metres along a ray of length-1 `direction` to the first surface, infinity where it meets none; 0
  // from inside.
  double range(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

 private:
  struct Placed {
    const MovingBody* body;
    Eigen::Vector3d centre;
    double bounding_radius;
  };

  std::vector<Placed> bodies_;
};

class MovingBodies {
 public:
  // Throws InputError naming the body for sizes that are not positive and finite, and a track that
  // is empty, not finite or whose times do not rise.
  explicit MovingBodies(std::vector<MovingBody> bodies);

  const std::vector<MovingBody>& bodies() const { return bodies_; }
  BodiesAt at(double time) const { return {bodies_, time}; }

 private:
  std::vector<MovingBody> bodies_;
};

}  // namespace grid_path_planner::simulation
