// Places on the path that stay unseen although the vehicle stands and looks there.
//
// What is unseen about such a place may lie beside the picture, then the vehicle turns to it. Then the place is
// looked at from a vantage; where that shows nothing more, it closes paths for a while.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "avoidance/steering/kept_room.h"
#include "avoidance/steering/steering.h"

namespace grid_path_planner::avoidance {

class UnseenPlaces {
 public:
  void forget();

  // With what was steered along the present path. Whether that path is to be given up: for the one to the
  // vantage, or to be searched for anew.
  bool update(double time, const Motion& motion, const Steering& steering, const OpenSpace& space,
              const KeptRoom& room, double d_safe);

  // Where the vehicle flies to look, if it does, and at what.
  bool looks() const { return !path_.empty(); }
  const std::vector<Eigen::Vector3d>& path() const { return path_; }
  const std::optional<Eigen::Vector3d>& lookAt() const { return look_at_; }
  const std::vector<Eigen::Vector3d>& closed() const { return closed_; }

 private:
  bool look(double time, const Eigen::Vector3d& vehicle, const Steering& steering,
            const OpenSpace& space);
  bool waitedInVain(double time, const Steering& steering);
  void remember(const Eigen::Vector3d& vehicle);
  bool looksAside(const Motion& motion, const Eigen::Vector3d& place, const OpenSpace& space,
                  double d_safe);

  std::vector<Eigen::Vector3d> path_;  // to the vantage; empty: none
  std::optional<Eigen::Vector3d> look_at_;
  std::vector<Eigen::Vector3d> track_;   // where the vehicle was, the newest last
  std::vector<Eigen::Vector3d> turned_;  // to what was turned
  std::vector<Eigen::Vector3d> tried_;   // looked at from a vantage
  std::vector<Eigen::Vector3d> closed_;  // given up
  std::optional<double> waits_since_;
  double began_ = 0.0;      // s, when the vantage was chosen
  double closed_at_ = 0.0;  // s, when a place was given up last
};

}  // namespace grid_path_planner::avoidance
