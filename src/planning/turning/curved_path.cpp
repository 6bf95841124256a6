#include "planning/turning/curved_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "path/dubins.h"

namespace grid_path_planner::planning {

using base::StopPoll, base::StopToken;
using Eigen::Vector2d;
using path::DirectedPoint, path::DubinsCurve, path::dubinsCurve, path::Path, path::Pose;

namespace {

using Points = std::vector<Vector2d>;

constexpr std::size_t kWindow = 12;     // points that a curve may pass over
constexpr double kMostPoints = 1000.0;  // of a path
constexpr double kSameDirection = 1e-9;

// A directed point of the path.
struct Node {
  DirectedPoint point;
  std::size_t segment;  // of the path, on which it is
};

// How a node is reached best.
struct Reached {
  std::size_t sharp = std::numeric_limits<std::size_t>::max();
  double length = std::numeric_limits<double>::infinity();
  std::size_t before = 0;
  bool corners = false;  // along the path itself, not by a curve

  bool betterThan(const Reached& other) const {
    return sharp != other.sharp ? sharp < other.sharp : length < other.length;
  }
};

class Curving {
 public:
  Curving(const Path& path, const CurveLimits& limits,
          const std::function<bool(const Points&)>& legal, const StopToken& stop)
      : limits_(limits), legal_(legal), poll_(stop, 16) {
    for (const Pose& pose : path.poses) corners_.push_back(pose.position.head<2>());
  }

  CurvedPath run(std::optional<double> start, std::optional<double> goal) {
    placeNodes(start, goal);
    reached_.assign(nodes_.size(), {});
    reached_.front() = {0, 0.0, 0, false};
    for (std::size_t from = 0; from + 1 < nodes_.size(); ++from) {
      const std::size_t last = std::min(from + kWindow, nodes_.size() - 1);
      for (std::size_t to = last; to > from; --to) tryCurve(from, to);
      takeCorners(from);
    }
    return traced();
  }

 private:
  double directionOf(std::size_t segment) const {
    const Vector2d along = corners_[segment + 1] - corners_[segment];
    return std::atan2(along.y(), along.x());
  }

  void placeNodes(std::optional<double> start, std::optional<double> goal) {
    const std::size_t last = corners_.size() - 2;
    double length = 0.0;
    for (std::size_t i = 0; i <= last; ++i) length += (corners_[i + 1] - corners_[i]).norm();
    const double spacing = std::max(limits_.radius / 2.0, length / kMostPoints);
    nodes_.push_back({{corners_.front(), start.value_or(directionOf(0))}, 0});
    double missing = spacing;  // to the next one
    for (std::size_t i = 0; i <= last; ++i) {
      const Vector2d along = corners_[i + 1] - corners_[i];
      const double segment = along.norm();
      double at = missing;
      for (; at < segment; at += spacing)
        nodes_.push_back({{corners_[i] + along * (at / segment), directionOf(i)}, i});
      missing = at - segment;
    }
    nodes_.push_back({{corners_.back(), goal.value_or(directionOf(last))}, last});
  }

  void take(std::size_t to, const Reached& reached) {
    if (reached.betterThan(reached_[to])) reached_[to] = reached;
  }

  void tryCurve(std::size_t from, std::size_t to) {
    poll_();
    const DubinsCurve curve = dubinsCurve(nodes_[from].point, nodes_[to].point, limits_.radius);
    const Reached reached{reached_[from].sharp, reached_[from].length + curve.length(), from,
                          false};
    if (!reached.betterThan(reached_[to])) return;
    Points points = curve.points(limits_.step);
    points.insert(points.begin(), nodes_[from].point.position);
    if (legal_(points)) take(to, reached);
  }

  // Along the path to the next node.
  void takeCorners(std::size_t from) {
    Reached reached = reached_[from];
    const Points line = alongPath(from);
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      reached.length += (line[i + 1] - line[i]).norm();
    reached.sharp += sharpBetween(from).size();
    reached.before = from;
    reached.corners = true;
    take(from + 1, reached);
  }

  Points alongPath(std::size_t from) const {
    Points line = {nodes_[from].point.position};
    for (std::size_t i = nodes_[from].segment; i < nodes_[from + 1].segment; ++i)
      line.push_back(corners_[i + 1]);
    line.push_back(nodes_[from + 1].point.position);
    return line;
  }

  // The corners of the path from a node to the next, those at the ends themselves included.
  Points sharpBetween(std::size_t from) const {
    const Node &a = nodes_[from], &b = nodes_[from + 1];
    Points sharp;
    const auto turns = [](double before, double after) {
      return std::abs(std::remainder(after - before, 2.0 * M_PI)) > kSameDirection;
    };
    if (turns(a.point.direction, directionOf(a.segment))) sharp.push_back(a.point.position);
    for (std::size_t i = a.segment; i < b.segment; ++i)
      if (turns(directionOf(i), directionOf(i + 1))) sharp.push_back(corners_[i + 1]);
    if (turns(directionOf(b.segment), b.point.direction)) sharp.push_back(b.point.position);
    return sharp;
  }

  CurvedPath traced() const {
    std::vector<std::size_t> chain;
    for (std::size_t at = nodes_.size() - 1; at != 0; at = reached_[at].before) chain.push_back(at);
    CurvedPath curved;
    curved.sharp = reached_.back().sharp;
    add(curved.path, {nodes_.front().point.position});
    for (auto to = chain.rbegin(); to != chain.rend(); ++to) {
      const std::size_t from = reached_[*to].before;
      if (!reached_[*to].corners) {
        const DubinsCurve curve =
            dubinsCurve(nodes_[from].point, nodes_[*to].point, limits_.radius);
        Points points = curve.points(limits_.step);
        if (points.empty()) continue;
        points.back() = nodes_[*to].point.position;
        add(curved.path, points);
        continue;
      }
      const Points sharp = sharpBetween(from);
      if (!sharp.empty() && !curved.first_sharp) curved.first_sharp = sharp.front();
      add(curved.path, alongPath(from));
    }
    return curved;
  }

  static void add(Path& path, const Points& points) {
    for (const Vector2d& point : points) {
      Pose pose;
      pose.position << point, 0.0;
      if (!path.empty() && (path.poses.back().position - pose.position).norm() < 1e-9) continue;
      path.poses.push_back(pose);
    }
  }

  const CurveLimits limits_;
  const std::function<bool(const Points&)>& legal_;
  StopPoll poll_;
  Points corners_;
  std::vector<Node> nodes_;
  std::vector<Reached> reached_;
};

}  // namespace

CurvedPath curvedPath(const Path& path, std::optional<double> start, std::optional<double> goal,
                      const CurveLimits& limits, const std::function<bool(const Points&)>& legal,
                      const StopToken& stop) {
  CurvedPath curved = Curving(path, limits, legal, stop).run(start, goal);
  curved.path.frame_id = path.frame_id;
  return curved;
}

}  // namespace grid_path_planner::planning
