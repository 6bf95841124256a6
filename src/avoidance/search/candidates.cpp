#include "avoidance/search/candidates.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace grid_path_planner::avoidance {
namespace {

constexpr double kEscapeStep = 0.1;    // m
constexpr double kEscapeGrowth = 0.2;  // m for each metre
constexpr double kLeaves = 1e-6;       // m
constexpr int kMostTests = 150;  // of exact distances for a node; a node in a thicket has none left

// Up to here a point closes its bin.
double reachOf(const PilotOptions& options) {
  return options.step + options.d_safe;
}

// Whether a step from where the nearest point is only `room` away leaves it, until `kept` is reached.
bool escapes(const OpenSpace& space, const Eigen::Vector3d& from, const Eigen::Vector3d& end,
             double room, double kept) {
  const double length = (end - from).norm();
  const int samples = static_cast<int>(std::ceil(length / kEscapeStep));
  for (int i = 1; i <= samples; ++i) {
    const double share = static_cast<double>(i) / samples;
    const double asked = std::min(kept, room + kEscapeGrowth * share * length);
    if (space.nearest(from + share * (end - from), kept) < asked) return false;
  }
  return true;
}

double distanceToStep(const Eigen::Vector3d& place, const Eigen::Vector3d& from,
                      const Eigen::Vector3d& end) {
  const Eigen::Vector3d step = end - from;
  const double share = std::clamp((place - from).dot(step) / step.squaredNorm(), 0.0, 1.0);
  return (from + share * step - place).norm();
}

// Whether a step comes near a closed place; one from beside it, nearer than it begins.
bool isClosed(const Eigen::Vector3d& from, const Eigen::Vector3d& end,
              const std::vector<Eigen::Vector3d>& closed) {
  return std::any_of(closed.begin(), closed.end(), [&](const Eigen::Vector3d& place) {
    const double kept = std::min(kClosedPlace, (from - place).norm() - kLeaves);
    return distanceToStep(place, from, end) < kept;
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
                        const CandidateQuery& query, int bin) const {
  const Eigen::Vector3d end = query.from + options.step * directions_.unit(bin);
  if (end.z() < options.z_min || end.z() > options.z_max) return false;
  if (options.rules == Rules::PUBLISHED)
    return std::none_of(beside_.begin(), beside_.end(), [&](const Eigen::Vector3d& point) {
      const double ahead = point.dot(directions_.unit(bin));
      return ahead > 0.0 &&
             point.squaredNorm() - ahead * ahead < options.widening * options.widening;
    });
  if (isClosed(query.from, end, query.closed)) return false;
  const double kept = options.d_safe + kPlanRoom;
  const double room = space.nearest(query.from, kept);
  return room < kept ? escapes(space, query.from, end, room, kept)
                     : space.clear(query.from, end, kept);
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

void Candidates::collectExpanded(const PilotOptions& options, const CandidateQuery& query) {
  expanded_.clear();
  const double reach = options.step + sameNode(options);
  for (const Eigen::Vector3d& node : query.expanded)
    if ((node - query.from).squaredNorm() < reach * reach) expanded_.push_back(node);
}

bool Candidates::isApart(const PilotOptions& options, const Eigen::Vector3d& end) const {
  return std::all_of(expanded_.begin(), expanded_.end(),
                     [&](const Eigen::Vector3d& node) {
                       return (node - end).norm() >= sameNode(options);
                     }) &&
         std::all_of(found_.begin(), found_.end(), [&](const Candidate& other) {
           return (other.end - end).norm() >= options.spacing;
         });
}

const std::vector<Candidate>& Candidates::find(const OpenSpace& space, const PilotOptions& options,
                                               const CandidateQuery& query) {
  const double reach = reachOf(options);
  histogram_.fill(space, directions_, query.from, reach);
  collectBeside(space, options, query.from);
  collectExpanded(options, query);
  order_.clear();
  for (int bin = 0; bin < directions_.size(); ++bin)
    if (!(histogram_.distance(bin) <= reach))
      order_.push_back(
          {directionCost(options, directions_.angles(bin), query.goal, query.before), bin});
  std::make_heap(order_.begin(), order_.end(), std::greater<>());
  found_.clear();
  int tests = 0;
  while (!order_.empty() && static_cast<int>(found_.size()) < options.children &&
         tests < kMostTests) {
    std::pop_heap(order_.begin(), order_.end(), std::greater<>());
    const auto [cost, bin] = order_.back();
    order_.pop_back();
    const Eigen::Vector3d end = query.from + options.step * directions_.unit(bin);
    if (!isApart(options, end)) continue;
    ++tests;
    if (isFree(space, options, query, bin)) found_.push_back({end, directions_.angles(bin), cost});
  }
  return found_;
}

}  // namespace grid_path_planner::avoidance
