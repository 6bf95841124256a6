#include "grid_path_planner/path/smoothing.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <optional>

#include "grid_path_planner/costmap/line_of_sight.h"

namespace grid_path_planner::path {

using base::StopPoll, base::StopToken;
using costmap::BitMaps, costmap::CostGrid, costmap::lineCostWithin, costmap::SegmentPoint;

namespace {

constexpr double kNoLine = std::numeric_limits<double>::infinity();
// Sums of the same lengths in another order differ by less, relatively.
constexpr double kRounding = 1e-12;

class Smoother {
 public:
  Smoother(const CostGrid& map, const std::vector<SegmentPoint>& points, const StopToken& stop)
      : map_(map),
        bits_(map.uniform() ? &map.bitMaps(stop) : nullptr),
        points_(points),
        poll_(stop, 64),
        costs_(1, 0.0) {
    for (std::size_t i = 1; i < points.size(); ++i)
      costs_.push_back(costs_.back() + straight(i - 1, i, kNoLine).value_or(kNoLine));
  }

  SmoothPath run() {
    SmoothPath path;
    path.kept.resize(points_.size());
    std::iota(path.kept.begin(), path.kept.end(), std::size_t{0});
    path.cost = costs_.back();
    if (path.cost == kNoLine) return path;
    pullFromTheStart(path.kept);
    for (int round = 0; round < kRounds && slide(path.kept); ++round) {
    }
    path.cost = 0.0;
    for (std::size_t i = 1; i < path.kept.size(); ++i)
      path.cost += costOf(path.kept[i - 1], path.kept[i]);
    return path;
  }

 private:
  static constexpr int kRounds = 4;

  std::optional<double> straight(std::size_t from, std::size_t to, double limit) {
    poll_();
    return lineCostWithin(map_, bits_, points_[from], points_[to], limit);
  }
  double along(std::size_t from, std::size_t to) const { return costs_[to] - costs_[from]; }
  bool replaceable(std::size_t from, std::size_t to) {
    return straight(from, to, along(from, to) * (1.0 + kRounding)).has_value();
  }
  // The cost of a segment; infinite where it is not legal or costs more than `limit`.
  double costOf(std::size_t from, std::size_t to, double limit = kNoLine) {
    return straight(from, to, limit).value_or(kNoLine);
  }

  // From each kept point a segment to a point as far ahead as possible: steps that double, then
  // bisection.
  void pullFromTheStart(std::vector<std::size_t>& kept) {
    kept = {0};
    const std::size_t last = points_.size() - 1;
    while (kept.back() < last) {
      const std::size_t from = kept.back();
      std::size_t good = from + 1, step = 2;
      while (from + step <= last && replaceable(from, from + step)) {
        good = from + step;
        step *= 2;
      }
      std::size_t bad = std::min(from + step, last + 1);
      while (bad - good > 1) {
        const std::size_t middle = good + (bad - good) / 2;
        (replaceable(from, middle) ? good : bad) = middle;
      }
      kept.push_back(good);
    }
  }

  // Moves kept points along the polyline to where the path costs less, and drops those that a
  // straight line past them replaces. Returns whether anything changed.
  bool slide(std::vector<std::size_t>& kept) {
    bool changed = false;
    std::vector<std::size_t> next = {kept.front()};
    for (std::size_t i = 1; i + 1 < kept.size(); ++i) {
      const std::size_t before = next.back(), after = kept[i + 1];
      const double present = costOf(before, kept[i]) + costOf(kept[i], after);
      const auto direct = straight(before, after, present);
      if (direct) {
        changed = true;
        continue;
      }
      next.push_back(slid(before, kept[i], after, present));
      changed = changed || next.back() != kept[i];
    }
    if (kept.size() > 1) next.push_back(kept.back());
    kept = std::move(next);
    return changed;
  }

  // Hill climbing from `at` to lower costs, in steps that halve.
  std::size_t slid(std::size_t before, std::size_t at, std::size_t after, double cost) {
    for (std::size_t step = std::max<std::size_t>(1, (after - before) / 8); step > 0; step /= 2) {
      for (const bool back : {true, false}) {
        const bool room = back ? at > before + step : at + step < after;
        if (!room) continue;
        const std::size_t to = back ? at - step : at + step;
        const double first = costOf(before, to, cost);
        if (first >= cost) continue;
        const double both = first + costOf(to, after, cost - first);
        if (both >= cost * (1.0 - kRounding)) continue;
        at = to;
        cost = both;
        step *= 2;
        break;
      }
    }
    return at;
  }

  const CostGrid& map_;
  const BitMaps* bits_;
  const std::vector<SegmentPoint>& points_;
  StopPoll poll_;
  std::vector<double> costs_;  // of the polyline up to each point
};

}  // namespace

SmoothPath smoothed(const CostGrid& map, const std::vector<SegmentPoint>& points,
                    const StopToken& stop) {
  assert(!points.empty());
  return Smoother(map, points, stop).run();
}

}  // namespace grid_path_planner::path
