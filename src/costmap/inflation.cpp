#include "costmap/inflation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "costmap/bounded_distance_transform.h"

namespace grid_path_planner::costmap {

using base::StopPoll, base::StopToken;
using grid::Cell, grid::CellRect, grid::Grid, grid::Occupancy;

namespace {

// Resolutions come as 32-bit floats: their rounding must not change a radius of whole cells.
constexpr double kResolutionSlack = 1e-7;
// In cells, for the rounding of the logarithm.
constexpr double kReachSlack = 1e-6;
constexpr int kLargestReach = 1 << 19;
constexpr HalfCellsSquared kLargestTable = 1 << 20;
// Columns that are inflated together: the distances of a whole large map would take more memory
// than the map.
constexpr int kNearStrip = 512;
constexpr int kFarStrip = 128;

constexpr int kLanes = 8;  // of vectors of sixteen bits each

// Whether one of eight distances is below the limit.
bool anyBelow(const std::int16_t* distances, int limit) {
  using Eight = std::int16_t __attribute__((vector_size(2 * kLanes)));
  using Halves = std::int64_t __attribute__((vector_size(2 * kLanes)));
  Eight eight;
  std::memcpy(&eight, distances, sizeof eight);
  const auto below = reinterpret_cast<Halves>(eight < static_cast<std::int16_t>(limit));
  return (below[0] | below[1]) != 0;
}

// Raises eight weights to at least those of the ranks.
void raise(const std::uint16_t* ranks, CostGrid::Weight* weights) {
  using Eight = std::uint16_t __attribute__((vector_size(2 * kLanes)));
  Eight least, weight;
  std::memcpy(&least, ranks, sizeof least);
  std::memcpy(&weight, weights, sizeof weight);
  weight -= 1;
  weight = (weight > least ? weight : least) + 1;
  std::memcpy(weights, &weight, sizeof weight);
}

// Distance along the row from each cell to the nearest source, in half cells to its edge, squared: 0
// for the cell itself, else (2n - 1)^2.
void rowDistances(const Occupancy* row, Occupancy source, int width, HalfCellsSquared* out) {
  int last = -1;
  for (int i = 0; i < width; ++i) {
    if (row[i] == source) last = i;
    const HalfCellsSquared edge = 2 * HalfCellsSquared{i - last} - 1;
    out[i] = last < 0 ? kNoObstacle : last == i ? 0 : edge * edge;
  }
  last = -1;
  for (int i = width - 1; i >= 0; --i) {
    if (row[i] == source) last = i;
    if (last < 0 || last == i) continue;
    const HalfCellsSquared edge = 2 * HalfCellsSquared{last - i} - 1;
    if (out[i] == kNoObstacle || edge * edge < out[i]) out[i] = edge * edge;
  }
}

// Lower envelope of parabolas over the cells' lower and upper edges: along a column the nearest
// point of an obstacle is on an edge, never at a centre.
class ColumnTransform {
 public:
  explicit ColumnTransform(int height) : height_(height), values_(height) {
    sources_.reserve(height + 1);
    starts_.reserve(height + 1);
  }

  HalfCellsSquared* values() { return values_.data(); }

  void run() {
    buildEnvelope();
    std::size_t active = 0;
    if (sources_.empty()) return;
    for (int row = 0; row < height_; ++row) {
      const HalfCellsSquared position = 2 * HalfCellsSquared{row};
      while (active + 1 < sources_.size() && starts_[active + 1] <= position) ++active;
      const HalfCellsSquared offset = position - sources_[active].position;
      const HalfCellsSquared through_edge = offset * offset + sources_[active].value;
      if (values_[row] == kNoObstacle || through_edge < values_[row]) values_[row] = through_edge;
    }
  }

 private:
  struct Source {
    HalfCellsSquared
        position;  // half cells: row r's centre is at 2r, its edges at 2r - 1 and 2r + 1
    HalfCellsSquared value;
  };

  void buildEnvelope() {
    sources_.clear();
    starts_.clear();
    for (int edge = 0; edge <= height_; ++edge) {
      const HalfCellsSquared below = edge > 0 ? values_[edge - 1] : kNoObstacle;
      const HalfCellsSquared above = edge < height_ ? values_[edge] : kNoObstacle;
      if (below == kNoObstacle && above == kNoObstacle) continue;
      const HalfCellsSquared value = below == kNoObstacle   ? above
                                     : above == kNoObstacle ? below
                                                            : std::min(below, above);
      push({2 * HalfCellsSquared{edge} - 1, value});
    }
  }

  void push(const Source& source) {
    while (!sources_.empty()) {
      const HalfCellsSquared start = firstNotWorse(sources_.back(), source);
      if (sources_.size() == 1 || start > starts_.back()) {
        sources_.push_back(source);
        starts_.push_back(start);
        return;
      }
      sources_.pop_back();
      starts_.pop_back();
    }
    sources_.push_back(source);
    starts_.push_back(0);
  }

  // The first position at which `right` is no farther than `left`.
  static HalfCellsSquared firstNotWorse(const Source& left, const Source& right) {
    const HalfCellsSquared numerator =
        right.position * right.position + right.value - left.position * left.position - left.value;
    const HalfCellsSquared denominator = 2 * (right.position - left.position);
    return numerator <= 0 ? 0 : (numerator + denominator - 1) / denominator;
  }

  int height_;
  std::vector<HalfCellsSquared> values_;
  std::vector<Source> sources_;
  std::vector<HalfCellsSquared> starts_;
};

// Along the rows of `window`, for the columns of `rect`.
std::vector<HalfCellsSquared> distancesAlongRows(const Grid<Occupancy>& classes, Occupancy source,
                                                 const CellRect& rect, const CellRect& window,
                                                 const StopToken& stop) {
  const auto width = static_cast<std::size_t>(rect.width);
  StopPoll poll(stop, 16);
  std::vector<HalfCellsSquared> distances(width * window.height);
  std::vector<HalfCellsSquared> line(window.width);
  for (int row = 0; row < window.height; ++row) {
    poll();
    rowDistances(classes.row(window.row + row) + window.column, source, window.width, line.data());
    std::copy_n(line.begin() + (rect.column - window.column), width,
                distances.begin() + row * width);
  }
  return distances;
}

}  // namespace

std::vector<HalfCellsSquared> obstacleDistances(const Grid<Occupancy>& classes, Occupancy source,
                                                const CellRect& rect, int reach,
                                                const StopToken& stop) {
  assert(classes.geometry().rect().intersection(rect) == rect);
  const CellRect window = rect.grown(reach).intersection(classes.geometry().rect());
  const std::vector<HalfCellsSquared> along_rows =
      distancesAlongRows(classes, source, rect, window, stop);

  // A few columns together, so that every cache line that is fetched is used.
  constexpr int kTogether = 8;
  const auto width = static_cast<std::size_t>(rect.width);
  const int skipped = rect.row - window.row;
  StopPoll poll(stop, 16);
  std::vector<HalfCellsSquared> distances(width * rect.height);
  std::vector<ColumnTransform> columns(kTogether, ColumnTransform(window.height));
  for (int first = 0; first < rect.width; first += kTogether) {
    poll();
    const int count = std::min(kTogether, rect.width - first);
    for (int row = 0; row < window.height; ++row)
      for (int i = 0; i < count; ++i)
        columns[i].values()[row] = along_rows[row * width + first + i];
    for (int i = 0; i < count; ++i) columns[i].run();
    for (int row = 0; row < rect.height; ++row)
      for (int i = 0; i < count; ++i)
        distances[row * width + first + i] = columns[i].values()[skipped + row];
  }
  return distances;
}

Inflation::Inflation(Occupancy source, const InflationProfile& profile, double resolution)
    : source_(source),
      radius_(2.0 * profile.radius / resolution * (1.0 - kResolutionSlack)),
      decay_(profile.decay * resolution / 2.0),
      free_(profile.free_weight),
      rise_(profile.inflation_weight - profile.free_weight) {
  double half_cells = radius_;
  if (decay_ > 0.0 && rise_ > 0.5) half_cells = radius_ + std::log(2.0 * rise_) / decay_;
  if (half_cells > 0.0)
    reach_ = static_cast<int>(
        std::min<double>(kLargestReach, std::floor((half_cells + 1.0) / 2.0 + kReachSlack)));
  // Unknown cells that a small radius is kept from are blocked themselves, which their class is not.
  if (source == Occupancy::UNKNOWN && radius_ > 0.0) reach_ = std::max(reach_, 1);
  const HalfCellsSquared across = 2 * HalfCellsSquared{reach_} + 1;  // of the first out of reach
  farthest_ = across * across - 1;
  const HalfCellsSquared entries = std::min(kLargestTable, farthest_ + 2);
  ranks_.reserve(static_cast<std::size_t>(entries));
  for (HalfCellsSquared distance = 0; distance < entries; ++distance)
    ranks_.push_back(computeRank(distance));
  makeStamp();
}

void Inflation::makeStamp() {
  if (none() || reach_ > BoundedDistanceTransform::kLargestReach) return;
  const auto edge = [](int cells) {
    return cells == 0 ? HalfCellsSquared{0} : (2 * HalfCellsSquared{cells} - 1) * (2 * cells - 1);
  };
  stamp_stride_ = (2 * std::size_t(reach_) + kLanes) / kLanes * kLanes;
  stamp_.assign(stamp_stride_ * (std::size_t(reach_) + 1), 0);
  for (int row = 0; row <= reach_; ++row)
    for (int column = -reach_; column <= reach_; ++column)
      stamp_[std::size_t(row) * stamp_stride_ + std::size_t(column + reach_)] =
          rankAt(edge(row) + edge(std::abs(column)));
}

void Inflation::raiseAround(Cell source, Grid<CostGrid::Weight>& weights) const {
  const int width = weights.width(), left = source.column - reach_;
  const int first = std::max(0, -left), end = std::min(2 * reach_ + 1, width - left);
  const bool whole = left >= 0 && left + static_cast<int>(stamp_stride_) <= width;
  const int last_row = std::min(weights.height() - 1, source.row + reach_);
  for (int row = std::max(0, source.row - reach_); row <= last_row; ++row) {
    const Rank* ranks = stamp_.data() + std::size_t(std::abs(row - source.row)) * stamp_stride_;
    CostGrid::Weight* weight = weights.row(row) + left;
    if (whole)
      for (std::size_t i = 0; i < stamp_stride_; i += kLanes) raise(ranks + i, weight + i);
    else
      for (int i = first; i < end; ++i) weight[i] = atLeast(ranks[i], weight[i]);
  }
}

void Inflation::apply(const Grid<Occupancy>& classes, const CellRect& sources, const CellRect& rect,
                      Grid<CostGrid::Weight>& weights, const StopToken& stop) const {
  if (none()) return;
  const bool near = reach_ <= BoundedDistanceTransform::kLargestReach;
  const int strip_width = near ? kNearStrip : std::max(kFarStrip, 2 * reach_);
  for (int column = rect.column; column < rect.column + rect.width; column += strip_width) {
    const int width = std::min(strip_width, rect.column + rect.width - column);
    const CellRect strip = {column, rect.row, width, rect.height};
    near ? applyNear(classes, sources, strip, weights, stop)
         : applyFar(classes, strip, weights, stop);
  }
}

void Inflation::applyNear(const Grid<Occupancy>& classes, const CellRect& sources,
                          const CellRect& rect, Grid<CostGrid::Weight>& weights,
                          const StopToken& stop) const {
  BoundedDistanceTransform near(classes, source_, sources, rect, reach_);
  const Rank* const ranks = ranks_.data();
  const int beyond = static_cast<int>(farthest_) + 1;
  StopPoll poll(stop, 64);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    const std::int16_t* distances = near.row(row);
    if (distances == nullptr) continue;
    CostGrid::Weight* weight = weights.row(row) + rect.column;
    for (int first = 0; first < rect.width; first += kLanes) {
      if (!anyBelow(distances + first, beyond)) continue;
      for (int i = first; i < std::min(first + kLanes, rect.width); ++i)
        weight[i] = atLeast(ranks[std::min<int>(distances[i], beyond)], weight[i]);
    }
  }
}

void Inflation::applyFar(const Grid<Occupancy>& classes, const CellRect& rect,
                         Grid<CostGrid::Weight>& weights, const StopToken& stop) const {
  const std::vector<HalfCellsSquared> distances =
      obstacleDistances(classes, source_, rect, reach_, stop);
  for (int row = 0; row < rect.height; ++row) {
    const HalfCellsSquared* distance = distances.data() + std::size_t(row) * rect.width;
    CostGrid::Weight* weight = weights.row(rect.row + row) + rect.column;
    for (int i = 0; i < rect.width; ++i)
      if (distance[i] != kNoObstacle) weight[i] = atLeast(rankAt(distance[i]), weight[i]);
  }
}

void Inflation::applyBorder(const CellRect& rect, Grid<CostGrid::Weight>& weights,
                            const StopToken& stop) const {
  if (none()) return;
  const int width = weights.width(), height = weights.height();
  StopPoll poll(stop, 64);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    const int to_row = std::min(row, height - 1 - row);
    const auto raise = [&](int first, int end) {
      for (int i = std::max(first, rect.column); i < std::min(end, rect.column + rect.width); ++i) {
        const HalfCellsSquared half_cells =
            2 * HalfCellsSquared{std::min({to_row, i, width - 1 - i})} + 1;
        CostGrid::Weight& weight = weights.row(row)[i];
        weight = atLeast(rankAt(half_cells * half_cells), weight);
      }
    };
    if (to_row < reach_ || 2 * reach_ >= width) {
      raise(0, width);
    } else {
      raise(0, reach_);
      raise(width - reach_, width);
    }
  }
}

Inflation::Rank Inflation::rankAt(HalfCellsSquared distance) const {
  const bool in_table = distance < static_cast<HalfCellsSquared>(ranks_.size());
  return in_table ? ranks_[static_cast<std::size_t>(distance)] : computeRank(distance);
}

Inflation::Rank Inflation::computeRank(HalfCellsSquared distance) const {
  if (distance > farthest_) return 0;
  const double half_cells = std::sqrt(static_cast<double>(distance));
  if (half_cells < radius_) return static_cast<Rank>(CostGrid::kBlocked - 1);
  if (decay_ <= 0.0 || rise_ <= 0.0) return static_cast<Rank>(free_ - 1.0);
  return static_cast<Rank>(std::lround(free_ + rise_ * std::exp(-decay_ * (half_cells - radius_))) -
                           1);
}

}  // namespace grid_path_planner::costmap
