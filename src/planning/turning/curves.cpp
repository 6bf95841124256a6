#include "planning/turning/curves.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "path/motions.h"
#include "planning/end_segments.h"
#include "planning/message_text.h"
#include "planning/turning/curved_path.h"

namespace grid_path_planner::planning {

using base::StopToken;
using costmap::CostGrid, costmap::lineCost, costmap::lineOfSight, costmap::SegmentPoint;
using path::applyHeadings, path::applyZ, path::drivingDirection, path::Path, path::Pose;

namespace {

constexpr double kRepeatedPose = 1e-9;  // m
// How far the points' polyline is from an arc, in cells, and the largest angle between two.
constexpr double kFromArc = 0.02, kLargestStep = 0.1;

using Points = std::vector<Eigen::Vector2d>;

class Curves {
 public:
  Curves(const PoseRequest& request, const PlannerOptions& options, const CostGrid& costs,
         std::function<bool(const Path&)> fits, const StopToken& stop)
      : request_(request), options_(options), costs_(costs), fits_(std::move(fits)), stop_(stop) {}

  void operator()(Plan& plan) const {
    Path path = withoutRepeats(plan.path);
    const Pose first = plan.path.poses.front(), last = plan.path.poses.back();
    if (path.poses.size() < 2) return standing(plan);
    const EndSegments segments(costs_);
    const auto legal = [&](const Points& line) { return isLegal(line, segments); };
    const auto goal =
        request_.any_goal_heading ? std::nullopt : drivingDirection(last.yaw, options_.heading);
    CurvedPath curved = curvedPath(path, drivingDirection(request_.start.yaw, options_.heading),
                                   goal, limits(), legal, stop_);
    applyZ(curved.path, first.position.z(), last.position.z(), options_.fixed_z, options_.path_z);
    applyHeadings(curved.path, request_.start.yaw, last.yaw, options_.heading);
    plan.path = std::move(curved.path);
    plan.optimal = false;
    plan.cost = {};
    plan.segment_cost = costOf(plan.path);
    tell(plan, curved.sharp,
         placeText(curved.first_sharp.value_or(first.position.head<2>()), last));
  }

 private:
  CurveLimits limits() const {
    const double cells = options_.min_turning_radius / costs_.geometry().resolution();
    return {options_.min_turning_radius, std::min(kLargestStep, std::sqrt(8.0 * kFromArc / cells))};
  }

  static Path withoutRepeats(const Path& path) {
    Path apart;
    for (const Pose& pose : path.poses)
      if (apart.empty() ||
          (pose.position - apart.poses.back().position).head<2>().norm() > kRepeatedPose)
        apart.poses.push_back(pose);
    return apart;
  }

  // A path without a length: it stands, or would have to turn on the spot.
  void standing(Plan& plan) const {
    const double turn = std::remainder(plan.path.poses.back().yaw - request_.start.yaw, 2.0 * M_PI);
    if (request_.any_goal_heading || std::abs(turn) < kRepeatedPose) return;
    tell(plan, 1, placeText(plan.path.poses.back().position.head<2>(), plan.path.poses.back()));
  }

  // A corner at an end is the turn to the goal's heading, or from the start's.
  std::string placeText(const Eigen::Vector2d& corner, const Pose& goal) const {
    const auto isAt = [&](const Pose& pose) {
      return (corner - pose.position.head<2>()).norm() < kRepeatedPose;
    };
    if (isAt(goal))
      return "the goal " + positionText(corner) + ", which asks for " + headingText(goal.yaw);
    if (isAt(request_.start))
      return "the start " + positionText(corner) + ", with " + headingText(request_.start.yaw);
    return positionText(corner);
  }

  void tell(Plan& plan, std::size_t sharp, const std::string& first) const {
    plan.sharp_corners = sharp;
    const std::string of_radius = metresText(options_.min_turning_radius);
    if (sharp == 0)
      return addNote(plan.message, "its turns have a radius of " + of_radius + " at least");
    addNote(plan.message, std::to_string(sharp) + (sharp == 1 ? " corner stays" : " corners stay") +
                              " sharp, since no curve of " + of_radius + " fits, the first at " +
                              first);
  }

  SegmentPoint pointOf(const Eigen::Vector2d& position) const {
    return SegmentPoint::nearest(costs_.geometry().gridFromWorld(position));
  }

  bool isLegal(const Points& line, const EndSegments& segments) const {
    for (const Eigen::Vector2d& point : line)
      if (!costs_.geometry().cellAt(point)) return false;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      if (segments.measured() ? !segments.keeps(line[i], line[i + 1])
                              : !lineOfSight(costs_, pointOf(line[i]), pointOf(line[i + 1])))
        return false;
    return !fits_ || fits_(headed(line));
  }

  Path headed(const Points& line) const {
    Path path;
    for (const Eigen::Vector2d& point : line) {
      path.poses.emplace_back();
      path.poses.back().position << point, 0.0;
    }
    applyHeadings(path, 0.0, 0.0, options_.heading);
    return path;
  }

  double costOf(const Path& path) const {
    double cost = 0.0;
    for (std::size_t i = 0; i + 1 < path.poses.size(); ++i)
      cost += lineCost(costs_, pointOf(path.poses[i].position.head<2>()),
                       pointOf(path.poses[i + 1].position.head<2>()));
    return cost;
  }

  const PoseRequest request_;
  const PlannerOptions& options_;
  const CostGrid& costs_;
  const std::function<bool(const Path&)> fits_;
  const StopToken& stop_;
};

}  // namespace

std::function<void(Plan&)> curvesFor(const PoseRequest& request, const PlannerOptions& options,
                                     const CostGrid& costs, std::function<bool(const Path&)> fits,
                                     const StopToken& stop) {
  if (options.min_turning_radius <= 0.0) return nullptr;
  return Curves(request, options, costs, std::move(fits), stop);
}

}  // namespace grid_path_planner::planning
