#include "avoidance/search/candidates.h"

#include <algorithm>
#include <functional>

namespace grid_path_planner::avoidance {
namespace {

constexpr int kMostTests = 150;  // of exact distances for a node; a node in a thicket has none left

// Up to here a point closes its bin.
double reachOf(const PilotOptions& options) {
  return options.step + options.d_safe;
}

bool isClosed(const Eigen::Vector3d& end, const std::vector<Eigen::Vector3d>& closed) {
  return std::any_of(closed.begin(), closed.end(), [&](const Eigen::Vector3d& place) {
    return (end - place).norm() < kClosedPlace;
  });
}

}  // namespace

double directionCost(const PilotOptions& options, const Angles& candidate, const Angles& goal,
                     const Angles& before) {
  const auto difference = [&](const Angles& a) {
    return options.yaw_cost * turnBetween(a.azimuth, candidate.azimuth) +
           options.pitch_cost * std::abs(a.elevation - candidate.elevation);
  };
  return options.goal_weight * difference(goal) + options.smooth_weight * difference(before);
}

Candidates::Candidates(const PilotOptions& options) : directions_(options.bin, options.elevation) {}

bool Candidates::isFree(const OpenSpace& space, const PilotOptions& options,
                        const Eigen::Vector3d& from, int bin,
                        const std::vector<Eigen::Vector3d>& closed) const {
  const Eigen::Vector3d end = from + options.step * directions_.unit(bin);
  if (end.z() < options.z_min || end.z() > options.z_max) return false;
  if (options.rules == Rules::PUBLISHED)
    return std::none_of(beside_.begin(), beside_.end(), [&](const Eigen::Vector3d& point) {
      const double ahead = point.dot(directions_.unit(bin));
      return ahead > 0.0 &&
             point.squaredNorm() - ahead * ahead < options.widening * options.widening;
    });
  if (isClosed(end, closed)) return false;
  const double room = space.nearest(from, options.d_safe) - 0.01;
  return space.clear(from, end, std::min(options.d_safe, std::max(0.0, room)));
}

void Candidates::collectBeside(const OpenSpace& space, const PilotOptions& options,
                               const Eigen::Vector3d& from) {
  beside_.clear();
  if (options.rules != Rules::PUBLISHED || options.widening == 0.0) return;
  const double reach = reachOf(options);
  space.forPoints(from, from, reach, [&](const Eigen::Vector3f& point) {
    const Eigen::Vector3d away = point.cast<double>() - from;
    if (away.squaredNorm() <= reach * reach) beside_.push_back(away);
  });
}

bool Candidates::isApart(const Eigen::Vector3d& end, double spacing) const {
  return std::all_of(found_.begin(), found_.end(),
                     [&](const Candidate& other) { return (other.end - end).norm() >= spacing; });
}

const std::vector<Candidate>& Candidates::find(const OpenSpace& space, const PilotOptions& options,
                                               const Eigen::Vector3d& from, const Angles& goal,
                                               const Angles& before,
                                               const std::vector<Eigen::Vector3d>& closed) {
  const double reach = reachOf(options);
  histogram_.fill(space, directions_, from, reach);
  collectBeside(space, options, from);
  order_.clear();
  for (int bin = 0; bin < directions_.size(); ++bin)
    if (!(histogram_.distance(bin) <= reach))
      order_.push_back({directionCost(options, directions_.angles(bin), goal, before), bin});
  std::make_heap(order_.begin(), order_.end(), std::greater<>());
  found_.clear();
  int tests = 0;
  while (!order_.empty() && static_cast<int>(found_.size()) < options.children &&
         tests < kMostTests) {
    std::pop_heap(order_.begin(), order_.end(), std::greater<>());
    const auto [cost, bin] = order_.back();
    order_.pop_back();
    const Eigen::Vector3d end = from + options.step * directions_.unit(bin);
    if (!isApart(end, options.spacing)) continue;
    ++tests;
    if (isFree(space, options, from, bin, closed))
      found_.push_back({end, directions_.angles(bin), cost});
  }
  return found_;
}

}  // namespace grid_path_planner::avoidance
